"""What can be said of a drawing before it is put together."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from tribodyn.mechanisms.general.description import Body, Description, Drive
from tribodyn.mechanisms.general.kinds import KINDS


@dataclass(frozen=True)
class ModelError:
    """Something that forbids a run.

    Attributes
    ----------
    key
        What to change, as in a case file: ``joints.wrist``.
    text
        In words.
    """

    key: str
    text: str


def inspect(description: Description) -> Iterator[ModelError]:
    """Yield what is wrong with a drawing whatever its positions."""
    for body in description.bodies:
        yield from _inertia(body)
    held = {b for joint in description.joints for b in joint.bodies}
    held |= {b for spring in description.springs for b in spring.bodies}
    for number, body in enumerate(description.bodies):
        if number not in held:
            text = f"nothing holds body {body.name}: no joint and no spring names it"
            yield ModelError(f"bodies.{body.name}", text)
    yield from _drives(description)


def sound_drives(description: Description) -> list[Drive]:
    """Return the drives that have a coordinate to themselves."""
    taken: set[tuple[int, str]] = set()
    sound = []
    for drive in description.drives:
        place = drive.joint, drive.coordinate
        if drive.coordinate in KINDS[description.joints[drive.joint].kind].coordinates and place not in taken:
            sound.append(drive)
            if drive.level < 2:
                taken.add(place)
    return sound


def _inertia(body: Body) -> Iterator[ModelError]:
    """Yield a finding if the principal moments of inertia cannot be those of any body."""
    moments = np.linalg.eigvalsh(body.inertia)
    if moments[0] <= 0.0:
        text = f"body {body.name} has a moment of inertia of {moments[0]:.4g} kg m^2; it must be above zero"
        yield ModelError(f"bodies.{body.name}.inertia", text)
    elif moments[2] > (moments[0] + moments[1]) * (1.0 + 1.0e-9):
        text = (
            f"no body has the principal moments of inertia of {body.name}: the largest, {moments[2]:.4g} "
            f"kg m^2, exceeds the sum of the others, {moments[0] + moments[1]:.4g} kg m^2"
        )
        yield ModelError(f"bodies.{body.name}.inertia", text)


def _drives(description: Description) -> Iterator[ModelError]:
    """Yield findings of drives that have no coordinate, and of coordinates that have two drives."""
    taken: dict[tuple[int, str], str] = {}
    for drive in description.drives:
        joint = description.joints[drive.joint]
        free = KINDS[joint.kind].coordinates
        if drive.coordinate not in free:
            able = (
                f"it drives the {' or the '.join(free)}"
                if free
                else "such a joint has no coordinate to drive"
            )
            text = (
                f"drive {drive.name} has nothing to drive: joint {joint.name} is {joint.kind} and has no "
                f"{drive.coordinate}; {able}"
            )
            yield ModelError(f"drives.{drive.name}", text)
        elif (
            drive.level < 2
            and (before := taken.setdefault((drive.joint, drive.coordinate), drive.name)) != drive.name
        ):
            freedom = f"the {drive.coordinate} of joint {joint.name}"
            text = f"drives {before} and {drive.name} drive one freedom, {freedom}"
            yield ModelError(f"drives.{drive.name}", text)
