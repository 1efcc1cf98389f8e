from __future__ import annotations

import json
import math

import pytest

from tribodyn.papers.cheng_2022.claims import CLAIMS, Claim, Row, as_json, as_markdown, as_text, verdict
from tribodyn.papers.cheng_2022.claims.base import CLOSE, NEAR, Finding, number, share, truth


def test_a_number_is_judged_by_its_factor():
    assert verdict(number(1.0, 1.0, "N")) == "reproduced"
    assert verdict(number(0.99 * CLOSE, 1.0, "N")) == "reproduced"
    assert verdict(number(1.01 / CLOSE, 1.0, "N")) == "reproduced"
    assert verdict(number(1.01 * CLOSE, 1.0, "N")) == "differs"
    assert verdict(number(0.99 / CLOSE, 1.0, "N")) == "differs"
    assert verdict(number(1.01 * NEAR, 1.0, "N")) == "contradicted"
    assert verdict(number(0.0, 1.0, "N")) == "contradicted"
    assert verdict(number(math.nan, 1.0, "N")) == "contradicted"


def test_a_statement_is_judged_by_how_long_it_holds():
    assert verdict(share(0.96, "larger")) == "reproduced"
    assert verdict(share(0.9, "larger")) == "differs"
    assert verdict(share(0.4, "larger")) == "contradicted"


def test_a_truth_holds_partly_or_not():
    assert [verdict(truth(*case)) for case in ((True, "a"), (False, "b"))] == ["reproduced", "contradicted"]
    assert verdict(truth(False, "c", partly=True)) == "differs"


def test_every_claim_has_its_own_name_and_says_where_it_stands():
    assert len({claim.name for claim in CLAIMS}) == len(CLAIMS)
    assert all(claim.says and claim.where[0].isdigit() for claim in CLAIMS)


@pytest.fixture
def row():
    claim = Claim(
        "a", "5.2, Fig. 12", "it | holds", lambda runs, formulation, friction: truth(True, ""), "why"
    )
    return Row(claim, Finding("2 N", 1.0, 2.0), Finding("9 N", 0.0, 9.0), (1.0, 3.0))


def test_the_table_gives_both_formulations_and_the_spread(row):
    text = as_text([row])
    assert text.startswith("REPRODUCED")
    assert "9 N (contradicted)" in text
    assert "1 to 3 with μ_f" in text


def test_the_markdown_table_keeps_its_columns(row):
    lines = as_markdown([row]).splitlines()
    assert all(line.replace("\\|", "").count("|") == 7 for line in lines)


def test_the_json_table_is_plain(row):
    [entry] = json.loads(json.dumps(as_json([row]), allow_nan=False))
    assert entry["verdict"] == "reproduced"
    assert entry["exact_verdict"] == "contradicted"
