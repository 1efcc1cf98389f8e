"""Memory and processor time of a run, estimated before it starts.

Both are sums over the counts of a :class:`~tribodyn.mechanisms.workload.Workload`. The coefficients were
fitted to 37 runs of all built-in cases: contact grids of 96 to 133,000 nodes, film grids of 1,500 to 25,000
cells, 1 to 30 bodies, 500 to 250,000 samples, up to 160 drive cycles, all integrators but ``cvode``. Memory
is the peak resident size of a process that simulates and saves. Time is its processor time (AMD EPYC),
without compilation, figures and report. Estimate over measurement was 0.9 to 1.4 for memory and 0.7 to 2.7
for time. ``tests/unit/simulation/test_costs.py`` measures others: within a factor of 2 for memory, 3 for
time.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from tribodyn.mechanisms.workload import Workload

MOST_MEMORY: Final = 2.0e9
"""Memory above which a warning is given [B]."""
MOST_TIME: Final = 3600.0
"""Processor time above which a warning is given [s]."""

PROGRAM: Final = 3.6e8
"""Program with its libraries and compiled equations [B]."""
_NODE: Final = 2.0e3
"""Node of a contact grid, its share of start, checks and result included [B]."""
_FIELD_NODE: Final = 12.0
"""Node of a pressure field: double precision on the way, and single precision of those kept [B]."""
_NUMBER: Final = 45.0
"""Number of a sample: on the way, sorted, as a column, and on the way into the file [B]."""
_BREAK: Final = 300.0
"""Restart, with what holds until the next [B]."""
_CELL: Final = 600.0
_BAND: Final = 32.0
"""Cell of an oil film, and each entry of the band and the border of its matrix [B]."""
_ASSEMBLY: Final = 10.0
_DENSE: Final = 100.0
"""Square of the number of states: in the assembly, and in integrators with full matrices [B]."""

_START: Final = 0.5
_PART: Final = 0.3
_START_STATE: Final = 3.0e-3
"""Reading, laws, start and result; what a joint with clearance and a state add [s]."""
_STATE: Final = 1.0e-6
"""Step, for each state [s]."""
_STEP: Final = 5.0e-6
_PYTHON_STEP: Final = 5.0e-4
"""Step in compiled code, and what an integrator in Python adds [s]."""
_EVALUATION: Final = 3.0e-9
"""Node in an evaluation of the contact [s]."""
_EVALUATIONS: Final = 3.5
"""Evaluations of a step: two of the rates, a sixth of a Jacobian, path integrals."""
_SAMPLE: Final = 5.0e-6
_SAMPLE_NUMBER: Final = 2.0e-7
"""Sample, and each number of it, saved [s]."""
_SAVED_NODE: Final = 1.0e-8
"""Node of a pressure field [s]."""
_FILM_CELL: Final = 2.0e-8
_FILM_ENTRY: Final = 3.0e-10
"""Cell of an oil film in an evaluation, and each entry of the square of its band [s]."""
_FILM_START: Final = 60.0
"""Evaluations of a film for the equilibrium."""
_STATES_CUBED: Final = 2.0e-9
_DENSE_CUBED: Final = 1.0e-10
"""Cube of the number of states: singular values in the assembly, and a step with full matrices [s]."""


@dataclass(frozen=True)
class Part:
    """A part of an estimate, and the key that reduces it."""

    amount: float
    key: str


@dataclass(frozen=True)
class Estimate:
    """What a run is expected to take.

    Attributes
    ----------
    memory
        Peak memory of the process [B].
    seconds
        Processor time [s].
    memory_key, time_key
        Keys of the largest part of each.
    """

    memory: float
    seconds: float
    memory_key: str
    time_key: str

    def __str__(self) -> str:
        """Return both in words."""
        return f"{in_bytes(self.memory)} of memory, {in_time(self.seconds)} of processor time"

    @property
    def warnings(self) -> tuple[str, ...]:
        """A sentence for each limit that is passed: value, limit, what to do."""
        found = []
        if self.memory > MOST_MEMORY:
            found.append(_warned(in_bytes(self.memory), "memory", in_bytes(MOST_MEMORY), self.memory_key))
        if self.seconds > MOST_TIME:
            found.append(_warned(in_time(self.seconds), "processor time", in_time(MOST_TIME), self.time_key))
        return tuple(found)


def _warned(value: str, what: str, limit: str, key: str) -> str:
    return f"the run is estimated to take {value} of {what}, more than {limit}: change {key}"


def estimated(work: Workload) -> Estimate:
    """Return the memory and the processor time of a run."""
    memory, seconds = _memory(work), _seconds(work)
    return Estimate(
        memory=PROGRAM + sum(part.amount for part in memory),
        seconds=_START + sum(part.amount for part in seconds),
        memory_key=max(memory, key=lambda part: part.amount).key,
        time_key=max(seconds, key=lambda part: part.amount).key,
    )


def _memory(work: Workload) -> list[Part]:
    keys = work.keys
    matrices = _ASSEMBLY if work.own_matrix else _DENSE
    return [
        Part(work.nodes * (_NODE + _FIELD_NODE * work.fields), keys.nodes),
        Part(work.cells * (_CELL + _BAND * work.band) + work.mapped * _FIELD_NODE * work.fields, keys.cells),
        Part(work.samples * work.quantities * _NUMBER, keys.samples),
        Part(work.followed * work.quantities * _NUMBER, keys.followed),
        Part(work.breaks * _BREAK, keys.length),
        Part(work.states**2 * matrices, "bodies"),
    ]


def _seconds(work: Workload) -> list[Part]:
    keys, film = work.keys, work.cells * (_FILM_CELL + _FILM_ENTRY * work.band**2)
    sample = _SAMPLE + work.quantities * _SAMPLE_NUMBER + work.nodes * _EVALUATION + film
    step = _STEP + work.states * _STATE + _EVALUATIONS * (work.nodes * _EVALUATION + film)
    step += 0.0 if work.compiled else _PYTHON_STEP + work.states**3 * _DENSE_CUBED
    length = keys.length if work.runs == 1.0 else keys.cycles
    saved = (work.nodes + work.mapped) * work.fields * _SAVED_NODE
    return [
        Part(work.runs * work.steps * step, length),
        Part(work.runs * work.samples * sample, keys.samples),
        Part(work.runs * work.followed * sample, keys.followed),
        Part(work.runs * saved, keys.nodes),
        Part(_FILM_START * film, keys.cells),
        Part(work.joints * _PART, "joints"),
        Part(work.states * _START_STATE + work.states**3 * _STATES_CUBED, "bodies"),
    ]


def in_bytes(memory: float) -> str:
    """Return an amount of memory with its unit."""
    return f"{memory / 1.0e9:.2g} GB"


def in_time(seconds: float) -> str:
    """Return a time with its unit."""
    for unit, size in (("s", 1.0), ("min", 60.0), ("h", 3600.0), ("days", 86400.0)):
        if seconds < 90.0 * size or unit == "days":
            return f"{seconds / size:.2g} {unit}"
    raise AssertionError
