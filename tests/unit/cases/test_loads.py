"""Drives and loads as Python functions: what tables they make, and which are refused."""

from collections.abc import Callable
from typing import Any, Literal

import numpy as np
import pytest

import tribodyn as td
from tribodyn.cases import Case
from tribodyn.cases.fields import choice
from tribodyn.cases.loads import with_functions
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import parse_case
from tribodyn.papers.cheng_2022.reduced.system import vsv_of

CASE = td.load_case("vsv").replace({"run.duration": "0.4 s"})


def moment(theta_v: Any, t: Any) -> Any:
    return 0.6 * np.sin(2.0 * theta_v) * (1.0 + 0.2 * np.cos(4.0 * t))


def at(case: Any, target: int, t: float, theta_v: float) -> float:
    """Return a load of a case from the singular vectors of its map."""
    total = 0.0
    for term in vsv_of(case).terms:
        value = 1.0 if term.target == target else 0.0
        for signal, over in term.factors:
            from scipy.interpolate import PPoly

            value *= float(PPoly(signal.coefficients, signal.knots)([t, theta_v][over]))
        total += value
    return total


def test_a_function_of_two_arguments_becomes_its_map() -> None:
    case = with_functions(CASE, None, {"moment": moment})
    for t, theta_v in ((0.05, 1.08), (0.31, 1.07), (0.2, 1.1)):
        # What the surface may miss, 1e-5 of 0.72 N m.
        assert at(case, 5, t, theta_v) == pytest.approx(moment(theta_v, t), abs=1e-5)
    assert case.loads.air_moment == 0.0  # type: ignore[attr-defined]
    assert CASE.loads.air_moment == 0.84  # type: ignore[attr-defined]
    assert parse_case(case.to_toml(), "again") == case


def test_a_drive_comes_first_and_loads_see_its_range() -> None:
    seen: list[float] = []

    def force(theta_v: Any) -> Any:
        seen.extend(np.degrees(theta_v))
        return theta_v

    case = with_functions(CASE, lambda t: np.radians(-10.0 + 50.0 * t**2), {"force_x": force})
    # The ideal vane turns from 73.2° at −10° to 87.2° at −2°.
    assert min(seen) == pytest.approx(73.165 - np.degrees(0.01), abs=0.05)
    assert max(seen) == pytest.approx(87.0 + np.degrees(0.01), abs=0.5)
    assert case.crank.angle(np.array([0.2])) == pytest.approx(np.radians(-8.0), abs=1e-9)  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("drive", "loads", "words"),
    [
        (None, {"weight": lambda t: t}, "no load 'weight'"),
        (None, {"moment": lambda x: x}, "its arguments are x; allowed are t, theta_v, theta_a"),
        (None, {"moment": lambda theta_v, theta_a: theta_v}, "its arguments are"),
        (None, {"moment": lambda: 1.0}, "its arguments are"),
        (None, {"moment": 3.0}, "a function is needed"),
        (None, {"moment": lambda t: t[:3]}, "a finite number for each of 33"),
        (None, {"moment": lambda t: t * np.nan}, "a finite number for each of 33"),
        (None, {"moment": lambda t: np.abs(t - 0.13)}, "a row twice where it kinks"),
        (lambda theta_v: theta_v, None, "a function of the time t"),
        (lambda t: 3.0 * t, None, "the mechanism reaches only"),
    ],
)
def test_what_is_no_drive_or_load_is_refused(drive: Any, loads: Any, words: str) -> None:
    with pytest.raises(InputError, match=words):
        with_functions(CASE.replace({"run.duration": "2 s"}), drive, loads)


class Plain(Case):
    """A kind of case without drives and loads."""

    case: Literal["plain"] = choice("plain", "the kind of system", "")


def test_a_case_without_doors_says_so() -> None:
    function: Callable[..., Any] = np.sin
    with pytest.raises(InputError, match='of the kind "plain" takes no functions'):
        with_functions(Plain(), function, None)
