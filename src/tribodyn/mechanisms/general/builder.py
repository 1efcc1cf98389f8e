"""A mechanism put together in Python; what comes of it is the case that a file would have made."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final, TypeAlias

import numpy as np

from tribodyn.cases.case import build
from tribodyn.cases.entry import Entry
from tribodyn.cases.load import flat
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.general.case import MechanismCase
from tribodyn.mechanisms.general.elements import ELEMENTS
from tribodyn.mechanisms.general.elements.base import ElementKeys

SOURCE: Final = "Mechanism"
Direction: TypeAlias = Sequence[float] | np.ndarray[Any, Any]
"""Three numbers."""
Place: TypeAlias = Sequence[str] | str
"""Three lengths, such as ``["0 mm", "0 mm", "170 mm"]`` or ``"0, 0, 170 mm"``."""


class Mechanism:
    """Bodies, joints and what moves them, in one drawing with global coordinates.

    Values are written as in a case file, with their units; every key of its tables is an argument. Methods
    return the mechanism, so that calls can be chained; nothing is checked before :meth:`case`.

    Parameters
    ----------
    title
        Heading of figures and report.
    **keys
        Keys and tables of the case, such as ``gravity="0, 0, -9.81 m/s^2"`` or ``run={"cycles": 2}``.

    Examples
    --------
    >>> pendulum = Mechanism("Pendulum", gravity="0, -9.81, 0 m/s^2", run={"duration": "2 s"})
    >>> rod = {"mass": "1 kg", "inertia": "0.01, 0.01, 0.01 kg m^2"}
    >>> case = pendulum.body("rod", centre="0.5, 0, 0 m", **rod).revolute(
    ...     "pivot", "ground", "rod", point="0, 0, 0 m", axis=[0, 0, 1]
    ... ).case()
    >>> case.joints["pivot"].type
    'revolute'
    """

    def __init__(self, title: str = "Mechanism", **keys: object) -> None:
        self._tables: dict[str, Any] = {"case": MechanismCase.kind(), "title": title, **keys}

    def parameter(self, name: str, value: str | float) -> Mechanism:
        """Add a number that other values are computed from, such as ``"50 mm"``, or an expression."""
        parameters = self._tables.setdefault("parameters", {})
        if name in parameters:
            raise InputError("this name is given twice", key=f"parameters.{name}", source=SOURCE)
        parameters[name] = value
        return self

    def body(self, name: str, **keys: object) -> Mechanism:
        """Add a rigid body: ``mass``, ``centre``, ``inertia``."""
        return self._add("bodies", name, keys)

    def joint(self, name: str, kind: str, first: str, second: str, **keys: object) -> Mechanism:
        """Add a joint of some kind between two bodies, or one and ``ground``: ``point``, ``axis``."""
        return self._add("joints", name, {"type": kind, "between": [first, second], **keys})

    def fixed(self, name: str, first: str, second: str, *, point: Place, **keys: object) -> Mechanism:
        """Add a joint in which nothing moves."""
        return self.joint(name, "fixed", first, second, point=point, **keys)

    def revolute(
        self, name: str, first: str, second: str, *, point: Place, axis: Direction, **keys: object
    ) -> Mechanism:
        """Add a joint that turns about its axis."""
        return self.joint(name, "revolute", first, second, point=point, axis=axis, **keys)

    def spherical(self, name: str, first: str, second: str, *, point: Place, **keys: object) -> Mechanism:
        """Add a joint that turns about its point."""
        return self.joint(name, "spherical", first, second, point=point, **keys)

    def cylindrical(
        self, name: str, first: str, second: str, *, point: Place, axis: Direction, **keys: object
    ) -> Mechanism:
        """Add a joint that turns about its axis and slides along it."""
        return self.joint(name, "cylindrical", first, second, point=point, axis=axis, **keys)

    def prismatic(
        self, name: str, first: str, second: str, *, point: Place, axis: Direction, **keys: object
    ) -> Mechanism:
        """Add a joint that slides along its axis."""
        return self.joint(name, "prismatic", first, second, point=point, axis=axis, **keys)

    def universal(
        self,
        name: str,
        first: str,
        second: str,
        *,
        point: Place,
        axis: Direction,
        second_axis: Direction,
        **keys: object,
    ) -> Mechanism:
        """Add a joint that turns about an axis of the first body and one of the second."""
        keys |= {"axis": axis, "second_axis": second_axis}
        return self.joint(name, "universal", first, second, point=point, **keys)

    def pin_slot(
        self, name: str, first: str, second: str, *, point: Place, axis: Direction, **keys: object
    ) -> Mechanism:
        """Add a ball of the second body that slides along a pin of the first."""
        return self.joint(name, "pin-slot", first, second, point=point, axis=axis, **keys)

    def planar(
        self, name: str, first: str, second: str, *, point: Place, axis: Direction, **keys: object
    ) -> Mechanism:
        """Add a joint that slides and turns in the plane across its axis."""
        return self.joint(name, "planar", first, second, point=point, axis=axis, **keys)

    def spring_damper(self, name: str, first: str, second: str, *, point: Place, **keys: object) -> Mechanism:
        """Add a joint that moves against a ``stiffness`` and an ``angular_stiffness``, with ``damping``."""
        return self.joint(name, "spring-damper", first, second, point=point, **keys)

    def clearance(self, joint: str, **keys: object) -> Mechanism:
        """Make an ideal joint a real one: ``radius``, ``radial``, ``length``, ``axial``, ``pair``."""
        return self._of_joint(joint, "clearance", keys)

    def film(self, joint: str, **keys: object) -> Mechanism:
        """Let a joint with clearance run in oil: ``viscosity``, ``cavitation``, ``boundary``."""
        return self._of_joint(joint, "film", keys)

    def drive(self, name: str, joint: str, **keys: object) -> Mechanism:
        """Move a joint: by one of ``angle``, ``speed``, ``torque``, ``position``, ``velocity``, ``force``."""
        return self._add("drives", name, {"joint": joint, **keys})

    def load(self, name: str, body: str, **keys: object) -> Mechanism:
        """Let a ``force`` or a ``moment`` act on a body, along a ``direction``."""
        return self._add("loads", name, {"body": body, **keys})

    def spring(
        self, name: str, first: str, second: str, *, first_point: Place, second_point: Place, **keys: object
    ) -> Mechanism:
        """Put a spring between points of two bodies: ``stiffness``, ``damping``, ``length``."""
        ends = {"between": [first, second], "first_point": first_point, "second_point": second_point}
        return self._add("springs", name, {**ends, **keys})

    def output(self, name: str, body: str, **keys: object) -> Mechanism:
        """Compare a motion with that of ideal joints: ``quantity``, ``point``, ``along``, ``reference``."""
        return self._add("outputs", name, {"body": body, **keys})

    if TYPE_CHECKING:

        def __getattr__(self, method: str) -> Callable[..., Mechanism]:
            """Return a method that adds an element, such as ``gear``."""

    def pair(self, name: str, **keys: object) -> Mechanism:
        """Name surfaces and a contact law for clearances: ``surfaces``, ``asperities``, ``contact``."""
        return self._add("pairs", name, keys)

    def case(self) -> MechanismCase:
        """Return the case.

        Raises
        ------
        InputError
            Something in it is wrong; the message names the key as a case file spells it.
        """
        entries = {path: Entry(value, SOURCE) for path, value in flat(self._tables)}
        return build(MechanismCase, entries, SOURCE)

    def _of_joint(self, joint: str, table: str, keys: Mapping[str, object]) -> Mechanism:
        if joint not in self._tables.get("joints", {}):
            raise InputError(f"write the joint first, then its {table}", key=f"joints.{joint}", source=SOURCE)
        held = self._tables["joints"][joint]
        held[table] = _plain(keys)
        return self

    def _add(self, table: str, name: str, keys: Mapping[str, object]) -> Mechanism:
        tables = self._tables.setdefault(table, {})
        if name in tables:
            raise InputError("this name is given twice", key=f"{table}.{name}", source=SOURCE)
        tables[name] = _plain(keys)
        return self


def _adding(kind: type[ElementKeys]) -> Callable[..., Mechanism]:
    """Return the method that adds an element of a kind."""

    def add(self: Mechanism, name: str, **keys: object) -> Mechanism:
        return self._add(kind.TABLE, name, keys)

    add.__name__, add.__qualname__ = kind.METHOD, f"{Mechanism.__name__}.{kind.METHOD}"
    keys = ", ".join(f"``{key}``" for key in kind.model_fields)
    first = str(kind.__doc__).splitlines()[0]
    add.__doc__ = f"Add {first[0].lower()}{first[1:].rstrip('.')}: {keys}."
    return add


for _kind in ELEMENTS:
    setattr(Mechanism, _kind.METHOD, _adding(_kind))


def _plain(value: Any) -> Any:
    """Return values as TOML would give them: lists instead of arrays and tuples."""
    if isinstance(value, Mapping):
        return {key: _plain(inside) for key, inside in value.items()}
    if isinstance(value, np.ndarray):
        return value.tolist()
    return list(value) if isinstance(value, tuple) else value
