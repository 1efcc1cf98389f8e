"""The ensemble on which verdicts stand: its members, what they make of a claim, and the kept file."""

import itertools
import math
from collections import Counter

import pytest

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.papers.cheng_2022.claims import CLAIMS, Claim, kept_rows, summary
from tribodyn.papers.cheng_2022.claims.base import IN, SLOW, Bound, above, below, near
from tribodyn.papers.cheng_2022.claims.ensemble import (
    FACTORS,
    LEFT_OUT,
    MEMBERS,
    SLOW_MEMBERS,
    judge,
    kept,
    scatter,
)

EVERY = range(len(MEMBERS))


def claim_of(bound, **options):
    return Claim("a", ("F1",), "it holds", "whole", bound, **options)


def numbers(of_member, of_time=lambda late: 0.0):
    """Return numbers by member and time left out."""
    return {k: [of_member(MEMBERS[k].levels) + of_time(late) for late in LEFT_OUT] for k in EVERY}


def test_every_level_meets_every_level_of_every_other_factor_equally_often():
    for one, other in itertools.combinations(FACTORS, 2):
        pairs = Counter((member.levels[one], member.levels[other]) for member in MEMBERS)
        assert len(pairs) == len(FACTORS[one]) * len(FACTORS[other])
        assert len(set(pairs.values())) == 1


def test_the_first_member_has_the_defaults_and_every_change_is_a_key():
    for case, changes in MEMBERS[0].changes().items():
        assert load_case(case).replace(changes) == load_case(case)
    for member in MEMBERS:
        for case, changes in member.changes().items():
            assert load_case(case).replace(changes)
        assert "solver.name" not in member.changes(leave=SLOW).get("vsv", {})


def test_a_verdict_of_nine_tenths_stands():
    bound = above(1.0, by="the paper")
    found = judge(claim_of(bound), numbers(lambda levels: 2.0))
    assert (found.verdict, found.share, found.span) == ("reproduced", 1.0, (2.0, 2.0))
    one_off = numbers(lambda levels: 2.0) | {4: [0.0, 0.0, 0.0]}
    assert judge(claim_of(bound), one_off).verdict == "reproduced"
    assert judge(claim_of(bound), one_off | {5: [0.0, 0.0, 0.0]}).verdict == "not decidable"


@pytest.mark.parametrize("factor", ["μ_f", "v_min", "grid", "tolerance", "solver"])
def test_what_decides_is_named(factor):
    level = list(FACTORS[factor])[-1]
    found = judge(
        claim_of(above(1.0, by="the paper")), numbers(lambda levels: 0.0 if levels[factor] == level else 2.0)
    )
    assert found.verdict == "not decidable"
    assert found.decides.startswith(f"{factor} decides: reproduced in 100 % with")
    assert f"0 % with {level}" in found.decides


def test_the_time_left_out_and_our_bounds_meet_all_members():
    late = judge(
        claim_of(above(1.0, by="the paper")), numbers(lambda levels: 0.0, lambda late: 4.0 * (late or 0.0))
    )
    assert late.share == pytest.approx(2.0 / 3.0)
    assert late.decides.startswith("time left out decides")
    # 3 is below 5, not below 2.5, and below 10; a bound of the paper stays.
    ours = judge(claim_of(below(5.0)), numbers(lambda levels: 3.0))
    assert ours.decides.startswith("our bound decides: reproduced in 100 % with times 1, 0 % with times 0.5")
    assert judge(claim_of(below(5.0, by="the paper")), numbers(lambda levels: 3.0)).verdict == "reproduced"


def test_a_run_that_ends_early_contradicts():
    found = judge(claim_of(near(2.0, "N")), {k: [None] * 3 for k in EVERY})
    assert (found.verdict, found.share) == ("contradicted", 1.0)
    assert math.isnan(found.span[0])


@pytest.mark.parametrize(
    ("span", "verdict"),
    [
        ((1.9, 2.1), "reproduced"),
        ((0.1, 9.0), "not decidable"),
        ((2.0, 3.0), "not decidable"),
        ((8.5, 9.0), "contradicted"),
    ],
)
def test_of_several_numbers_the_paper_does_not_say_which(span, verdict):
    bound = Bound((1.6, 2.5), (1.0, 4.0), "N", "the paper")
    assert judge(claim_of(bound), {k: [span] * 3 for k in EVERY}).verdict == verdict


def test_what_holds_on_a_condition_says_so():
    bound = above(1.0, by="the paper")
    assert (
        judge(claim_of(bound, condition="if cheese"), numbers(lambda levels: 2.0)).verdict == "on a condition"
    )
    # A condition saves nothing that does not come out.
    assert (
        judge(claim_of(bound, condition="if cheese"), numbers(lambda levels: 0.0)).verdict == "contradicted"
    )


def test_always_asks_for_more_than_the_scatter():
    def number(levels):
        return {"by clearance": 0.16, "96 × 16": -0.14}[levels["grid"]]

    # Every number is 0.15 from the mean; of 18 members 13 freedoms are left beside mean, v_min and μ_f.
    apart = 0.15 * math.sqrt(18.0 / 13.0)
    assert scatter({k: number(MEMBERS[k].levels) for k in EVERY}) == pytest.approx(apart)
    bound = above(0.0, by="the paper")
    plain, always = (judge(claim_of(bound, margin=on), numbers(number)) for on in (False, True))
    assert (plain.verdict, always.verdict) == ("not decidable", "differs")
    assert always.margin == pytest.approx(apart)
    # What friction changes is no scatter.
    assert judge(claim_of(bound, margin=True), numbers(lambda levels: float(levels["μ_f"]))).margin < 1e-12


@pytest.mark.parametrize("claim", [claim for claim in CLAIMS if claim.measure], ids=lambda claim: claim.name)
def test_the_kept_file_has_every_claim_on_every_member(claim):
    members = SLOW_MEMBERS if claim.leave == SLOW else EVERY
    assert list(kept()[claim.name]) == list(IN[claim.formulations])
    for found in kept()[claim.name].values():
        assert found["text"]
        assert [int(member) for member in found["numbers"]] == list(members)
        assert {len(row) for row in found["numbers"].values()} == {len(LEFT_OUT)}


def test_counts_are_those_of_the_kept_file():
    rows = kept_rows(CLAIMS)
    counts = summary.summarise(rows)
    for name in ("paper", "exact"):
        assert sum(counts["by_row"][name].values()) == len(CLAIMS)
        assert sum(counts["by_sentence"][name].values()) == counts["sentences"]
    assert {row.verdict("printed") for row in rows if row.claim.formulations == "all"} != {"not tested"}
