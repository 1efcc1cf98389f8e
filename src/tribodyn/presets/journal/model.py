"""A journal in a bushing as a user-defined mechanism: one body, its bearing, a drive and loads.

Without tilt a planar joint holds the journal parallel to the bushing.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, Final

from tribodyn.cases.joint_keys import FilmKeys
from tribodyn.mechanism.mechanism_case import MechanismCase

if TYPE_CHECKING:
    from tribodyn.presets.journal.case import JournalCase, JournalLoad

BODY: Final = "journal"
BEARING: Final = "bearing"
_CENTRE: Final = (0.0, 0.0, 0.0)
_ALONG: Final = (0.0, 0.0, 1.0)
_CONSTANT: Final = {
    "force_x": (1.0, 0.0, 0.0),
    "force_y": (0.0, 1.0, 0.0),
    "moment_x": (1.0, 0.0, 0.0),
    "moment_y": (0.0, -1.0, 0.0),
}
"""Directions of loads; moments about Y are left-handed."""
_LEAST_SPIN: Final = 1.0e-9
"""Least moment of inertia about the axis over that across it: no body has none."""


def mechanism_of(case: JournalCase) -> MechanismCase:
    """Return the mechanism that a journal is.

    Parameters
    ----------
    case
        The journal, its joint, drive and loads.

    Returns
    -------
    MechanismCase
        One body, the joint ``bearing`` with its clearance and its film, and, without tilt, a planar joint.
    """
    held = {"between": ("ground", BODY), "point": _CENTRE, "axis": _ALONG}
    joints: dict[str, Any] = {BEARING: {**held, "type": "revolute", "clearance": _clearance(case)}}
    if case.film.lubricated:
        joints[BEARING]["film"] = {key: getattr(case.film, key) for key in FilmKeys.model_fields}
    if not case.journal.tilt:
        joints["plane"] = {**held, "type": "planar"}
    return MechanismCase.model_validate(
        {
            "case": MechanismCase.kind(),
            "title": case.title,
            "surfaces": case.surfaces,
            "asperities": case.asperities,
            "contact": case.contact,
            "bodies": {BODY: {"mass": case.journal.mass, "centre": _CENTRE, "inertia": inertia(case)}},
            "joints": joints,
            "drives": {"motor": {"joint": BEARING, "speed": _speed(case)}},
            "loads": {name: load for name, load in _loads(case)},
            "solver": {"name": case.solver.name, "rtol": case.solver.rtol, "grid": _of(case.solver.grid)},
            "run": {
                "duration": case.run.duration,
                "output_interval": case.run.output_interval,
                "start": "centred",
                "step_rows": 0,
            },
        }
    )


def inertia(case: JournalCase) -> tuple[float, float, float]:
    """Return the moments of inertia of the body [kg m²]; without tilt the one about the axis does nothing."""
    across, spin = case.journal.transverse_inertia, case.journal.spin_inertia
    return across, across, max(spin, _LEAST_SPIN * across) if case.journal.tilt else across


def _clearance(case: JournalCase) -> dict[str, Any]:
    joint, temperature = case.joint, case.temperature
    same = ("radius", "length", "contact", "friction_coefficient", "slip_velocity", "liner", "form")
    # What the material does over the temperature is in the surfaces already.
    warm = {key: value for key, value in _of(temperature).items() if key != "properties"}
    return {"radial": joint.clearance, "temperature": warm, **{key: getattr(joint, key) for key in same}}


def _of(group: Any) -> dict[str, Any]:
    """Return the keys of a table that have a value."""
    values = {key: getattr(group, key) for key in type(group).model_fields}
    return {key: value for key, value in values.items() if value is not None}


def _speed(case: JournalCase) -> dict[str, Any]:
    return {"value": case.journal.speed} if case.drive.speed is None else _of(case.drive.speed)


def _loads(case: JournalCase) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Yield the loads by name, each a force or a moment."""
    for key, direction in _CONSTANT.items():
        size = {"value": getattr(case.loads, key)}
        yield f"constant-{key}", {"body": BODY, "direction": direction, key.partition("_")[0]: size}
    for name, load in case.loads.more.items():
        for key, signal in load.given.items():
            yield f"{name}-{key}", _load(load, key, signal)


def _load(load: JournalLoad, key: str, signal: Any) -> dict[str, Any]:
    """Return one size of a load."""
    size, _, component = key.partition("_")
    found: dict[str, Any] = {"body": BODY, "frame": load.frame, size: signal}
    direction = _CONSTANT[key] if component else load.direction
    found |= {} if direction is None else {"direction": direction}
    if load.frame == "motion":
        return {**found, "slip_velocity": load.slip_velocity}
    if size == "force":
        found["point"] = (0.0, 0.0, load.height)
    if any(over != "times" for over in signal.axes):
        found["along"] = BEARING
    return found
