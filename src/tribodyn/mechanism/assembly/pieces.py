"""Pieces of a mechanism: bodies, or several that ideal fixed joints make one.

Kernels move a piece as one body, which takes the place of the bodies and of the six constraints of each joint
between them. The reactions of these joints follow from the motion, see
:mod:`tribodyn.mechanism.results.fixed_joints`. A fixed joint stays a joint where something else acts between
the pieces that it would join, where it closes a gap or is off the drawing, and on the ground.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.case import unit
from tribodyn.kernels import dense
from tribodyn.mechanism.assembly.skeleton import back, rotated
from tribodyn.mechanism.frames import GROUND, cross
from tribodyn.mechanism.joints.ideal import Fixed
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.model.body import BodyKeys
from tribodyn.mechanism.model.parts import JointKeys


@dataclass(frozen=True)
class RigidPieces:
    """Pieces by number, in the order of their first bodies, after which they are named."""

    bodies: Mapping[str, BodyKeys]  #: All bodies of the case.
    members: Mapping[str, Sequence[str]]  #: Bodies of each piece, by its name.
    joints: Mapping[str, Sequence[str]]  #: Bodies of the joints within pieces, by the names of these.

    @cached_property
    def numbers(self) -> Mapping[str, int]:
        """Number of the piece of each body; −1 for the ground."""
        found = {body: k for k, bodies in enumerate(self.members.values()) for body in bodies}
        return {**found, GROUND: -1}

    @cached_property
    def masses(self) -> tuple[float, ...]:
        """Masses of the pieces [kg]."""
        return tuple(sum(self.bodies[name].mass for name in names) for names in self.members.values())

    @cached_property
    def centres(self) -> FloatArray:
        """Mass centres as drawn [m], shape (n + 1, 3); at the end that of the ground, zero."""
        means = [
            np.sum([self.bodies[name].mass * np.array(self.bodies[name].centre) for name in names], 0) / mass
            if len(names) > 1
            else np.array(self.bodies[names[0]].centre)
            for names, mass in zip(self.members.values(), self.masses, strict=True)
        ]
        return np.array([*means, np.zeros(3)])

    @cached_property
    def of_bodies(self) -> list[int]:
        """Numbers of the pieces of all bodies, in the order of the case."""
        return [self.numbers[body] for body in self.bodies]

    @property
    def arms(self) -> FloatArray:
        """Mass centres of all bodies against those of their pieces, as drawn [m], shape (n_bodies, 3)."""
        return np.array([body.centre for body in self.bodies.values()]) - self.centres[self.of_bodies]

    def beyond(self, joint: str) -> set[str]:
        """Return the bodies of a piece on the side of the second body of a joint within it."""
        others = [between for name, between in self.joints.items() if name != joint]
        beyond, more = set[str](), {self.joints[joint][1]}
        while more:
            beyond |= more
            more = {body for between in others if beyond & {*between} for body in between} - beyond
        return beyond

    def passing(self, bodies: set[str]) -> Iterator[str]:
        """Yield the joints within pieces that stand between some bodies of the same piece."""
        for joint, (body, _) in self.joints.items():
            own = bodies & {*tuple(self.members.values())[self.numbers[body]]}
            if 0 < len(own & self.beyond(joint)) < len(own):
                yield joint

    def inertia(self, number: int) -> FloatArray:
        """Return the inertia about the mass centre, along the axes of the drawing [kg m²], shape (3, 3)."""
        members, total = tuple(self.members.values())[number], np.zeros((3, 3))
        for keys in map(self.bodies.__getitem__, members):
            x = np.array(keys.centre) - self.centres[number]
            total += inertia_of(keys) + keys.mass * (dense.product(x, x) * np.eye(3) - np.outer(x, x))
        return inertia_of(self.bodies[members[0]]) if len(members) == 1 else total


def inertia_of(body: BodyKeys) -> FloatArray:
    """Return the inertia of a body about its mass centre, along the axes of the drawing [kg m²], (3, 3)."""
    first, second = unit(body.first_axis, "first_axis"), unit(body.second_axis, "second_axis")
    axes = np.column_stack([first, second, cross(first, second)])
    inertia = dense.product(dense.product(axes, np.diag(body.inertia)), axes.T)
    return np.asarray(0.5 * (inertia + inertia.T))


def motion_of_bodies(pieces: RigidPieces, found: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Return the observed motion of all bodies, (n_t, n_bodies, …) each, from that of pieces."""
    moved = {name: values[:, pieces.of_bodies] for name, values in found.items()}
    if not pieces.joints:
        return moved
    arm, spin = rotated(moved["orientation"], pieces.arms), moved["angular_velocity"]
    swing = np.cross(spin, arm)
    inward = np.cross(moved["angular_acceleration"], arm) + np.cross(spin, swing)
    for name, added in {"position": arm, "velocity": swing, "acceleration": inward}.items():
        moved[name] = moved[name] + added
    return moved


def modes_of_bodies(
    pieces: RigidPieces, orientation: FloatArray, shape: FloatArray, share: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return modes, (n_t, m, n_bodies, 6), and shares in their energies of all bodies from those of pieces.

    ``orientation``: of pieces, shape (n_t, n, 4); modes have a modal mass of 1 kg.
    """
    if not pieces.joints:
        return shape, share
    turn, found = orientation[:, None, pieces.of_bodies], shape[:, :, pieces.of_bodies]
    found[..., :3] += np.cross(found[..., 3:], rotated(turn, pieces.arms))
    own, masses = rotated(back(turn), found[..., 3:]), [body.mass for body in pieces.bodies.values()]
    inertia = np.array([inertia_of(body) for body in pieces.bodies.values()])
    turning = np.sum(own * np.sum(inertia * own[..., None, :], axis=-1), axis=-1)
    return found, np.array(masses) * np.sum(found[..., :3] ** 2, axis=-1) + turning


def pieces_of(case: MechanismCase, apart: Iterable[str] = ()) -> RigidPieces:
    """Return the pieces of a case, in which some joints make none."""
    links: dict[str, Counter[str]] = {body: Counter() for body in case.bodies}
    for first, second in ends_of(case):
        if first in links and second in links and first != second:
            links[first][second] += 1
            links[second][first] += 1
    piece, members = {body: body for body in case.bodies}, {body: [body] for body in case.bodies}
    order, joints = {body: k for k, body in enumerate(case.bodies)}, dict[str, Sequence[str]]()
    turned = {drive.joint for drive in case.drives.values() if case.joints[drive.joint].real is not None}
    single = {body for name in turned for body in case.joints[name].between}
    for name, joint in case.joints.items():
        if name in apart or not _joins(joint) or not single.isdisjoint(joint.between):
            continue
        first, second = sorted((piece[body] for body in joint.between), key=order.__getitem__)
        if links[first][second] != 1:
            continue
        del links[first][second]
        for other, number in links.pop(second).items():
            if other != first:
                del links[other][second]
                links[first][other] += number
                links[other][first] += number
        members[first] += members.pop(second)
        piece |= dict.fromkeys(members[first], first)
        joints[name] = joint.between
    return RigidPieces(case.bodies, members, joints)


def _joins(joint: JointKeys) -> bool:
    """Return whether a joint makes one piece of its bodies."""
    closed = len({*joint.points}) == 1 and not joint.off_drawing
    return joint.type == Fixed.NAME and GROUND not in joint.between and closed


def ends_of(case: MechanismCase) -> Iterator[Sequence[str]]:
    """Yield the bodies of socket and shaft of joints, springs, loads and legs of elements, in this order."""
    yield from (joint.between[:: int(joint.sign)] for joint in case.joints.values())
    yield from (spring.between for spring in case.springs.values())
    yield from ((GROUND, load.body)[:: -1 if load.frame == "body" else 1] for load in case.loads.values())
    for _, _, keys in case.elements():
        yield from (leg.bodies for equation in keys.equations(case.joints) for leg in equation.legs)
