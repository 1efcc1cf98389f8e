"""The books of a mechanism: work and heat of every coupling, and the impulse on the whole.

Integrands are known at marks, the ends of the parts of accepted steps; between two of them an integrand is
the parabola through both and one before, where that one is not too near.
"""

from typing import Any, Final

from tribodyn.kernels.jit import kernel
from tribodyn.kernels.ledger import NEAR
from tribodyn.kernels.mechanism.bodies import kinetic
from tribodyn.kernels.mechanism.data import N_POWERS, Now, Parts
from tribodyn.kernels.mechanism.vectors import cross, turn, turn_back

NOW: Final = 0
LAST: Final = 1
EARLIER: Final = 2


@kernel
def fill_totals(data: Parts, memory: Now) -> None:
    """Fill energies and momentum of the bodies, and the external force on them, about the origin."""
    course, constants = memory.course, data.constants
    course.kinetic = course.potential = 0.0
    for i in range(6):
        course.momentum[i] = course.external[i] = 0.0
    local, arm, total = memory.rest[0, :3], memory.rest[0, 3:6], memory.rest[1, :3]
    for b in range(data.bodies.size):
        body, now = data.bodies[b], memory.bodies[b]
        course.kinetic += kinetic(body, now, local)
        turn(now.A, local, total)
        cross(now.r, now.v, arm)
        for i in range(3):
            weight = body.mass * constants.gravity[i]
            course.potential -= weight * (now.r[i] - body.centre[i])
            course.momentum[i] += body.mass * now.v[i]
            course.momentum[3 + i] += body.mass * arm[i] + total[i]
            course.external[i] += weight
        cross(now.r, constants.gravity, arm)
        for i in range(3):
            course.external[3 + i] += body.mass * arm[i]
    for k in range(data.couplings.size):
        _add_ground(data, memory, k)


@kernel
def _add_ground(data: Parts, memory: Now, number: int) -> None:
    """Add the forces of a coupling to the ground on the bodies."""
    coupling, now, ground = data.couplings[number], memory.couplings[number], data.bodies.size
    if coupling.socket != ground and coupling.shaft != ground:
        return
    sign = 1.0 if coupling.socket == ground else -1.0
    external = memory.course.external
    f, m, arm, place = memory.rest[0, :3], memory.rest[0, 3:6], memory.rest[1, :3], memory.rest[1, 3:6]
    local = now.work[0, :6]
    for i in range(6):
        local[i] = sign * (now.wrench[i] + now.constraint[i])
    turn_back(now.RT, local[:3], f)
    turn_back(now.RT, local[3:6], m)
    turn_back(now.RT, now.x, place)
    for i in range(3):
        place[i] += memory.bodies[coupling.socket].r[i]
    cross(place, f, arm)
    for i in range(3):
        external[i] += f[i]
        external[3 + i] += m[i] + arm[i]


@kernel
def _fill_marks(memory: Now, books: Any) -> None:
    """Fill the integrands of now."""
    n = memory.couplings.size
    for k in range(n):
        for i in range(N_POWERS):
            books[k].marks[NOW, i] = memory.couplings[k].powers[i]
    for i in range(3):
        books[n].marks[NOW, i] = memory.course.external[i]
        books[n + 1].marks[NOW, i] = memory.course.external[3 + i]


@kernel
def begin(data: Parts, memory: Now, books: Any, t: float) -> None:
    """Set the mark from which :func:`add_part` goes on."""
    fill_totals(data, memory)
    _fill_marks(memory, books)
    _move(books, NOW, LAST)
    memory.course.times[LAST] = memory.course.times[EARLIER] = t


@kernel
def _move(books: Any, source: int, target: int) -> None:
    for k in range(books.size):
        for i in range(N_POWERS):
            books[k].marks[target, i] = books[k].marks[source, i]


@kernel
def add_part(data: Parts, memory: Now, books: Any, t: float) -> None:
    """Add the integrals from the last mark to ``t``, where everything stands settled."""
    fill_totals(data, memory)
    _fill_marks(memory, books)
    times = memory.course.times
    h, back = t - times[LAST], times[LAST] - times[EARLIER]
    known = back > NEAR * h
    for k in range(books.size):
        book = books[k]
        for i in range(N_POWERS):
            now, last = book.marks[NOW, i], book.marks[LAST, i]
            bend = (
                h * (now - last - h / back * (last - book.marks[EARLIER, i])) / (h + back) if known else 0.0
            )
            book.sums[i] += h * (0.5 * (now + last) - bend / 6.0)
    if h > NEAR * back:
        _move(books, LAST, EARLIER)
        times[EARLIER] = times[LAST]
    _move(books, NOW, LAST)
    times[LAST] = t
