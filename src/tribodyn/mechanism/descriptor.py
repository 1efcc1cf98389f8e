"""A mechanism that a user describes, as the rest of the program sees it."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.resources import files as files_of
from typing import Final

from tribodyn.cases.load import BuiltIn, flat
from tribodyn.core import files
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.mechanism_variables import OF_CYCLE, VARIABLES
from tribodyn.mechanism.results.derived_columns import BY_SPRING
from tribodyn.mechanism.results.guides import BY_GUIDE
from tribodyn.mechanism.results.joint_numbers import BY_JOINT
from tribodyn.mechanism.results.mechanism_results import BY_MODE, KEY_NUMBERS, KEY_RESULTS
from tribodyn.mechanisms.mechanism_protocol import MechanismDescriptor
from tribodyn.mechanisms.output_numbers import BY_INSTANT, BY_OUTPUT


@dataclass(frozen=True)
class Template:
    """A file of a mechanism."""

    text: str  #: Its content.

    @property
    def title(self) -> str:
        """Heading of figures and report."""
        return str(files.parse(self.text)["title"])

    @property
    def description(self) -> str:
        """Description of the mechanism, from its comments."""
        return " ".join(line for line in self._comments() if not re.match(r"(Question|Results): ", line))

    @property
    def question(self) -> str:
        """Question that the gallery answers with it; empty where the gallery does not show it."""
        return self._entry("Question")

    @property
    def results(self) -> tuple[str, ...]:
        """Names of the key results that answer the question."""
        return tuple(self._entry("Results").split(", ")) if self.question else ()

    def _comments(self) -> Iterator[str]:
        for line in self.text.splitlines():
            if not line.startswith("#"):
                return
            yield line.removeprefix("#").strip()

    def _entry(self, name: str) -> str:
        found = (line.removeprefix(f"{name}: ") for line in self._comments() if line.startswith(f"{name}: "))
        return next(found, "")


def _files(folder: str) -> dict[str, Template]:
    """Return the files of a folder beside this one, by their names without the ending."""
    found = sorted(files_of(__package__).joinpath(folder).iterdir(), key=lambda file: file.name)
    return {file.name.removesuffix(".toml"): Template(file.read_text(encoding="utf-8")) for file in found}


BUILT_IN: Final = _files("built_in")  #: Cases that run by name.
TEMPLATES: Final = {**_files("templates"), **BUILT_IN}  #: All files.
#: Those that the manual shows, by name.
GALLERY: Final = {name: template for name, template in TEMPLATES.items() if template.question}


def _built_in() -> Iterator[tuple[str, BuiltIn]]:
    """Yield the built-in cases by the names of their files, with their titles."""
    for name, file in BUILT_IN.items():
        yield name, BuiltIn(MechanismCase, file.title, dict(flat(files.parse(file.text))))


MECHANISM: Final = MechanismDescriptor(
    folder="tribodyn.mechanism",
    case=MechanismCase,
    built_in=dict(_built_in()),
    templates={name: template.text for name, template in TEMPLATES.items()},
    variables=VARIABLES,
    key_results=KEY_RESULTS,
    key_numbers=KEY_NUMBERS,
    of_cycle=OF_CYCLE,
    by_part={
        "joints": {**BY_JOINT, **BY_GUIDE},
        "springs": BY_SPRING,
        "outputs": BY_OUTPUT,
        "instants": BY_INSTANT,
        "modes": BY_MODE,
    },
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
        "joints.*.clearance": ("radius", "radial", "length", "axial", "width", "height"),
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
