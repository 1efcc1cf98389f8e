"""The ensemble on which every verdict stands: what the paper leaves open and what is ours, varied together.

Members are the rows of an orthogonal array: each level of a factor meets each level of every other one
equally often. The time left out after a reversal and our bounds need no runs and meet all members. The
numbers found are kept in ``ensemble.json``, which ``tribodyn reproduce ensemble`` makes.
"""

import json
import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any, Final, TypeAlias

import numpy as np

from tribodyn.papers.cheng_2022.claims.base import Bound, Claim, Verdict, of_span
from tribodyn.papers.cheng_2022.runs import JOINTS
from tribodyn.papers.cheng_2022.undamped import ATOL

#: Measure of a claim: a number, two where the paper does not say which is meant, none without a run.
Number: TypeAlias = float | tuple[float, float] | None
Level: TypeAlias = Mapping[str, Mapping[str, object]]  #: Changes of built-in cases, by their names.

FILE: Final = "ensemble.json"
STANDS: Final = 0.9  #: Share of the members that must agree for a verdict to stand.
#: Times after a reversal that are no smooth motion [s]; the first is a tenth of a stroke, 0.31 s.
LEFT_OUT: Final = (None, 0.5, 0.8)
SCALES: Final = (1.0, 0.5, 2.0)  #: Factors of bounds that are ours.
VSV, ALL_JOINTS, JOURNALS = "vsv", "vsv-joints", ("journal-dry", "journal-oil")
_RTOL: Final = {VSV: 1e-3, ALL_JOINTS: 1e-5, "journal-dry": 1e-7, "journal-oil": 1e-6}


def _everywhere(**changes: object) -> Level:
    named = {path.replace("__", "."): value for path, value in changes.items()}
    return dict.fromkeys((VSV, ALL_JOINTS, *JOURNALS), named)


def _tolerance(factor: float) -> Level:
    """Return all tolerances smaller by a factor than those of the cases."""
    atol = {f"solver.atol.{name}": f"{value / factor:.6g} {unit}" for name, (value, unit) in ATOL.items()}
    found = {name: {"solver.rtol": rtol / factor} for name, rtol in _RTOL.items()}
    return {**found, VSV: {**found[VSV], **atol}}


def _friction(value: float) -> Level:
    return {VSV: {"joint.friction_coefficient": value}, ALL_JOINTS: {"friction_coefficient": value}}


#: Factors with their levels; the first level is the default.
FACTORS: Final[dict[str, dict[str, Level]]] = {
    "grid": {"by clearance": {}, "96 × 16": _everywhere(solver__grid__theta=96, solver__grid__z=16)},
    "tolerance": {"default": {}, "a tenth": _tolerance(10.0), "a hundredth": _tolerance(100.0)},
    "v_min": {
        f"{speed} mm/s": _everywhere(contact__minimum_entry_velocity=f"{speed} mm/s")
        for speed in ("1", "0.1", "5")
    },
    "μ_f": {f"{value}": _friction(value) for value in (0.1, 0.05, 0.2)},
    "guide": {
        length: {ALL_JOINTS: {"joints.guide.clearance.length": length}}
        for length in ("10 mm", "5 mm", "40 mm")
    },
    "solver": {"mebdf": {}, "mebdf again": {}, "radau": {VSV: {"solver.name": "radau"}}},
}
#: Levels of tolerance, v_min, μ_f, guide and solver, by grid: the orthogonal array of 18 rows.
_ARRAY: Final = (
    "00000 01111 02222 10011 11122 12200 20102 21210 22021",
    "00221 01002 02110 10120 11201 12012 20212 21020 22101",
)
VARIED: Final = ("tolerance", "v_min", "μ_f", "guide", "solver")


@dataclass(frozen=True)
class Member:
    """One choice of all factors, by their names."""

    levels: Mapping[str, str]

    def changes(self, *, leave: Sequence[str] = ()) -> dict[str, dict[str, object]]:
        """Return the keys that it changes, by the names of built-in cases; some factors left as they are."""
        found: dict[str, dict[str, object]] = {}
        for factor, level in self.levels.items():
            for case, changes in ({} if factor in leave else FACTORS[factor][level]).items():
                found.setdefault(case, {}).update(changes)
        for joint in JOINTS:
            if found.get(ALL_JOINTS) and "friction_coefficient" in found[ALL_JOINTS] and joint != "guide":
                value = found[ALL_JOINTS]["friction_coefficient"]
                found[ALL_JOINTS][f"joints.{joint}.clearance.friction_coefficient"] = value
        return found


def _members() -> tuple[Member, ...]:
    named = {factor: list(levels) for factor, levels in FACTORS.items()}
    return tuple(
        Member({"grid": grid, **{name: named[name][int(k)] for name, k in zip(VARIED, row, strict=True)}})
        for grid, rows in zip(named["grid"], _ARRAY, strict=True)
        for row in rows.split()
    )


MEMBERS: Final = _members()  #: The first has every default.
SLOW_MEMBERS: Final = (0, 1, 2)  #: Members on which claims are measured whose runs take minutes.


@dataclass(frozen=True)
class Judgement:
    """Verdict of the ensemble on a claim in one formulation."""

    verdict: Verdict  #: That of nine tenths of the members, or *not decidable*.
    share: float  #: Share of the members with the most frequent verdict.
    span: tuple[float, float]  #: Least and largest number; NaN where no member has one.
    decides: str = ""  #: The choice that decides where no verdict stands, in words.
    margin: float = 0.0  #: What the number must pass its limit by, in its unit; 0 where words ask for none.


@cache
def kept() -> dict[str, dict[str, dict[str, Any]]]:
    """Return the kept numbers by member, and the default in words, by claim and formulation."""
    found: dict[str, dict[str, dict[str, Any]]] = json.loads(
        files(__package__).joinpath(FILE).read_text(encoding="utf-8")
    )
    return found


def judgement(claim: Claim, formulation: str) -> Judgement | None:
    """Return the verdict of the kept ensemble on a claim; none where it is not measured."""
    found = kept().get(claim.name, {}).get(formulation)
    if found is None:
        return None
    return judge(claim, {int(member): row for member, row in found["numbers"].items()})


def judge(claim: Claim, numbers: Mapping[int, Sequence[Number]]) -> Judgement:
    """Return the verdict of numbers by member and time left out on a claim."""
    bound, margin = claim.bound, 0.0
    if claim.margin:
        margin = scatter({member: row[0] for member, row in numbers.items()})
        bound = bound.with_margin(margin)
    scales = SCALES if bound.by == "we" else SCALES[:1]
    each: dict[tuple[int, int, float], Verdict] = {
        (member, late, scale): _verdict(bound.scaled(scale), number)
        for member, row in numbers.items()
        for late, number in enumerate(row)
        for scale in scales
    }
    leading, count = Counter(each.values()).most_common(1)[0]
    share = count / len(each)
    span = _span([number for row in numbers.values() for number in row])
    if share < STANDS:
        return Judgement("not decidable", share, span, _deciding(each, leading), margin)
    if leading == "reproduced" and claim.condition:
        leading = "on a condition"
    return Judgement(leading, share, span, "", margin)


def _verdict(bound: Bound, number: Number) -> Verdict:
    if number is None:
        return "contradicted"
    if isinstance(number, float | int):
        return bound.verdict(number)
    return of_span(bound, (number[0], number[1]))


def _span(numbers: Sequence[Number]) -> tuple[float, float]:
    flat = [
        value
        for number in numbers
        if number is not None
        for value in (number if isinstance(number, Sequence) else (number,))
    ]
    return (min(flat), max(flat)) if flat else (math.nan, math.nan)


def scatter(numbers: Mapping[int, Number]) -> float:
    """Return the standard deviation of numbers by member, the effects of v_min and μ_f taken off."""
    found = {member: float(number) for member, number in numbers.items() if isinstance(number, float | int)}
    if len(found) < len(MEMBERS):
        return 0.0
    left = np.array([found[member] for member in range(len(MEMBERS))])
    freedoms = left.size - 1
    left = left - left.mean()
    for factor in ("v_min", "μ_f"):
        levels = np.array([member.levels[factor] for member in MEMBERS])
        for level in FACTORS[factor]:
            left[levels == level] -= left[levels == level].mean()
        freedoms -= len(FACTORS[factor]) - 1
    return float(np.sqrt(np.sum(left**2) / freedoms))


def _deciding(each: Mapping[tuple[int, int, float], Verdict], leading: Verdict) -> str:
    """Return the choice that moves the share of the most frequent verdict most, with the shares."""
    levels: dict[str, dict[str, list[bool]]] = {}
    for (member, late, scale), verdict in each.items():
        chosen = dict(MEMBERS[member].levels)
        chosen["solver"] = chosen["solver"].removesuffix(" again")
        chosen["time left out"] = f"{LEFT_OUT[late] or 0.31} s"
        chosen["our bound"] = f"times {scale:g}"
        for factor, level in chosen.items():
            levels.setdefault(factor, {}).setdefault(level, []).append(verdict == leading)
    shares = {
        factor: {level: float(np.mean(holds)) for level, holds in of.items()} for factor, of in levels.items()
    }
    factor = max(shares, key=lambda name: max(shares[name].values()) - min(shares[name].values()))
    parts = ", ".join(f"{100.0 * share:.0f} % with {level}" for level, share in shares[factor].items())
    return f"{factor} decides: {leading} in {parts}"
