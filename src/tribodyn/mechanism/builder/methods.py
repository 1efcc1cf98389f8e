"""The methods of the builder: one list, from which their signatures, docstrings and type stub follow.

A method fills one table of a case. Its keyword arguments are the keys of that table, so that names, units,
defaults and meanings stand in one place, the models of a case.
"""

import inspect
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Final

from pydantic import BaseModel

from tribodyn.cases.case import ParameterKeys
from tribodyn.cases.joint_keys import FilmKeys
from tribodyn.cases.keys import VALUE
from tribodyn.mechanism.builder.arguments import Argument, arguments_of, parameters_of
from tribodyn.mechanism.elements import ELEMENTS
from tribodyn.mechanism.elements.element import ElementKeys
from tribodyn.mechanism.joints import JOINTS
from tribodyn.mechanism.model.body import BodyKeys
from tribodyn.mechanism.model.drives_and_loads import DriveKeys, LoadKeys
from tribodyn.mechanism.model.output_declarations import OutputKeys
from tribodyn.mechanism.model.parts import ClearanceKeys, JointKeys, PairKeys, SpringKeys

Example = Mapping[str, Any]  #: Tables of a case.

OF_JOINT: Final = ("clearance", "film")  #: Tables of a joint that have methods of their own.
_NAME: Final = ("name", "", "its name, which the case does not have yet")
_ENDS: Final = (("first", "between", "a body, or ground"), ("second", "between", "another body, or ground"))
#: Arguments that bodies and joints of elements may be given by, by key.
_PLACES: Final = {
    "between": _ENDS,
    "joint": (("joint", "joint", "the joint that it acts in"),),
    "joints": (("first", "joints", "a joint"), ("second", "joints", "another joint")),
    "body": (("body", "body", "the body that it acts on"),),
}
_THAT_JOINT: Final = (("joint", "", "a joint that the mechanism has"),)


@dataclass(frozen=True)
class BuilderMethod:
    """A method of the builder."""

    # One rule of all methods: after the name come bodies or joints, by position or by name; ``between``,
    # ``joint``, ``joints`` or ``body`` name them as a case file does.

    name: str  #: Its name.
    does: str  #: First line of its docstring.
    table: str  #: Table of a case that it adds to; a table of a joint stands after ``joints.``.
    keys: type[BaseModel]  #: Model of that table.
    example: Example  #: Tables of a case that is made with it.
    #: Positional ones: name, key that it fills (none for the name of the table), meaning.
    arguments: tuple[tuple[str, str, str], ...] = (_NAME,)
    given: Mapping[str, object] = field(default_factory=dict)  #: Keys that the method fills by itself.
    needed: tuple[str, ...] = ()  #: Keys that must be given beside those that always must.
    without: tuple[str, ...] = ()  #: Keys that have no meaning here.

    @property
    def keywords(self) -> dict[str, Argument]:
        """The keys of its table that a user may give, the needed ones first."""
        own = {key for name, key, _ in self.arguments if key not in self._either or key == name}
        filled = {*own, *self.given, *self.without}
        found = {k: replace(v, required=v.required and k not in self._either) for k, v in self._known.items()}
        there = {
            name: one.with_need(name in self.needed) for name, one in found.items() if name not in filled
        }
        return dict(sorted(there.items(), key=lambda item: not item[1].required))

    @property
    def _known(self) -> Mapping[str, Argument]:
        return arguments_of(self.keys)

    @property
    def _either(self) -> set[str]:
        """Keys of an element that its signature shows by position and by name."""
        return {key for _, key, _ in self.arguments if key} if issubclass(self.keys, ElementKeys) else set()

    @property
    def signature(self) -> inspect.Signature:
        """Its signature, as Python and notebooks show it."""
        kinds, plain = inspect.Parameter, inspect.Parameter.POSITIONAL_OR_KEYWORD
        own = [kinds("self", plain)]
        own += [
            kinds(name, plain, annotation="str | None", default=None)
            if key in self._either
            else kinds(name, plain, annotation="str")
            for name, key, _ in self.arguments
        ]
        return inspect.Signature([*own, *parameters_of(self.keywords)], return_annotation="Mechanism")

    def values(self, *arguments: str, **keys: object) -> tuple[str, dict[str, object]]:
        """Return the name of the table and its keys, from the arguments of a call.

        Raises TypeError if there are too many arguments, one is given twice, or one that is needed is
        missing.
        """
        names = [name for name, _, _ in self.arguments]
        if len(arguments) > len(names):
            raise TypeError(f"too many positional arguments: {self.name}({', '.join(names)}, key=value, ...)")
        given: dict[str, Any] = dict(zip(names, arguments, strict=False))
        of_keys = {key for _, key, _ in self.arguments}
        for name in names:
            if name in keys and (name not in of_keys or len(self._places(name)) == 1):
                if name in given:
                    raise TypeError(f"multiple values for argument {name!r}")
                given[name] = keys.pop(name)
        filled: dict[str, Any] = dict(self.given)
        for key in filter(None, dict.fromkeys(key for _, key, _ in self.arguments)):
            places = self._places(key)
            found = [given[place] for place in places if place in given]
            if found and key in keys:
                raise TypeError(f"multiple values for argument {key!r}")
            if len(found) == len(places) or (found and key == "joints"):
                filled[key] = found if key in ("between", "joints") else found[0]
            elif key not in keys:
                missing = next(place for place in places if place not in given)
                raise TypeError(f"missing a required argument: {missing!r}")
        name = next((name for name, key, _ in self.arguments if not key), "")
        if name and name not in given:
            raise TypeError(f"missing a required argument: {name!r}")
        return given.get(name, ""), {**filled, **keys}

    def _places(self, key: str) -> list[str]:
        """Return the arguments that fill a key."""
        return [name for name, filled, _ in self.arguments if filled == key]


_ARM: Final = {"mass": "1 kg", "centre": "50, 0, 0 mm", "inertia": "1e-3, 1e-3, 1e-3 kg m^2"}
_HINGE: Final = {"type": "revolute", "between": ["ground", "arm"], "point": "0, 0, 0 mm", "axis": [0, 0, 1]}
_BEARING: Final = {"radius": "10 mm", "radial": "20 um", "length": "20 mm"}


def _example(*, hinge: Mapping[str, object] = _HINGE, **tables: object) -> Example:
    """Return the tables of an arm in a hinge, and others."""
    return {"run": {"duration": "1 ms"}, "bodies": {"arm": _ARM}, "joints": {"hinge": hinge}, **tables}


def _of_joint(kind: str) -> BuilderMethod:
    """Return the method that adds a joint of a kind."""
    about = JOINTS[kind]
    starts = {"start_speed": "angle", "start_velocity": "position"}
    others = [key for other in JOINTS.values() for key in other.KEYS.model_fields if other is not about]
    return BuilderMethod(
        name=kind.replace("-", "_"),
        does=f"Add {about.named}: {about.MEANING}.",
        table="joints",
        keys=JointKeys,
        example=_example(hinge={"type": kind, "between": ["ground", "arm"], **about.example}),
        arguments=(_NAME, *_ENDS),
        given={"type": kind},
        needed=tuple(about.example),
        without=(
            *(key for key, coordinate in starts.items() if coordinate not in about.COORDINATES),
            *others,
            *(() if about.SHAPE else OF_JOINT),
        ),
    )


def _of_element(kind: Any) -> BuilderMethod:
    """Return the method that adds an element of a kind."""
    first = str(kind.__doc__).splitlines()[0]
    tables = tomllib.loads(kind.EXAMPLE)
    arguments = [_NAME, *(one for key, ends in _PLACES.items() if key in kind.model_fields for one in ends)]
    does = f"Add {first[0].lower()}{first[1:]}"
    return BuilderMethod(kind.METHOD, does, kind.TABLE, kind, tables, tuple(arguments))


#: Every method of the builder that fills a table.
METHODS: Final = (
    BuilderMethod(
        "parameter",
        "Add a number that other values are computed from, or an expression of others.",
        "parameters",
        ParameterKeys,
        {
            "run": {"duration": "1 ms"},
            "parameters": {"length": {VALUE: "50 mm"}},
            "bodies": {"arm": {**_ARM, "centre": "length, 0, 0 mm"}},
            "joints": {"hinge": _HINGE},
        },
        arguments=(_NAME, ("value", VALUE, 'its value, such as "50 mm", or an expression')),
    ),
    BuilderMethod("body", "Add a rigid body.", "bodies", BodyKeys, _example()),
    *map(_of_joint, JOINTS),
    BuilderMethod(
        "joint",
        "Add a joint of a kind that is given by its name.",
        "joints",
        JointKeys,
        _example(),
        arguments=(_NAME, ("kind", "type", f"what it lets move: {', '.join(JOINTS)}"), *_ENDS),
    ),
    BuilderMethod(
        "clearance",
        "Give a joint clearance.",
        "clearance",
        ClearanceKeys,
        _example(hinge={**_HINGE, "clearance": _BEARING}),
        arguments=_THAT_JOINT,
    ),
    BuilderMethod(
        "film",
        "Let a joint with clearance run in oil.",
        "film",
        FilmKeys,
        _example(hinge={**_HINGE, "clearance": _BEARING, "film": {"viscosity": "0.01 Pa s"}}),
        arguments=_THAT_JOINT,
    ),
    BuilderMethod(
        "drive",
        "Move a joint by one of angle, speed, torque, position, velocity and force.",
        "drives",
        DriveKeys,
        _example(drives={"motor": {"joint": "hinge", "speed": "60 rpm"}}),
        arguments=(_NAME, ("joint", "joint", "the joint that it moves")),
    ),
    BuilderMethod(
        "load",
        "Let a force or a moment act on a body.",
        "loads",
        LoadKeys,
        _example(loads={"push": {"body": "arm", "direction": [0, 1, 0], "force": "20 N"}}),
        arguments=(_NAME, ("body", "body", "the body that it acts on")),
    ),
    BuilderMethod(
        "spring",
        "Put a spring and damper between points of two bodies.",
        "springs",
        SpringKeys,
        _example(
            springs={
                "back": {
                    "between": ["ground", "arm"],
                    "first_point": "50, 80, 0 mm",
                    "second_point": "50, 0, 0 mm",
                    "stiffness": "2 N/mm",
                }
            }
        ),
        arguments=(_NAME, *_ENDS),
    ),
    BuilderMethod(
        "output",
        "Compare a motion with that of ideal joints.",
        "outputs",
        OutputKeys,
        _example(outputs={"swing": {"body": "arm", "quantity": "angle", "along": [0, 0, 1]}}),
        arguments=(_NAME, ("body", "body", "the body that is observed")),
    ),
    BuilderMethod(
        "pair",
        "Name surfaces and a contact law for joints with clearance.",
        "pairs",
        PairKeys,
        _example(
            hinge={**_HINGE, "clearance": {**_BEARING, "pair": "rough"}},
            pairs={"rough": {"surfaces": {"bushing": {"roughness": "2 um"}}}},
        ),
    ),
    *map(_of_element, ELEMENTS),
)
