"""Every self-check speaks from its threshold on and not before."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from tribodyn.contact import law
from tribodyn.joints.clearances import Clearance, places
from tribodyn.joints.shapes import Cylinder
from tribodyn.mechanism.results import mechanism_checks as general_checks
from tribodyn.mechanism.results.contacts import Contacts
from tribodyn.mechanisms import self_checks
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.mechanisms.self_checks import (
    AREA_LIMIT,
    CLIP_LIMIT,
    ENERGY_LIMIT,
    GRID_LIMIT,
    HARDNESS_LIMIT,
    LIFT_OFF_LIMIT,
    REJECTED_LIMIT,
    RESTART_LIMIT,
    ROUGH_LIMIT,
    instant,
)
from tribodyn.papers.cheng_2022.reduced import checks
from tribodyn.papers.cheng_2022.reduced.parameters import Vsv

T_END = 2.0
PEAK = 0.7503  #: When the pressure was largest [s].
#: Of a run with nothing to say of, by a law that knows no real area; ``depth`` in σ, ``rejected`` and
#: ``restarts`` beside a thousand steps.
SOUND = {
    "energy": 0.0,
    "clearance_energy": 0.0,
    "grid": 0.0,
    "depth": 2.0,
    "clipped": 0.0,
    "lift_off": 0.0,
    "hardness": 0.2,
    "area": math.nan,
    "rejected": 30.0,
    "restarts": 3.0,
}

CASES = [
    ("energy", ENERGY_LIMIT, 1.0, "Energy is missed"),
    ("grid", GRID_LIMIT, 1.0, "On the chosen grid"),
    ("depth", 0.0, -1.0, "mean planes of the surfaces"),
    ("clipped", CLIP_LIMIT, 1.0, "tension cut-off"),
    ("hardness", HARDNESS_LIMIT, 1.0, "of the hardness"),
    ("area", AREA_LIMIT, 1.0, "real area of contact"),
    ("rejected", 1000.0 * REJECTED_LIMIT / (1.0 - REJECTED_LIMIT), 1.0, "integrator threw away"),
    ("restarts", 1000.0 * RESTART_LIMIT, 1.0, "started anew every"),
]
ONLY_VSV = [
    ("clearance_energy", ENERGY_LIMIT, 1.0, "Energy is missed"),
    ("lift_off", LIFT_OFF_LIMIT, 1.0, "thrust collar carried nothing"),
]


def statistics(seen: dict[str, float]) -> dict[str, float]:
    return {"steps": 1000.0, "rejected": seen["rejected"], "restarts": seen["restarts"]}


def loading(seen: dict[str, float]) -> dict[str, float]:
    return {"hardness_share": seen["hardness"], "real_area_share": seen["area"]}


def of_vsv(vsv: Vsv, seen: dict[str, float], cost: dict[str, float]) -> list[str]:
    found = {
        "separation_least": seen["depth"] * vsv.joint.roughness,
        "tensile_clip_time": seen["clipped"] * T_END,
        "collar_lift_off_time": seen["lift_off"] * T_END,
        "grid_force_error": seen["grid"],
        **loading(seen),
    }
    residuals = seen["energy"], seen["clearance_energy"]
    return checks.warnings(vsv, found, *residuals, T_END, cost, instant(PEAK, np.array([0.0, 0.75]), 0.01))


def of_general(vsv: Vsv, seen: dict[str, float], cost: dict[str, float]) -> list[str]:
    joint, entry = vsv.joint, vsv.joint.entry
    pin = Clearance(
        shape=Cylinder(joint.geometry.radius, joint.geometry.clearance, 20e-3),
        grid=(12, 2),
        roughness=joint.roughness,
        law=law("rsdc", load_case("vsv").surface_pair),
        table=joint.table,
        friction_coefficient=0.1,
        slip_velocity=1e-5,
        onset=entry.onset,
        minimum_velocity=entry.minimum_velocity,
        tensile_clip=entry.tensile_clip,
        contact=joint.contact,
    )
    contacts = Contacts((pin,), (0,), ("pin:barrel",), places([pin]))
    peaks = {
        "separation_least": np.array([seen["depth"] * joint.roughness]),
        "tensile_clip_time": np.array([seen["clipped"] * T_END]),
        "pressure_peak_time": np.array([PEAK]),
    }
    found = {name: np.array([value]) for name, value in loading(seen).items()}
    found["grid_force_error"] = np.array([seen["grid"]])
    return general_checks.messages(
        general_checks.of_balance(seen["energy"], np.zeros(1)),
        contacts.warnings(peaks, found, T_END),
        cost=cost,
    )


EVERY = [of_vsv, of_general]


@pytest.mark.parametrize("told", EVERY)
def test_a_sound_run_is_silent(make_vsv: Callable[..., Vsv], told: Callable[..., list[str]]) -> None:
    assert told(make_vsv(), SOUND, statistics(SOUND)) == []


@pytest.mark.parametrize(
    ("told", "name", "limit", "way", "words"),
    [(of_vsv, *case) for case in ONLY_VSV] + [(told, *case) for told in EVERY for case in CASES],
)
def test_a_threshold_is_where_the_warning_begins(make_vsv, told, name, limit, way, words):
    for off, expected in ((-1e-6, 0), (1e-6, 1)):
        seen = SOUND | {name: limit + way * off}
        messages = told(make_vsv(), seen, statistics(seen))
        assert len(messages) == expected
        assert all(words.lower() in text.lower() and text.endswith(".") for text in messages)


@pytest.mark.parametrize("told", EVERY)
@pytest.mark.parametrize(("name", "value"), [("hardness", 0.5), ("area", 0.16)])
def test_an_overload_names_its_instant(make_vsv, told, name, value):
    (message,) = told(make_vsv(), SOUND | {name: value}, statistics(SOUND))
    assert "at t = 0.7503 s" in message
    assert ("the impact after the reversal at 0.75 s" in message) == (told is of_vsv)
    assert message.startswith("In pin:barrel") == (told is of_general)


@pytest.mark.parametrize("told", EVERY)
def test_more_than_all_of_the_area_is_no_share(make_vsv, told):
    (below,) = told(make_vsv(), SOUND | {"area": 0.99}, statistics(SOUND))
    assert "reached 99 % of the nominal one" in below
    (beyond,) = told(make_vsv(), SOUND | {"area": 7.5}, statistics(SOUND))
    assert "750 %" not in beyond
    assert "contact law has left its range" in beyond


def test_an_instant_names_the_impact_that_it_belongs_to() -> None:
    begins = np.array([0.0, 0.5, 1.0])
    assert instant(0.004, begins, 0.01) == "at t = 0.004 s, in the impact after the start"
    assert instant(0.505, begins, 0.01) == "at t = 0.505 s, in the impact after the reversal at 0.5 s"
    assert instant(0.52, begins, 0.01) == "at t = 0.52 s"
    assert instant(float("nan"), begins, 0.01) == "at an unknown time"


def test_points_of_contact_are_told_of_and_have_no_depth(make_vsv: Callable[..., Vsv]) -> None:
    vsv = make_vsv()
    vsv = replace(vsv, joint=replace(vsv.joint, contact="point-johnson"))
    seen = SOUND | {"depth": -3.0}
    for told in EVERY:
        (message,) = told(vsv, seen, statistics(seen))
        assert "no pressure field" in message


@pytest.mark.parametrize("told", EVERY)
def test_a_clearance_that_rough_surfaces_fill_is_said(make_vsv, told):
    sigma = make_vsv().joint.roughness
    for share, expected in ((ROUGH_LIMIT + 1e-6, 0), (ROUGH_LIMIT - 1e-6, 1), (0.04, 1)):
        messages = told(make_vsv(clearance=share * sigma), SOUND, statistics(SOUND))
        assert len(messages) == expected
        assert all("his is a press fit: the radial clearance" in message for message in messages)


def test_a_run_that_took_no_step_is_silent_about_steps() -> None:
    nothing: dict[str, Any] = {"steps": 0, "rejected": 0, "restarts": 0}
    assert not any(self_checks.of_steps(nothing))


def notes(
    vsv: Vsv,
    *,
    lift_off: float = 0.0,
    at_rest: float = 199e6,
    t_end: float = 4.0 * math.pi,
    carried: bool = False,
) -> list[str]:
    turns = math.pi * np.arange(math.ceil(t_end / math.pi - 1e-9))
    found = {"collar_lift_off_time": lift_off * t_end, "pressure_at_rest": at_rest}
    return checks.notes(vsv, found, 200e6, t_end, turns, carried)


def test_damping_in_the_peak_pressure_is_noted(make_vsv: Callable[..., Vsv]) -> None:
    (message,) = notes(make_vsv(), at_rest=150e6)
    assert "would carry 150 MPa" in message
    assert "200 MPa is damping" in message
    assert notes(make_vsv(), at_rest=0.0) == []  # no row, or contact at points


def test_a_short_lift_off_is_noted_in_per_cent_of_the_run(make_vsv: Callable[..., Vsv]) -> None:
    vsv = make_vsv()
    assert notes(vsv) == []
    (message,) = notes(vsv, lift_off=0.5 * LIFT_OFF_LIMIT)
    assert "for 0.05 % of the run" in message
    assert notes(vsv, lift_off=2.0 * LIFT_OFF_LIMIT) == []


@pytest.mark.parametrize("formulation", ["paper", "printed"])
def test_every_run_of_the_paper_s_equations_notes_that_they_can_gain_energy(make_vsv, formulation):
    (message,) = notes(make_vsv(formulation))
    assert message.startswith(f"The equations of formulation '{formulation}' can gain energy in an impact")
    assert "compare with mechanism.formulation = 'exact'" in message


@pytest.mark.parametrize(
    ("t_end", "carried", "held"),
    [
        (4.0 * math.pi, False, 2),
        (2.0 * math.pi, False, 1),  # what follows the second reversal, at the end, is not there
        (2.0 * math.pi + 0.32, False, 2),
        (2.0 * math.pi + 0.30, False, 1),
        (2.0 * math.pi, True, 2),  # the cycle of a campaign: its start is a reversal
        (math.pi + 0.1, False, 0),
        (3.0, False, 0),
    ],
)
def test_a_run_says_which_reversals_it_does_not_hold(make_vsv, t_end, carried, held):
    told = notes(make_vsv(), t_end=t_end, carried=carried)
    assert [message for message in told if f"holds {held} with" in message] == ([] if held == 2 else told)
    assert len(told) == (held < 2)
