"""Bodies that fixed joints make one piece: the same motion, modes and reactions as by their constraints."""

from typing import Any, Final

import numpy as np
import pytest

import tribodyn as td
from tribodyn.cases.case import Case, with_entries
from tribodyn.mechanism.assembly import pieces
from tribodyn.mechanism.assembly.parts_by_number import model_of
from tribodyn.mechanisms.catalogue import parse_case

ARM: Final = """
case = "mechanism"
gravity = "0, 0, -9.81 m/s^2"
[bodies]
arm = { mass = "2 kg", centre = "0.2, 0, 0 m", inertia = "0.01, 0.03, 0.03 kg m^2" }
head = { mass = "1 kg", centre = "0.4, 0.1, 0.05 m", inertia = "0.002, 0.003, 0.004 kg m^2" }
tool = { mass = "0.5 kg", centre = "0.45, 0.1, 0.2 m", inertia = "0.002, 0.001, 0.002 kg m^2" }
fin = { mass = "0.3 kg", centre = "0.1, -0.1, 0.1 m", inertia = "5e-4, 5e-4, 6e-4 kg m^2" }
bob = { mass = "0.7 kg", centre = "0.45, 0.1, 0.1 m", inertia = "1e-3, 1e-3, 1e-3 kg m^2" }
[joints]
neck = { type = "fixed", between = ["head", "arm"], point = "0.3, 0, 0 m" }
grip = { type = "fixed", between = ["head", "tool"], point = "0.42, 0.1, 0.1 m", axis = [1, 1, 0] }
root = { type = "fixed", between = ["arm", "fin"], point = "0.1, -0.05, 0.05 m" }
swing = { type = "revolute", between = ["tool", "bob"], point = "0.45, 0.1, 0.25 m", axis = [1, 0, 0] }
[joints.hinge]
type = "revolute"
between = ["ground", "arm"]
point = "0, 0, 0 m"
axis = [0, 1, 0.2]
[springs.band]
between = ["fin", "ground"]
first_point = "0.1, -0.1, 0.15 m"
second_point = "0.2, -0.5, 0.4 m"
stiffness = "50 N/m"
damping = "2 N s/m"
[loads]
push = { body = "tool", frame = "body", point = "0.45, 0.1, 0.3 m", force = "3 N", direction = [0, 1, 0] }
pull = { body = "head", point = "0.45, 0.1, 0.3 m", force = "2 N", direction = [1, 1, 0] }
[outputs.tip]
quantity = "position"
body = "tool"
along = [0, 0, 1]
[outputs.fin]
quantity = "velocity"
body = "fin"
point = "0.1, -0.1, 0.15 m"
reference = "bob"
along = [0, 0, 1]
[solver]
rtol = 1e-9
[run]
duration = "0.3 s"
output_interval = "10 ms"
"""
DRIVEN: Final = """
[drives.motor]
joint = "hinge"
angle = { swing = "30 deg", angular_frequency = "5 rad/s" }
"""
SPRUNG: Final = """
[joints.coil]
type = "spring-damper"
between = ["tool", "bob"]
point = "0.45, 0.1, 0.25 m"
axis = [1, 0, 0]
stiffness = "0, 0, 0 N/m"
angular_stiffness = "0, 0, 3 N m/rad"
angular_damping = "0, 0, 0.1 N m s/rad"
"""
SWUNG: Final = """
[drives.other]
joint = "swing"
angle = { swing = "20 deg", angular_frequency = "5 rad/s" }
"""
LOOSE: Final = """
[joints.hinge.clearance]
radius = "10 mm"
radial = "20 um"
length = "30 mm"
axial = "20 um"
"""
RUNS: Final[dict[str, tuple[str, dict[str, Any]]]] = {
    "dynamic": ("", {}),
    "driven": (DRIVEN + SPRUNG, {}),
    "loose": (
        LOOSE,
        {
            "solver.rtol": 1e-7,
            "run.duration": "4 ms",
            "run.output_interval": "1 ms",
            "run.step_rows": 0,
            "run.start": "centred",
        },
    ),
    "vibrations": (DRIVEN + SPRUNG, {"run.analysis": "vibrations", "run.positions": 3}),
    "static": (DRIVEN + SPRUNG, {"run.analysis": "static", "run.positions": 5}),
    "kinematic": (DRIVEN + SWUNG, {"run.analysis": "kinematic", "run.positions": 5}),
}


def arm(more: str = "", changes: dict[str, Any] | None = None) -> Case:
    """Return the arm with further tables, and other keys."""
    return with_entries(parse_case(ARM + more, "arm"), changes or {}, "arm")


def pieces_in(case: Case) -> list[list[str]]:
    """Return the bodies of each piece of a case."""
    return [list(members) for members in model_of(case).pieces.members.values()]


@pytest.mark.parametrize("run", RUNS)
def test_a_piece_moves_and_reacts_as_its_bodies_in_fixed_joints_do(run, monkeypatch):
    case = arm(*RUNS[run])
    one = td.simulate(case)
    monkeypatch.setattr(pieces, "_joins", lambda joint: False)
    several = td.simulate(case)
    assert one["body"].values.tolist() == list(case.bodies)
    # Works, impulses and peaks belong to the steps of each run; a contact begins at the end of one.
    bound = 1e-3 if run == "loose" else 3e-5
    least = {"N": 1e-6, "N m": 1e-7, "N s": 1e-7, "J": 1e-6}
    compared = 0
    for name, known in several.variables.items():
        if known.dtype.kind != "f" or not np.isfinite(known).any() or name == "energy_residual":
            continue
        own = 1e-3 if "impulse" in name else 1e-2 if "peak" in name else bound
        scale, floor = float(np.nanmax(np.abs(known))), least.get(known.attrs.get("units", ""), 1e-9)
        assert one[name].values == pytest.approx(known.values, abs=own * scale + floor, nan_ok=True), name
        compared += scale > floor
    assert compared >= 20


def test_a_fixed_joint_carries_weight_and_what_holds_a_circle():
    text = """
    case = "mechanism"
    gravity = "0, 0, -9.81 m/s^2"
    [bodies]
    hub = { mass = "1 kg", centre = "0, 0, 0 m", inertia = "0.01, 0.01, 0.01 kg m^2" }
    ball = { mass = "2 kg", centre = "0.3, 0, 0 m", inertia = "0.02, 0.02, 0.02 kg m^2" }
    [joints]
    axle = { type = "revolute", between = ["ground", "hub"], point = "0, 0, 0 m", axis = [0, 0, 1] }
    rod = { type = "fixed", between = ["hub", "ball"], point = "0.1, 0, 0 m" }
    [drives.motor]
    joint = "axle"
    speed = "10 rad/s"
    [run]
    duration = "0.1 s"
    """
    found = td.simulate(parse_case(text, "hub")).sel(joint="rod")
    # In the axes of the joint, which turn with the hub: 2 kg at 0.3 m and 10 rad/s, with its weight.
    assert found["reaction_force"].values == pytest.approx(
        np.tile([-60.0, 0.0, 19.62], (found.time.size, 1)), rel=1e-6
    )
    assert found["reaction_moment"].values == pytest.approx(
        np.tile([0.0, -3.924, 0.0], (found.time.size, 1)), abs=1e-6
    )


def test_pieces_are_bodies_in_fixed_joints_and_nothing_else():
    whole = ["arm", "head", "tool", "fin"]
    assert pieces_in(arm()) == [whole, ["bob"]]
    # What else acts between two pieces, would act within one.
    apart = [["arm", "fin"], ["head", "tool"], ["bob"]]
    twice = 'twice = { type = "spherical", between = ["arm", "tool"], point = "0.3, 0, 0 m" }'
    assert pieces_in(parse_case(ARM.replace("[joints]", f"[joints]\n{twice}"), "arm")) == [
        ["arm", "head", "fin"],
        ["tool"],
        ["bob"],
    ]
    assert pieces_in(arm(changes={"joints.neck.other_point": "0.3, 0, 1e-6 m"})) == apart
    off = arm(changes={"joints.neck.deviation": "0, 0, 1 um"})
    assert pieces_in(off) == apart
    assert model_of(off).in_place.bodies == ("arm", "head", "bob")
    # A drive turns about the axis of the bore, and what it gives a leaning pin across is not observed.
    assert pieces_in(arm(DRIVEN + LOOSE)) == [["arm"], ["head", "tool"], ["fin"], ["bob"]]
    post = 'post = { type = "fixed", between = ["ground", "bob"], point = "0, 0, 0 m" }'
    assert pieces_in(parse_case(ARM.replace("[joints]", f"[joints]\n{post}"), "arm")) == [whole, ["bob"]]
