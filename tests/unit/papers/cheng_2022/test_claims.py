import json
import math

import pytest

from tribodyn.papers.cheng_2022.claims import CLAIMS, Claim, Finding, Row, as_json, as_markdown, as_text
from tribodyn.papers.cheng_2022.claims.base import SENTENCES
from tribodyn.papers.cheng_2022.claims.bounds import CLOSE, NEAR, VERDICTS, above, below, near
from tribodyn.papers.cheng_2022.claims.ensemble import Judgement
from tribodyn.papers.cheng_2022.claims.summary import as_markdown as counts_as_markdown
from tribodyn.papers.cheng_2022.claims.summary import by_sentence, summarise


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


def test_the_markdown_table_keeps_its_columns(row):
    untested = Claim("b", ("F1",), "untested", "whole", near(1.0, "N"), reason="later")
    lines = as_markdown([row, Row(untested)]).splitlines()
    assert {line.replace("\\|", "").count("|") for line in lines} == {7}


def test_the_json_table_is_plain(row):
    [entry] = json.loads(json.dumps(as_json([row]), allow_nan=False))
    assert entry["verdict"] == "reproduced"
    assert entry["exact_verdict"] == "not decidable"
    assert entry["printed_verdict"] == "not tested"
    assert entry["bound_chosen_by"] == "we"
    assert entry["bound_chosen_on"] == "2026-11-21"
    assert entry["domain"] == "whole"


def test_what_is_not_measured_is_not_tested():
    row = Row(Claim("a", ("F1",), "it holds", "whole", near(2.0, "N"), reason="not simulated"))
    assert {row.verdict(name) for name in ("printed", "paper", "exact")} == {"not tested"}
    assert row.reason == "not simulated"


def test_a_claim_on_no_mechanism_has_one_finding():
    claim = claim_of(near(2.0, "N"), formulations="alike")
    row = Row(claim, {"paper": found(9.0)}, {"paper": judged("contradicted")})
    assert row.verdict("paper") == row.verdict("exact") == "contradicted"
    assert row.found("exact") == "alike"


def test_what_is_measured_in_exact_only_is_not_tested_in_paper():
    row = Row(
        claim_of(near(2.0, "N"), formulations="exact"), {"exact": found(2.0)}, {"exact": judged("reproduced")}
    )
    assert (row.verdict("paper"), row.verdict("exact")) == ("not tested", "reproduced")
    assert row.found("paper") == ""


def test_scaled_bounds_keep_their_origin_and_the_paper_s_stay():
    assert near(2.0, "N").scaled(2.0).full == pytest.approx((2.0 / 1.5, 3.0))
    assert near(2.0, "N").scaled(0.5).partly == pytest.approx((2.0 / 1.5, 3.0))
    assert above(90.0, "%", partly=50.0, origin=100.0).scaled(2.0).full[0] == 80.0
    assert below(5.0, "%", partly=20.0).scaled(0.5).partly[1] == 10.0
    assert above(1.0, by="the paper").scaled(2.0) == above(1.0, by="the paper")


def test_counts_by_row_and_by_sentence(claim, row):
    def other(claim, verdict):
        return Row(claim, {}, {"paper": judged(verdict), "exact": judged("reproduced")})

    everything = Claim("c", tuple(SENTENCES), "all", "whole", above(0.0))
    rows = [row, other(claim_of(below(5.0)), "reproduced"), other(claim, "contradicted")]
    rows += [other(everything, "reproduced")]
    counts = summarise(rows)
    assert counts["by_row"]["paper"] == dict.fromkeys(VERDICTS, 0) | {"reproduced": 3, "contradicted": 1}
    # The least favourable verdict of its rows is that of the sentence.
    assert by_sentence(rows, "paper")["F1"] == "contradicted"
    assert by_sentence(rows, "exact")["F1"] == "not decidable"
    assert counts["by_sentence"]["paper"]["reproduced"] == len(SENTENCES) - 1
    assert (counts["favourable"], counts["favourable_by_our_bounds"]) == (3, 3)
    text = counts_as_markdown(counts)
    assert f"| contradicted | {VERDICTS['contradicted']} | 1 | 0 | 1 | 0 |" in text
