from __future__ import annotations

import json
import math

import pytest

from tribodyn.papers.cheng_2022.claims import CLAIMS, Claim, Finding, Row, as_json, as_markdown, as_text
from tribodyn.papers.cheng_2022.claims.base import FRICTION
from tribodyn.papers.cheng_2022.claims.bounds import CLOSE, NEAR, above, below, near


def test_a_number_is_judged_by_its_factor():
    bound = near(2.0, "N")
    assert bound.verdict(2.0) == "reproduced"
    assert bound.verdict(0.99 * CLOSE * 2.0) == "reproduced"
    assert bound.verdict(1.01 / CLOSE * 2.0) == "reproduced"
    assert bound.verdict(1.01 * CLOSE * 2.0) == "differs"
    assert bound.verdict(0.99 / CLOSE * 2.0) == "differs"
    assert bound.verdict(1.01 * NEAR * 2.0) == "contradicted"
    assert bound.verdict(0.0) == "contradicted"


def test_what_exceeds_or_stays_below():
    assert [above(95.0, "%", partly=50.0).verdict(share) for share in (96.0, 90.0, 40.0)] == [
        "reproduced",
        "differs",
        "contradicted",
    ]
    assert [below(5.0, "%", partly=20.0).verdict(share) for share in (4.0, 6.0, 30.0)] == [
        "reproduced",
        "differs",
        "contradicted",
    ]
    assert above(0.0, by="the paper").verdict(-1.0) == "contradicted"
    assert above(0.0).verdict(math.nan) == "contradicted"


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim.name)
def test_no_claim_passes_by_equality_with_its_bound(claim):
    assert claim.bound.edges
    for edge in claim.bound.edges:
        assert claim.bound.verdict(edge) != "reproduced"
        inward = math.inf if edge == claim.bound.full[0] else -math.inf
        assert claim.bound.verdict(math.nextafter(edge, inward)) == "reproduced"


def test_every_claim_says_where_it_stands_and_is_either_judged_or_explained():
    assert len({claim.name for claim in CLAIMS}) == len(CLAIMS)
    for claim in CLAIMS:
        assert claim.says
        assert claim.where
        assert claim.bound is not None
        assert claim.measure is not None or claim.reason


def found(value):
    return Finding(f"{value:g} N", value)


@pytest.fixture
def claim():
    return Claim("a", "5.2, Fig. 12", "it | holds", near(2.0, "N"), lambda trial: found(2.0), "why")


@pytest.fixture
def row(claim):
    return Row(claim, found(2.0), found(9.0), ((FRICTION, 1.0, 3.0),))


def test_the_table_gives_formulations_bound_and_spread(row):
    text = as_text([row])
    assert text.startswith("REPRODUCED")
    assert "9 N (contradicted)" in text
    assert "1.6 to 2.5 N (we)" in text
    assert "1 to 3 with μ_f = 0.05, 0.1, 0.2" in text


def test_the_markdown_table_keeps_its_columns(row):
    lines = as_markdown([row, Row(Claim("b", "1", "untested", near(1.0, "N"), reason="later"))]).splitlines()
    assert {line.replace("\\|", "").count("|") for line in lines} == {8}


def test_the_json_table_is_plain(row):
    [entry] = json.loads(json.dumps(as_json([row]), allow_nan=False))
    assert entry["verdict"] == "reproduced"
    assert entry["exact_verdict"] == "contradicted"
    assert entry["bound_chosen_by"] == "we"


def test_what_holds_on_a_condition_says_so():
    claim = Claim("a", "1", "it holds", near(2.0, "N"), lambda trial: found(2.0), condition="if cheese")
    assert Row(claim, found(2.0), found(2.0)).verdict == "on a condition"
    assert "if cheese" in Row(claim, found(2.0), found(2.0)).reason
    # A condition saves nothing that does not come out.
    assert Row(claim, found(3.0), found(2.0)).verdict == "differs"


def test_what_is_not_measured_is_not_tested():
    row = Row(Claim("a", "1", "it holds", near(2.0, "N"), reason="not simulated"))
    assert row.verdict == row.exact_verdict == "not tested"
    assert row.reason == "not simulated"


def test_a_claim_on_no_mechanism_has_one_finding(claim):
    row = Row(claim, found(9.0))
    assert row.verdict == row.exact_verdict == "contradicted"
    assert row.found[1] == "alike"
