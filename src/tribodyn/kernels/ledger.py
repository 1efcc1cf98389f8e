"""The energy books of any mechanism: works of its contributors, added up along the motion.

A contributor gives a power, or forces on the coordinates. Both are integrated over every part of an accepted
step with one evaluation at its end: between two marks an integrand is the parabola through them and an
earlier one. Forces are integrated over displacements, because between impacts coordinates oscillate where
forces hardly do, and a constant force is then exact, whatever oscillates. Energies are functions of the
state. What is left over measures the integration.

What swings in a step, as a load of some kilohertz does, is known with its rate: it is the cubic through
values and rates at both ends. A parabola through an earlier mark is late, and what is late makes work of a
force that stands across its velocity.

Inertia takes in ½ (p_a + p_b)·(q̇_b − q̇_a) over a part, with the momenta p = N q̇ and q̇ taken from the
numerical solution, not from the equations of motion: exact where N does not change.

A mechanism fills the entries ``NOW`` of powers, forces and motion at an instant and then calls :func:`begin`
or :func:`add_part`.
"""

from typing import Final

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record, RecordType, record_type
from tribodyn.kernels.jit import kernel, new_record

NOW: Final = 0
LAST: Final = 1
EARLIER: Final = 2  #: The present mark, the last one, and one before that.
POSITION: Final = 0
SPEED: Final = 1
MOMENTUM: Final = 2
SWING: Final = 0
RATE: Final = 1
NO_SWING: Final = -1

NEAR: Final = 0.2  #: Marks closer than this part of the next interval do not tell how the integrands bend.


def books_type(n_powers: int, n_forces: int, n: int) -> RecordType:
    """Return the type of books of ``n`` coordinates.

    times
        Of the three marks [s], shape (3,).
    powers
        At the three marks [W], shape (3, n_powers).
    forces
        On the coordinates at the three marks [N, N m], shape (3, n, n_forces).
    motion
        Coordinates, their velocities and the momenta at ``NOW`` and ``LAST``, shape (2, 3, n).
    swing
        Swinging forces on the coordinates and their rates at ``NOW`` and ``LAST`` [N, N/s], shape (2, 2, n).
    swing_of
        To which of the forces they belong; :data:`NO_SWING` where there are none.
    works
        Path integrals [J], shape (n_powers + n_forces + 1,): of the powers, of the forces, and what inertia
        has taken in.
    """
    return record_type(
        ("times", "f8", (3,)),
        ("powers", "f8", (3, n_powers)),
        ("forces", "f8", (3, n, n_forces)),
        ("motion", "f8", (2, 3, n)),
        ("swing", "f8", (2, 2, n)),
        ("swing_of", "i8"),
        ("works", "f8", (n_powers + n_forces + 1,)),
    )


def new_books(books: RecordType, swing_of: int = NO_SWING) -> Record:
    """Return books that nothing has been added to.

    ``swing_of`` is the number of the forces whose work that of swinging forces is a part of.
    """
    empty = new_record(books)
    empty.swing_of = swing_of
    return empty


@kernel
def swings(books: Record) -> bool:
    """Tell whether there are swinging forces, whose entries ``NOW`` must be filled."""
    there: bool = books.swing_of != NO_SWING
    return there


@kernel
def begin(books: Record, t: float) -> None:
    """Make the present entries, of the time ``t`` [s], the mark from which :func:`add_part` goes on."""
    _set_mark(books, t)
    books.times[EARLIER] = t


@kernel
def add_part(books: Record, t: float) -> None:
    """Add the works from the last mark to the present entries, of the time ``t`` [s], and set the mark there.

    Where the earlier mark is too near for its parabola to be trusted, as after a restart, the straight line
    through the last two is taken.
    """
    times = books.times
    h, back = t - times[LAST], times[LAST] - times[EARLIER]
    known = back > NEAR * h
    _add_powers(books, h, back, known)
    _add_forces(books, h, back, known)
    if swings(books):
        _add_swing(books, h)
    if h > NEAR * back:
        _take_over(books, LAST, EARLIER)
        times[EARLIER] = times[LAST]
    _set_mark(books, t)


@kernel
def is_at_mark(books: Record, t: float, y: FloatArray) -> bool:
    """Tell whether the last mark was set at the time ``t`` and the state ``y``, shape (2n,)."""
    motion, n = books.motion, books.motion.shape[2]
    same = books.times[LAST] == t
    for i in range(n):
        same = same and motion[LAST, POSITION, i] == y[i] and motion[LAST, SPEED, i] == y[n + i]
    return same


@kernel
def _set_mark(books: Record, t: float) -> None:
    """Take over the present entries as those of the last mark."""
    _take_over(books, NOW, LAST)
    motion = books.motion
    for k in range(3):
        for i in range(motion.shape[2]):
            motion[LAST, k, i] = motion[NOW, k, i]
    if swings(books):
        for k in range(2):
            for i in range(motion.shape[2]):
                books.swing[LAST, k, i] = books.swing[NOW, k, i]
    books.times[NOW] = books.times[LAST] = t


@kernel
def _take_over(books: Record, source: int, target: int) -> None:
    """Copy powers and forces of one mark to another."""
    powers, forces = books.powers, books.forces
    for k in range(powers.shape[1]):
        powers[target, k] = powers[source, k]
    for i in range(forces.shape[1]):
        for k in range(forces.shape[2]):
            forces[target, i, k] = forces[source, i, k]


@kernel
def _bend(now: float, last: float, earlier: float, h: float, back: float, known: bool) -> float:
    """Return half the second derivative of the parabola through three values, times h²; 0 if not known."""
    return h * (now - last - h / back * (last - earlier)) / (h + back) if known else 0.0


@kernel
def _add_powers(books: Record, h: float, back: float, known: bool) -> None:
    """Add ∫ P dt = h (P_a + P_b)/2 − h b/6 of the parabola with the bend b."""
    powers = books.powers
    for k in range(powers.shape[1]):
        now, last = powers[NOW, k], powers[LAST, k]
        bend = _bend(now, last, powers[EARLIER, k], h, back, known)
        books.works[k] += h * (0.5 * (now + last) - bend / 6.0)


@kernel
def _add_forces(books: Record, h: float, back: float, known: bool) -> None:
    """Add ∫ F dq of the parabola F and the cubic Hermite polynomial q, and what inertia takes in.

    With Δq = q_b − q_a and the bend b of the force that is Δq (F_a + F_b)/2 + h ΔF Δq̇/12 −
    b (Δq/5 − h (q̇_a + q̇_b)/60).
    """
    forces, works = books.forces, books.works
    first, inertia = books.powers.shape[1], books.works.size - 1
    here, before = books.motion[NOW], books.motion[LAST]
    for i in range(forces.shape[1]):
        way, change = here[POSITION, i] - before[POSITION, i], here[SPEED, i] - before[SPEED, i]
        curved = 0.2 * way - h / 60.0 * (here[SPEED, i] + before[SPEED, i])
        for k in range(forces.shape[2]):
            now, last = forces[NOW, i, k], forces[LAST, i, k]
            bend = _bend(now, last, forces[EARLIER, i, k], h, back, known)
            works[first + k] += 0.5 * way * (now + last) + h / 12.0 * change * (now - last) - bend * curved
        works[inertia] += 0.5 * (before[MOMENTUM, i] + here[MOMENTUM, i]) * change


@kernel
def _add_swing(books: Record, h: float) -> None:
    """Add ∫ F dq of cubic Hermite polynomials F and q.

    With a = h Ḟ_a − ΔF and b = h Ḟ_b − ΔF that is Δq (F_a + F_b)/2 + h ΔF Δq̇/12 + a (Δq/10 − h q̇_b/60) −
    b (Δq/10 − h q̇_a/60).
    """
    swing, here, before = books.swing, books.motion[NOW], books.motion[LAST]
    work = books.powers.shape[1] + books.swing_of
    for i in range(swing.shape[2]):
        way, change = here[POSITION, i] - before[POSITION, i], here[SPEED, i] - before[SPEED, i]
        rise = swing[NOW, SWING, i] - swing[LAST, SWING, i]
        first, last = h * swing[LAST, RATE, i] - rise, h * swing[NOW, RATE, i] - rise
        books.works[work] += (
            0.5 * way * (swing[NOW, SWING, i] + swing[LAST, SWING, i])
            + h / 12.0 * rise * change
            + first * (0.1 * way - h / 60.0 * here[SPEED, i])
            - last * (0.1 * way - h / 60.0 * before[SPEED, i])
        )
