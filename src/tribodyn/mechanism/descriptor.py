"""A mechanism that a user describes, as the rest of the program sees it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from tribodyn.cases.load import BuiltIn, flat
from tribodyn.core import toml
from tribodyn.mechanism.library import BUILT_IN, TEMPLATES
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.mechanism_variables import OF_CYCLE, VARIABLES
from tribodyn.mechanism.results.joint_numbers import BY_JOINT
from tribodyn.mechanism.results.mechanism_results import KEY_NUMBERS, KEY_RESULTS
from tribodyn.mechanism.results.mode_numbers import BY_MODE
from tribodyn.mechanisms.base import MechanismDescriptor
from tribodyn.mechanisms.output_numbers import BY_INSTANT, BY_OUTPUT


def _built_in() -> Iterator[tuple[str, BuiltIn]]:
    """Yield the built-in cases by the names of their files, with their titles."""
    for name, file in BUILT_IN.items():
        yield name, BuiltIn(MechanismCase, file.title, dict(flat(toml.parse(file.text))))


MECHANISM: Final = MechanismDescriptor(
    folder="tribodyn.mechanism",
    case=MechanismCase,
    built_in=dict(_built_in()),
    templates={name: template.text for name, template in TEMPLATES.items()},
    variables=VARIABLES,
    key_results=KEY_RESULTS,
    key_numbers=KEY_NUMBERS,
    of_cycle=OF_CYCLE,
    by_part={"joints": BY_JOINT, "outputs": BY_OUTPUT, "instants": BY_INSTANT, "modes": BY_MODE},
    controls=(
        "parameters.*.value",
        "joints.*.clearance.radial",
        "joints.*.clearance.gap",
        "drives.*.*.value",
        "drives.*.*.angular_frequency",
        "joints.*.clearance.friction_coefficient",
        "joints.*.clearance.ideal",
        "loads.*.*.value",
        "springs.*.stiffness",
        "joints.*.start_speed",
        "surfaces.bushing.roughness",
        "contact.law",
        "bodies.*.mass",
    ),
    parts={
        "joints.*": ("type", "between", "point", "axis", "second_axis"),
        "joints.*.clearance": ("radius", "radial", "length"),
        "bodies.*": (
            "shape",
            "density",
            "start",
            "end",
            "radius",
            "centre",
            "length",
            "size",
            "mass",
            "inertia",
        ),
        "drives.*": ("joint", "speed.value", "angle.value", "velocity.value", "position.value"),
        "loads.*": ("body", "point", "direction", "force.value", "moment.value"),
        "springs.*": ("between", "first_point", "second_point", "stiffness", "damping"),
    },
    bearings="tribodyn.mechanism.assembly.clearance_surfaces:bearings",
)
