import math

import pytest

from tribodyn.papers.cheng_2022.claims import CLAIMS, Claim, Finding, Row, as_text
from tribodyn.papers.cheng_2022.claims.base import SENTENCES
from tribodyn.papers.cheng_2022.claims.bounds import CLOSE, NEAR, above, below, near
from tribodyn.papers.cheng_2022.claims.ensemble import Judgement


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
        assert claim.bound.since >= "2026-11-21"
        assert claim.measure is not None or claim.reason
        assert bool(claim.quantity) == (claim.measure is not None)


def test_every_sentence_has_a_claim_and_every_claim_a_sentence():
    made = {name for claim in CLAIMS for name in claim.sentences}
    assert made == set(SENTENCES)
    assert all(claim.sentences for claim in CLAIMS)


def found(value):
    return Finding(f"{value:g} N", value)


def claim_of(bound, **options):
    return Claim("a", ("F1",), "it | holds", "whole", bound, lambda trial: found(2.0), **options)


def judged(verdict, share=1.0, span=(1.7, 2.4), decides=""):
    return Judgement(verdict, share, span, decides)


@pytest.fixture
def claim():
    return claim_of(near(2.0, "N"), reason="why")


@pytest.fixture
def row(claim):
    verdicts = {
        "paper": judged("reproduced", 0.95),
        "exact": judged("not decidable", 0.5, decides="μ_f decides"),
    }
    return Row(claim, {"paper": found(2.0), "exact": found(9.0)}, verdicts)


def test_the_table_gives_formulations_bound_range_and_share(row):
    text = as_text([row])
    assert text.startswith("REPRODUCED")
    assert "2 N (1.7 to 2.4, 95 %)" in text
    assert "9 N (not decidable, 1.7 to 2.4, 50 %)" in text
    assert "1.6 to 2.5 N (we, 2026-11-21)" in text
    assert "`exact`: μ_f decides" in text


def test_what_is_not_measured_is_not_tested():
    row = Row(Claim("a", ("F1",), "it holds", "whole", near(2.0, "N"), reason="not simulated"))
    assert {row.verdict(name) for name in ("printed", "paper", "exact")} == {"not tested"}
    assert row.reason == "not simulated"


def test_what_is_measured_in_exact_only_is_not_tested_in_paper():
    row = Row(
        claim_of(near(2.0, "N"), formulations="exact"), {"exact": found(2.0)}, {"exact": judged("reproduced")}
    )
    assert (row.verdict("paper"), row.verdict("exact")) == ("not tested", "reproduced")
    assert row.found("paper") == ""
