"""Claims of the paper: verdicts, tables, and what is measured for them."""

import math

import numpy as np
import pytest
import xarray as xr

from tribodyn.papers.cheng_2022.claims import CLAIMS, Claim, Finding, Row, as_text
from tribodyn.papers.cheng_2022.claims.base import CLOSE, NEAR, SENTENCES, VERDICTS, above, below, near
from tribodyn.papers.cheng_2022.claims.ensemble import Judgement
from tribodyn.papers.cheng_2022.claims.errors import speed_trend
from tribodyn.papers.cheng_2022.claims.journal import fall_time, late_motion
from tribodyn.papers.cheng_2022.claims.pressure import ZONE, contact_arc
from tribodyn.papers.cheng_2022.claims.summary import as_markdown as counts_as_markdown
from tribodyn.papers.cheng_2022.claims.summary import by_sentence, summarise
from tribodyn.papers.cheng_2022.runs import joined


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


@pytest.mark.parametrize("n", [48, 96, 720])
@pytest.mark.parametrize("middle", [-10.0, 180.0])
def test_ends_of_contact_lie_between_nodes(n, middle):
    theta = 2.0 * np.pi * np.arange(n) / n
    away = (np.degrees(theta) - middle + 180.0) % 360.0 - 180.0
    first, last = contact_arc(theta, 3e6 * np.exp(-np.abs(away - 7.0) / 11.0), middle)
    # Pressure falls by a factor with each degree: between nodes on either side the line is exact, but that
    # the peak itself may lie between nodes.
    reach = 11.0 * np.log(1.0 / ZONE)
    assert first == pytest.approx(middle + 7.0 - reach, abs=180.0 / n)
    assert last == pytest.approx(middle + 7.0 + reach, abs=180.0 / n)


def test_the_trend_of_the_speed_forgets_what_rings():
    period = 2.0 * np.pi
    time = np.arange(0.0, 2.0 * period, 5e-3)
    trend, ringing = 2e-3, 1e-4 * np.sin(2.0 * np.pi * 20.0 * time)
    angle = np.radians(trend * time + ringing)
    run = xr.Dataset(
        {"theta_v": ("time", angle), "theta_v_ideal": ("time", np.zeros_like(time))},
        coords={"time": time},
        attrs={"cycle_period": period, "impact_time": 0.3},
    )
    # Its speed rings by 0.0126 °/s, six times the trend; four of its periods are averaged.
    assert speed_trend(run) == pytest.approx(trend, rel=1e-3)


def test_the_fall_of_a_force_is_timed_between_rows():
    time = np.arange(0.0, 0.05, 5e-5)
    force = np.exp(-time / 4e-3)
    run = xr.Dataset({"F_ox": ("time", -force), "F_oy": ("time", 0.0 * force)}, coords={"time": time})
    # ln 9 time constants; lines between rows 50 µs apart bend by a thousandth of that.
    assert fall_time(run) == pytest.approx(4.0 * np.log(9.0), rel=1e-3)


def test_the_late_motion_is_that_of_the_coordinate_that_moves_more():
    time = np.linspace(0.0, 1.0, 101)
    run = xr.Dataset(
        {"e_x": ("time", 1e-6 * time), "e_y": ("time", 3e-6 * time)},
        coords={"time": time},
        attrs={"clearance": 20e-6},
    )
    assert late_motion(run) == pytest.approx(100.0 * 0.2 * 3.0 / 20.0)


def test_runs_with_rows_of_their_own_come_side_by_side():
    def run(time):
        time = np.array(time)
        return xr.Dataset(
            {"a": ("time", 2.0 * time), "b": ("z", np.ones(2)), "c": (("time", "z"), np.outer(time, [1, 3]))},
            coords={"time": time, "z": [0.0, 1.0]},
        )

    whole = joined([run([0.0, 1.0, 3.0]), run([0.0, 2.0, 3.0])], xr.Variable("law", ["x", "y"]))
    assert whole["time"].values.tolist() == [0.0, 1.0, 2.0, 3.0]
    assert whole["a"].dims == ("law", "time")
    np.testing.assert_allclose(whole["a"].values, 2.0 * np.array([[0.0, 1.0, 2.0, 3.0]] * 2), rtol=1e-15)
    np.testing.assert_allclose(whole["c"].values[1], np.outer([0.0, 1.0, 2.0, 3.0], [1, 3]), rtol=1e-15)


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
