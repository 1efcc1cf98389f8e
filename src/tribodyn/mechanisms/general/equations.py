"""A description as the arrays that kernels read."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.joints.clearances import assemble as surfaces
from tribodyn.kernels.arrays import new_record
from tribodyn.kernels.joints.surface.memory import new_memory as memory_of_surfaces
from tribodyn.kernels.mechanism import data as kinds
from tribodyn.kernels.mechanism.data import (
    NONE,
    MechanismData,
    MechanismMemory,
    Now,
    Parts,
)
from tribodyn.mechanisms.general.description import Description, Drive, Joint, Load, Spring, number_of
from tribodyn.mechanisms.general.elements.base import Leg
from tribodyn.mechanisms.general.inspection import sound_drives
from tribodyn.mechanisms.general.joints import ROWS, frame
from tribodyn.mechanisms.general.kinds import KINDS
from tribodyn.mechanisms.general.ordering import Rows, elimination_order, make_pattern
from tribodyn.mechanisms.signals import SignalList, integral_of, negated, pieces_of

_LOADS: Final = {
    "ground": kinds.LOAD_GROUND,
    "body": kinds.LOAD_BODY,
    "motion": kinds.LOAD_MOTION,
    "line": kinds.LOAD_LINE,
}
_COORDINATES: Final = ("angle", "position")
_NOWHERE: Final = -1


def mechanism_data(description: Description, worn: FloatArray | None = None) -> MechanismData:
    """Return what the kernels read of a mechanism.

    Parameters
    ----------
    description
        The mechanism as drawn.
    worn
        Wear depth at the nodes of all joints [m], shape (n_nodes,); none by default.
    """
    signals = SignalList()
    couplings = _couplings(description, signals)
    mass, newton = _patterns(len(description.bodies), couplings)
    constants = new_record(kinds.Constants)
    constants.gravity[:] = description.gravity
    constants.n_rows = constants.rank = int(np.sum(couplings.n_rows))
    constants.n_nodes = len(description.bodies) + int(np.sum(couplings.n_rows > 0))
    constants.n_work = -(-(constants.n_nodes + len(description.bodies)) // 6)
    constants.size = _size(description)
    clearances = [joint.clearance for joint in description.joints if joint.clearance is not None]
    contact = surfaces(clearances, worn)
    parts = Parts(constants, _bodies(description), couplings)
    return MechanismData(parts, signals.records(), mass, newton, contact)


def new_memory(data: MechanismData) -> MechanismMemory:
    """Return the memory of a mechanism that has not moved."""
    parts = data.parts
    constants, n_bodies, n_couplings = parts.constants, parts.bodies.size, parts.couplings.size
    bodies = np.recarray(n_bodies + 1, dtype=kinds.BodyNow)
    couplings = np.recarray(n_couplings, dtype=kinds.CouplingNow)
    books = np.recarray(n_couplings + 2, dtype=kinds.Book)
    for records in (bodies, couplings, books):
        records.view(np.uint8)[:] = 0
    bodies.p[:, 0] = 1.0
    bodies.A[:] = np.eye(3)
    bodies.r[:-1] = parts.bodies.centre
    redundant = constants.n_rows if constants.rank < constants.n_rows else 0
    course = new_record(kinds.Course)
    course.until = np.inf
    n_nodes = max(constants.n_nodes, 2)
    return MechanismMemory(
        now=Now(course, bodies, couplings, np.zeros((n_nodes, 6)), np.zeros((n_nodes, 6))),
        blocks=np.zeros((n_blocks(data.mass), 6, 6)),
        independence=np.zeros((redundant, redundant)),
        settled=np.zeros(kinds.N_STATES * n_bodies),
        books=books,
        contact=memory_of_surfaces(data.contact),
    )


def n_blocks(pattern: kinds.Pattern) -> int:
    """Return the number of blocks that a pattern works on."""
    return 1 + int(np.max(pattern.factor[:, 1:]))


def _size(description: Description) -> float:
    """Return the distance between the farthest points of the drawing, at most twice that [m]."""
    points = [body.centre for body in description.bodies]
    points += [point for joint in description.joints for point in joint.points]
    points += [point for spring in description.springs for point in spring.points]
    return float(np.linalg.norm(np.ptp(np.array(points), axis=0))) or 1.0


def _bodies(description: Description) -> Any:
    """Return the records of the bodies."""
    records = np.recarray(len(description.bodies), dtype=kinds.Body)
    for record, body in zip(records, description.bodies, strict=True):
        record.mass, record.centre[:] = body.mass, body.centre
        record.inertia[:], record.inverse[:] = body.inertia, np.linalg.inv(body.inertia)
    return records


def _couplings(description: Description, signals: SignalList) -> Any:
    """Return the records of joints, springs, loads and legs of elements, in this order."""
    joints, springs, loads = description.joints, description.springs, description.loads
    n_legs = sum(len(element.legs) for element in description.elements)
    records = np.recarray(description.first_leg + n_legs, dtype=kinds.Coupling)
    records.view(np.uint8)[:] = 0
    for name in (
        "node",
        "row_signal",
        "signals",
        "follows",
        "effort",
        "contact",
        "rows_block",
        "bodies_block",
        "first_leg",
        "next_leg",
    ):
        records[name][:] = NONE
    real = 0
    for record, joint in zip(records, joints, strict=False):
        _fill_joint(record, description, joint)
        if joint.clearance is not None:
            record.force, record.contact = kinds.CONTACT, real
            real += 1
    for drive in sound_drives(description):
        _add_drive(records[drive.joint], description.joints[drive.joint], drive, signals)
    for record, spring in zip(records[len(joints) :], springs, strict=False):
        _fill_spring(record, description, spring)
    for record, load in zip(records[len(joints) + len(springs) :], loads, strict=False):
        _fill_load(record, description, load, signals)
    _fill_elements(records, description)
    nodes, rows = len(description.bodies), 0
    for record in records:
        if record.n_rows > 0:
            record.node, record.first_row = nodes, rows
            nodes, rows = nodes + 1, rows + record.n_rows
        elif record.first_leg != NONE:
            record.node = records[record.first_leg].node
    return records


def _place(
    record: Any,
    description: Description,
    bodies: Sequence[int],
    points: FloatArray,
    axes: tuple[FloatArray, FloatArray],
) -> None:
    """Fill bodies, origins and axes of socket and shaft; ``axes`` as drawn."""
    n = len(description.bodies)
    centres = [np.zeros(3) if b < 0 else description.bodies[b].centre for b in bodies]
    record.socket, record.shaft = (n if b < 0 else b for b in bodies)
    record.socket_point[:], record.shaft_point[:] = points[0] - centres[0], points[1] - centres[1]
    record.to_socket[:], record.shaft_axes[:] = axes[0].T, axes[1]


def _fill_joint(record: Any, description: Description, joint: Joint) -> None:
    """Fill a joint: the rows of its kind, or its springs."""
    socket = frame(joint.axes[0], joint.axes[1])
    shaft = socket
    if joint.kind == "universal":
        across = frame(joint.axes[1], joint.axes[0])  # z along the shaft's own axis
        shaft = np.column_stack([across[:, 2], -across[:, 1], across[:, 0]])
    order = [0, 1] if joint.sign > 0.0 else [1, 0]
    _place(record, description, [joint.bodies[k] for k in order], joint.points[order], (socket, shaft))
    if joint.clearance is not None:
        return
    for row in ROWS[joint.kind]:
        _add_row(record, *row)
    if joint.kind == "spring-damper":
        record.force = kinds.SPRINGS
        turned = [1, 2, 0]  # given along axis, second axis and across; wanted along x, y, z
        for source, target in ((joint.stiffness, record.stiffness), (joint.damping, record.damping)):
            target[:3], target[3:] = source[:3][turned], source[3:][turned]


def _add_row(record: Any, kind: int, axis: int, other: int, signal: int = NONE) -> None:
    """Add a constraint row."""
    m = record.n_rows
    record.row_kind[m], record.row_axis[m], record.row_other[m], record.row_signal[m] = (
        kind,
        axis,
        other,
        signal,
    )
    record.n_rows = record.n_terms = m + 1


def _add_drive(record: Any, joint: Joint, drive: Drive, signals: SignalList) -> None:
    """Add a drive: a row for motion, an effort for torque or force.

    It moves the second body against the first; where that carries the socket, the shaft goes the other way.
    """
    pieces = pieces_of(drive.signal)
    if joint.sign < 0.0:
        pieces = negated(pieces)
    number = signals.add(integral_of(pieces) if drive.level == 1 else pieces, drive.signal.kinks)
    which = _COORDINATES.index(drive.coordinate)
    if drive.level == 2:
        record.effort[which] = number
    elif which == 0:
        _add_row(record, kinds.ANGLE, 0, 0, number)
    else:
        _add_row(record, kinds.POSITION, 2, 0, number)


def _fill_spring(record: Any, description: Description, spring: Spring) -> None:
    """Fill a spring between two points."""
    _place(record, description, spring.bodies, spring.points, (np.eye(3), np.eye(3)))
    record.force, record.length = kinds.SPRING, spring.length
    record.stiffness[0], record.damping[0] = spring.stiffness, spring.damping


def _fill_load(record: Any, description: Description, load: Load, signals: SignalList) -> None:
    """Fill a load: on the shaft against the ground, or on the socket where it turns with the body."""
    bodies = (load.body, _NOWHERE) if load.frame == "body" else (_NOWHERE, load.body)
    _place(record, description, bodies, np.array([load.point, load.point]), (np.eye(3), np.eye(3)))
    record.force, record.slip_velocity = _LOADS[load.frame], load.slip_velocity
    record.follows = load.joint
    if load.joint >= 0:
        followed = description.joints[load.joint]
        record.follows_position = int(KINDS[followed.kind].coordinates == ("position",))
        record.follows_sign = followed.sign
    for i, signal in enumerate(load.signals):
        record.signals[i] = signals.add(pieces_of(signal), signal.kinks if load.joint < 0 else np.zeros(0))


def _fill_elements(records: Any, description: Description) -> None:
    """Fill the legs of all elements; only the first of each counts the equation."""
    number = description.first_leg
    for element in description.elements:
        first = number
        for leg in element.legs:
            record = records[number]
            _fill_leg(record, description, leg)
            if number > first:
                record.n_rows, record.first_leg, records[number - 1].next_leg = 0, first, number
            number += 1


def _fill_leg(record: Any, description: Description, leg: Leg) -> None:
    """Fill one term of the equation of an element."""
    bodies = [number_of(description, name) for name in leg.bodies]
    _place(record, description, bodies, leg.points, (leg.axes, leg.axes))
    record.along[:], record.about = leg.along, leg.about
    _add_row(record, kinds.COORDINATE, 2, 0)


def _patterns(n_bodies: int, couplings: Any) -> tuple[kinds.Pattern, kinds.Pattern]:
    """Return the patterns of the equations of motion and of the iteration matrix; number the blocks."""
    n_nodes = n_bodies + int(np.sum(couplings.n_rows > 0))
    block_of = {(k, k): k for k in range(n_nodes)}
    of_node: dict[int, list[int]] = {}

    def block(row: int, column: int) -> int:
        return block_of.setdefault((row, column), len(block_of))

    for record in couplings:
        bodies = [int(b) if b < n_bodies else NONE for b in (record.socket, record.shaft)]
        if record.node != NONE:
            of_node.setdefault(int(record.node), []).extend(bodies)
            for side, body in enumerate(bodies):
                if body != NONE:
                    record.rows_block[side] = block(record.node, body), block(body, record.node)
    rows = [
        Rows(node, tuple(b for b in dict.fromkeys(bodies) if b != NONE), NONE in bodies)
        for node, bodies in of_node.items()
    ]
    order = elimination_order(n_nodes, n_bodies, rows, [(a, b) for a, b in block_of if a < b])
    mass = make_pattern(order, dict(block_of))
    for record in couplings:
        if record.socket < n_bodies and record.shaft < n_bodies:
            pair = int(record.socket), int(record.shaft)
            record.bodies_block[:] = block(*pair), block(*pair[::-1])
    order = elimination_order(n_nodes, n_bodies, rows, [(a, b) for a, b in block_of if a < b])
    return mass, make_pattern(order, dict(block_of))
