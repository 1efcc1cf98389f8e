"""The keys of a mechanism as the records that kernels read."""

from collections.abc import Iterator, Sequence
from functools import cache
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

from mebdf.arrays import FloatArray
from tribodyn.cases.case import unit
from tribodyn.joints.clearances import Clearance, Place, places
from tribodyn.joints.clearances import assemble as surfaces
from tribodyn.kernels import dense
from tribodyn.kernels.film.data import FilmData
from tribodyn.kernels.jit import new_record, new_records
from tribodyn.kernels.joints.film import new_oil
from tribodyn.kernels.joints.surface.memory import new_memory as memory_of_surfaces
from tribodyn.kernels.mechanism import data as kinds
from tribodyn.kernels.mechanism.blocks import INVERT_DEFINITE
from tribodyn.kernels.mechanism.data import NONE, MechanismData, MechanismMemory, Now, Parts
from tribodyn.kernels.mechanism.equations import has_law
from tribodyn.lubrication import Film, stacked_data, stacked_memory
from tribodyn.mechanism.assembly.clearance_surfaces import axes_of
from tribodyn.mechanism.assembly.ordering import n_blocks, n_nodes, number_entries, patterns
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.elements.element import ForceLaw, Leg
from tribodyn.mechanism.frames import frame, tilted
from tribodyn.mechanism.joints import JOINTS
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.model.drives_and_loads import COORDINATE_OF, GIVEN, DriveKeys, LoadKeys
from tribodyn.mechanism.model.parts import JointKeys, SpringKeys
from tribodyn.mechanisms.shaft_loads import Term, parts_of, term, term_records
from tribodyn.mechanisms.signal_pieces import SignalList, integral_of, negated, pieces_of
from tribodyn.wear import resampled

_MEASURES: Final = {"coordinate": kinds.COORDINATE, "distance": kinds.DISTANCE, "path": kinds.PATH}
_COORDINATES: Final = ("angle", "position")


def mechanism_data(model: Model, worn: FloatArray | None = None, *, contacts: bool = True) -> MechanismData:
    """Return the data of a mechanism for the kernels, worn at the nodes of all joints [m], shape (n_nodes,).

    Without ``contacts`` forces of joints with clearance are not evaluated: their nodes take most of the room.
    """
    signals = SignalList()
    terms: list[Term] = []
    couplings = _couplings(model, signals, terms)
    mass, newton = patterns(len(model.bodies), couplings)
    constants = new_record(kinds.Constants)
    constants.gravity[:] = model.case.gravity
    constants.n_rows = constants.rank = int(np.sum(couplings.n_rows))
    constants.n_reactive = int(np.sum((couplings.load_of != NONE) | couplings.push.any(axis=1)))
    constants.n_nodes = max(n_nodes(mass), n_nodes(newton))
    constants.n_work = -(-(constants.n_nodes + len(model.bodies)) // 6)
    constants.extent = _size(model)
    clearances = tuple(model.clearances.values()) if contacts else ()
    contact = surfaces(clearances, worn)
    oiled = any(clearance.film is not None for clearance in clearances)
    films = _films(clearances, worn) if oiled else _dry()
    parts = Parts(constants, _bodies(model), couplings)
    constants.n_entries = number_entries(len(model.bodies), couplings)
    inverts = (mass.factor[:, 0] == INVERT_DEFINITE, 1)
    parts.bodies.inverted[:] = ~np.isin(np.arange(parts.bodies.size), mass.factor[inverts])
    of_loads = term_records(signals, terms)
    return MechanismData(parts, signals.records(), of_loads, mass, newton, contact, films)


@cache
def _dry() -> FilmData:
    """Return the films of a mechanism without any."""
    return stacked_data((), ())


def _films(clearances: Sequence[Clearance], worn: FloatArray | None) -> FilmData:
    """Return the oil films of clearances that have one; ``worn`` as for :func:`mechanism_data`."""
    oiled = [(j, clearance.film) for j, clearance in enumerate(clearances) if clearance.film is not None]
    depths: list[FloatArray | None] = [None] * len(oiled)
    if worn is not None and oiled:
        barrels = {place.joint: place for place in reversed(places(clearances))}
        depths = [_depth(film, barrels[j], worn) for j, film in oiled]
    return stacked_data([film for _, film in oiled], depths)


def _depth(film: Film, barrel: Place, worn: FloatArray) -> FloatArray:
    """Return the wear depth at the nodes of a film [m]; the barrel is the first surface of a joint.

    The angle of a film's node is that of the force on the shaft, which is opposite to the node.
    """
    depth = worn[barrel.nodes].reshape(barrel.surface.field_shape)
    return resampled(depth, barrel.surface.axes["z"], film.z, film.grid.theta, turn=0.5)


def new_memory(data: MechanismData) -> MechanismMemory:
    """Return the memory of a mechanism that has not moved."""
    parts = data.parts
    constants, n_bodies, n_couplings = parts.constants, parts.bodies.size, parts.couplings.size
    bodies = new_records(n_bodies + 1, kinds.BodyNow)
    couplings = new_records(n_couplings, kinds.CouplingNow)
    couplings.RT[:] = parts.couplings.to_socket  # of the ground it stays so
    books = new_records(n_couplings + 2, kinds.Book)
    bodies.p[:, 0] = 1.0
    bodies.A[:] = np.eye(3)
    bodies.r[:-1] = parts.bodies.centre
    redundant = constants.n_rows if constants.rank < constants.n_rows else 0
    course = new_record(kinds.Course)
    course.until = np.inf
    n_nodes = max(constants.n_nodes, 2)
    return MechanismMemory(
        now=Now(course, bodies, couplings, *np.zeros((3, n_nodes, kinds.COLUMN))),
        blocks=np.zeros((n_blocks(data.mass), kinds.N, kinds.COLUMN)),
        independence=np.zeros((redundant, redundant)),
        settled=np.zeros(kinds.N_STATES * n_bodies),
        books=books,
        contact=memory_of_surfaces(data.contact),
        films=stacked_memory(data.films),
        oil=new_oil(data.films.constants.size),
    )


def _size(model: Model) -> float:
    """Return the distance between the farthest points of the drawing, at most twice that [m]."""
    case = model.case
    points = [body.centre for body in case.bodies.values()]
    points += [point for joint in case.joints.values() for point in joint.points]
    points += [point for spring in case.springs.values() for point in spring.points]
    return float(dense.norm(np.ptp(np.array(points), axis=0))) or 1.0


def _bodies(model: Model) -> Any:
    """Return the records of the bodies."""
    pieces, records = model.pieces, new_records(len(model.bodies), kinds.Body)
    records.mass, records.centre[:] = pieces.masses, pieces.centres[:-1]
    for number, record in enumerate(records):
        record.inertia[:] = inertia = pieces.inertia(number)
        record.inverse[:] = dense.inverse(inertia)
    return records


def _couplings(model: Model, signals: SignalList, terms: list[Term]) -> Any:
    """Return the records of joints, springs, loads and legs of elements, in this order; add the terms."""
    case = model.case
    records, n = new_records(len(model.ends), kinds.Coupling), len(model.bodies)
    for record, ends in zip(records, model.ends, strict=True):
        record.socket, record.shaft = (model.number(body) % (n + 1) for body in ends)
    for name in (
        *("node", "row_signal", "follows", "effort", "contact", "film", "table"),
        *("rows_block", "bodies_block", "first_leg", "next_leg", "opening", "load_of"),
    ):
        records[name][:] = NONE
    for record, (name, joint) in zip(records, case.joints.items(), strict=False):
        _fill_joint(record, model, name, joint)
    for contact, number in enumerate(model.real):
        records[number].force, records[number].contact = kinds.CONTACT, contact
        for which, opening in enumerate(model.clearances[model.joints[number]].openings):
            if opening is not None:
                records[number].opening[which] = signals.add(pieces_of(opening), opening.kinks)
    for film, number in enumerate(model.oiled):
        records[number].film = film
    for drive in case.drives.values():
        record = records[model.joints.index(drive.joint)]
        _add_drive(record, case.joints[drive.joint], drive, case.span, signals)
    others = iter(records[len(case.joints) :])
    for spring in case.springs.values():
        _fill_spring(next(others), model, spring)
    for load in case.loads.values():
        record = next(others)
        _place_load(record, model, load)
        fill_load(record, model, load, terms)
    _fill_elements(records, model, signals)
    nodes, rows = n, 0
    for record in records:
        if record.n_rows > 0 or has_law(record):
            record.node, record.first_row = nodes, rows
            nodes, rows = nodes + 1, rows + record.n_rows
        elif record.first_leg != NONE:
            record.node = records[record.first_leg].node
    return records


def _place(record: Any, model: Model, points: ArrayLike, axes: Sequence[FloatArray]) -> None:
    """Fill origins and axes of socket and shaft; ``points`` and ``axes`` as drawn."""
    origins = np.array(points) - model.pieces.centres[[record.socket, record.shaft]]
    record.socket_point[:], record.shaft_point[:] = origins
    record.to_socket[:], record.shaft_axes[:] = axes[0].T, axes[1]


def _fill_joint(record: Any, model: Model, name: str, joint: JointKeys) -> None:
    """Fill a joint: the rows of its type, and what else it is."""
    first, second = axes_of(model.case, joint)
    kind = JOINTS[model.kind(name)]
    axes = [frame(first, second), kind.shaft_axes(first, second)]
    turned = 1 if joint.sign > 0.0 else -1
    axes[turned < 0] = tilted(axes[turned < 0], joint.tilt)
    _place(record, model, joint.points[::turned], axes)
    if name in model.pieces.joints:  # at rest on the ground, for nothing moves in it
        record.socket = record.shaft = len(model.bodies)
    elif name not in model.clearances:
        for row in kind.ROWS:
            _add_row(record, *row)
        kind.fill(record, joint)


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


def _add_drive(record: Any, joint: JointKeys, drive: DriveKeys, duration: float, signals: SignalList) -> None:
    """Add a drive: a row for motion, an effort for torque or force.

    It moves the second body against the first; where that carries the socket, the shaft goes the other way.
    """
    coordinate, level = GIVEN[drive.gives]
    signal = drive.signal.over_run(duration, rising=drive.gives == "angle")
    pieces = pieces_of(signal)
    if joint.sign < 0.0:
        pieces = negated(pieces)
    number = signals.add(integral_of(pieces) if level == 1 else pieces, signal.kinks)
    which = _COORDINATES.index(coordinate)
    if level == 2:
        record.effort[which] = number
    elif which == 0:
        _add_row(record, kinds.ANGLE, 0, 0, number)
    else:
        _add_row(record, kinds.POSITION, 2, 0, number)


def _fill_spring(record: Any, model: Model, spring: SpringKeys) -> None:
    """Fill a spring between two points."""
    _place(record, model, spring.points, (np.eye(3), np.eye(3)))
    record.force = kinds.SPRING
    record.length = spring.drawn_length if spring.length is None else spring.length
    record.stiffness[0], record.damping[0] = spring.stiffness, spring.damping


def _place_load(record: Any, model: Model, load: LoadKeys) -> None:
    """Place a load: on the shaft against the ground, or on the socket where it turns with the body."""
    point = load.acts_at(model.case.bodies[load.body].centre)
    _place(record, model, (point, point), (np.eye(3), np.eye(3)))


def _fill_elements(records: Any, model: Model, signals: SignalList) -> None:
    """Fill the legs of all elements; only the first of each counts the equation, and only where it holds."""
    number = model.first_leg
    for element in model.elements:
        of_element = number
        for equation in element.equations:
            first = number
            for leg in equation.legs:
                record = records[number]
                _fill_leg(record, model, leg)
                if equation.law is not None:
                    _fill_law(record, model, equation.law, signals, of_element)
                if number > first:
                    record.n_rows, record.first_leg, records[number - 1].next_leg = 0, first, number
                number += 1


def _fill_leg(record: Any, model: Model, leg: Leg) -> None:
    """Fill one term of the equation of an element."""
    _place(record, model, leg.points, (tilted(leg.axes, leg.tilt), leg.axes))
    record.along[:], record.about, record.length = leg.along, leg.about, leg.length
    if leg.push is not None:
        record.push[:] = leg.push
    _add_row(record, _MEASURES[leg.measure], 2, 0)


def _fill_law(record: Any, model: Model, law: ForceLaw, signals: SignalList, first: int) -> None:
    """Fill the force law of an element with a first leg; its equation is no constraint."""
    record.law, record.n_rows = law.function.address, 0
    names = law.function.parameters
    record.parameters.values[: len(names)] = [law.parameters[name] for name in names]
    if law.load_of:
        record.load_of = model.joints.index(law.load_of)
    if law.load_leg is not None:
        record.load_of = first + law.load_leg
    if law.table is not None:
        pieces, record.over_rate = pieces_of(law.table), int(law.over_rate)
        record.table[:] = signals.add(pieces), signals.add(integral_of(pieces))


_KINDS: Final = {"ground": kinds.LOAD_GROUND, "body": kinds.LOAD_BODY, "motion": kinds.LOAD_MOTION}
#: Numbers of what loads follow.
_FOLLOWED: Final = {
    "times": kinds.TIME,
    "angles": kinds.FOLLOWED,
    "positions": kinds.FOLLOWED,
    "speeds": kinds.FOLLOWED_SPEED,
    "velocities": kinds.FOLLOWED_SPEED,
}
_SIZE_AT: Final = {"force": 0, "moment": 3}  #: Component that holds the size of a load against the motion.


def terms_of(case: MechanismCase, load: LoadKeys) -> Iterator[Term]:
    """Yield the terms of a load; against the motion they are its size."""
    for vector, factors in parts_of(load, _FOLLOWED, case.period, case.span):
        if load.frame == "motion":
            yield term(_size_at(load), 1.0, factors)
        else:
            yield from (term(int(i), float(vector[i]), factors) for i in np.flatnonzero(vector))


def fill_load(record: Any, model: Model, load: LoadKeys, terms: list[Term]) -> None:
    """Fill the record of a load, and add its terms to those of the loads before it."""
    record.force, record.slip_velocity = _KINDS[load.frame], load.slip
    if load.frame == "motion":
        record.opposes, record.own_speed = _size_at(load), int(load.follows_own_speed)
        if load.direction is not None:
            record.force, record.direction[:] = kinds.LOAD_LINE, unit(load.direction, "direction")
    if load.along is not None:
        record.follows = model.joints.index(load.along)
        record.follows_position = int("position" in {COORDINATE_OF[over] for over in load.joint_axes})
        record.follows_sign = model.case.joints[load.along].sign
    record.first_term = len(terms)
    terms += terms_of(model.case, load)
    record.last_term = len(terms)


def _size_at(load: LoadKeys) -> int:
    return _SIZE_AT[next(iter(load.given))]
