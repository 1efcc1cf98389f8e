"""A mechanism that a user describes, as the rest of the program sees it."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.resources import files
from typing import Final

from tribodyn.cases.load import BuiltIn, flat
from tribodyn.core import toml
from tribodyn.mechanisms.base import MechanismDescriptor
from tribodyn.mechanisms.general.case import MechanismCase
from tribodyn.mechanisms.general.headlines import BY_JOINT, HEADLINES, KEY_NUMBERS
from tribodyn.mechanisms.general.output_numbers import BY_OUTPUT
from tribodyn.mechanisms.general.variables import OF_CYCLE, VARIABLES


def _built_in() -> Iterator[tuple[str, BuiltIn]]:
    """Yield the cases of the folder ``built_in`` by the names of their files, with their titles."""
    folder = files(__package__).joinpath("built_in")
    for file in sorted(folder.iterdir(), key=lambda file: file.name):
        given = dict(flat(toml.parse(file.read_text(encoding="utf-8"))))
        yield file.name.removesuffix(".toml"), BuiltIn(MechanismCase, str(given["title"]), given)


MECHANISM: Final = MechanismDescriptor(
    folder="tribodyn.mechanisms.general",
    case=MechanismCase,
    built_in=dict(_built_in()),
    variables=VARIABLES,
    headlines=HEADLINES,
    key_numbers=KEY_NUMBERS,
    of_cycle=OF_CYCLE,
    by_part={"joints": BY_JOINT, "outputs": BY_OUTPUT},
    controls=(
        "joints.*.clearance.radial",
        "joints.*.clearance.gap",
        "drives.*.*.value",
        "drives.*.*.angular_frequency",
        "joints.*.clearance.friction_coefficient",
        "loads.*.*.value",
        "springs.*.stiffness",
        "joints.*.start_speed",
        "surfaces.bushing.roughness",
        "contact.law",
    ),
    bearings="tribodyn.mechanisms.general.surfaces:bearings",
)
