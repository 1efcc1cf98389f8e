"""The slider-crank of the specification as a file and as calls, for tests."""

import re

from tribodyn.cases.load import parse
from tribodyn.mechanism.builder.mechanism_builder import Mechanism
from tribodyn.mechanism.mechanism_case import MechanismCase

FILE = """
case = "mechanism"
title = "Slider-crank with a worn wrist pin"
gravity = ["0 m/s^2", "-9.81 m/s^2", "0 m/s^2"]

[bodies.crank]
mass = "0.30 kg"
centre = ["0 mm", "0 mm", "0 mm"]
inertia = ["1e-4 kg m^2", "1e-4 kg m^2", "1e-4 kg m^2"]
[bodies.rod]
mass = "0.21 kg"
centre = ["110 mm", "0 mm", "0 mm"]
inertia = ["2e-5 kg m^2", "2.5e-4 kg m^2", "2.5e-4 kg m^2"]
[bodies.slider]
mass = "0.14 kg"
centre = ["170 mm", "0 mm", "0 mm"]
inertia = ["1e-4 kg m^2", "1e-4 kg m^2", "1e-4 kg m^2"]

[joints.main]
type = "revolute"
between = ["ground", "crank"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [0, 0, 1]
[joints.pin]
type = "revolute"
between = ["crank", "rod"]
point = ["50 mm", "0 mm", "0 mm"]
axis = [0, 0, 1]
[joints.wrist]
type = "revolute"
between = ["rod", "slider"]
point = ["170 mm", "0 mm", "0 mm"]
axis = [0, 0, 1]
[joints.wrist.clearance]
radius = "9.5 mm"
radial = "20 um"
length = "20 mm"
axial = "50 um"
flange = "14 mm"
pair = "steel-polyimide"
[joints.guide]
type = "prismatic"
between = ["ground", "slider"]
point = ["170 mm", "0 mm", "0 mm"]
axis = [1, 0, 0]

[pairs.steel-polyimide.contact]
law = "gw"
restitution = 0.8

[drives.motor]
joint = "main"
speed = "5000 rpm"
[loads.gas]
body = "slider"
direction = [-2, 0, 0]
force = { value = "100 N", amplitude = "50 N", angular_frequency = "10 rad/s" }
[springs.return]
between = ["ground", "rod"]
first_point = ["110 mm", "100 mm", "0 mm"]
second_point = ["110 mm", "0 mm", "0 mm"]
stiffness = "2 N/mm"

[run]
cycles = 2
"""


#: The same with all joints ideal.
IDEAL = re.sub(r"\[joints.wrist.clearance\].*?(?=\[joints)", "", FILE, flags=re.DOTALL)


def parsed(text: str = FILE) -> MechanismCase:
    """Return the case of a text."""
    case = parse(text, "mine.toml", {"mechanism": MechanismCase})
    assert isinstance(case, MechanismCase)
    return case


def built() -> MechanismCase:
    """Return the same, built in Python."""
    small = "1e-4, 1e-4, 1e-4 kg m^2"
    across = [0, 0, 1]
    return (
        Mechanism("Slider-crank with a worn wrist pin", gravity="0, -9.81, 0 m/s^2", run={"cycles": 2})
        .body("crank", mass="0.3 kg", centre="0, 0, 0 mm", inertia=small)
        .body("rod", mass="0.21 kg", centre="110, 0, 0 mm", inertia="2e-5, 2.5e-4, 2.5e-4 kg m^2")
        .body("slider", mass="0.14 kg", centre="170, 0, 0 mm", inertia=small)
        .revolute("main", "ground", "crank", point="0, 0, 0 mm", axis=across)
        .revolute("pin", "crank", "rod", point="50, 0, 0 mm", axis=across)
        .revolute("wrist", "rod", "slider", point="170, 0, 0 mm", axis=across)
        .clearance(
            "wrist",
            radius="9.5 mm",
            radial="20 um",
            length="20 mm",
            axial="50 um",
            flange="14 mm",
            pair="steel-polyimide",
        )
        .prismatic("guide", "ground", "slider", point="170, 0, 0 mm", axis=[1, 0, 0])
        .pair("steel-polyimide", contact={"law": "gw", "restitution": 0.8})
        .drive("motor", "main", speed="5000 rpm")
        .load(
            "gas",
            "slider",
            direction=[-2, 0, 0],
            force={"value": "100 N", "amplitude": "50 N", "angular_frequency": "10 rad/s"},
        )
        .spring(
            "return",
            "ground",
            "rod",
            first_point="110, 100, 0 mm",
            second_point="110, 0, 0 mm",
            stiffness="2 N/mm",
        )
        .case()
    )
