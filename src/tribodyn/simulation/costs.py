"""Memory and processor time of a run, estimated before it starts.

Both are sums over the counts of a :class:`~tribodyn.mechanisms.workload.Workload`. The coefficients were
fitted to 37 runs of all built-in cases: contact grids of 96 to 133,000 nodes, film grids of 1,500 to 25,000
cells, 1 to 30 bodies, 500 to 250,000 samples, up to 160 drive cycles, all integrators but ``cvode``. Memory
is the peak resident size of a process that simulates and saves. Time is its processor time (AMD EPYC),
without compilation, figures and report. The coefficients of memory that belong to the
program and to a number of a sample were fitted again to thirteen runs of up to 83 bodies, and so were all
times but those of films, pictures and integrators in Python: see the page of costs for what came out.
``tests/unit/simulation/test_costs.py`` measures others: within a factor of 2 for memory, 3 for time.
"""

from dataclasses import dataclass
from typing import Final, Self

from tribodyn.core.errors import InputError
from tribodyn.mechanisms.workload import Workload

MOST_MEMORY: Final = 2.0e9  #: Memory above which a warning is given [B].
MOST_TIME: Final = 3600.0  #: Processor time above which a warning is given [s].


class Coefficient(float):
    """A coefficient of the estimate."""

    unit: str  #: Its unit.
    meaning: str  #: What it is multiplied by, and what the product is.

    def __new__(cls, value: float, unit: str, meaning: str) -> Self:
        """Return the number with what is known of it."""
        found = super().__new__(cls, value)
        found.unit, found.meaning = unit, meaning
        return found


PROGRAM: Final = Coefficient(3.0e8, "B", "program with its libraries and compiled equations")
_NODE: Final = Coefficient(
    2.0e3, "B", "node of a contact grid, its share of start, checks and result included"
)
_FIELD_NODE: Final = Coefficient(
    12.0, "B", "node of a pressure field: double precision at first, single precision once kept"
)
_NUMBER: Final = Coefficient(20.0, "B", "number of a sample: as observed, as a column and in the file")
_BREAK: Final = Coefficient(300.0, "B", "restart, with what holds until the next")
_CELL: Final = Coefficient(600.0, "B", "cell of an oil film")
_BAND: Final = Coefficient(32.0, "B", "entry of the band and the border of a film's matrix")
_ASSEMBLY: Final = Coefficient(10.0, "B", "square of the number of states: assembly")
_DENSE: Final = Coefficient(100.0, "B", "the same with integrators that use full matrices")

_START: Final = Coefficient(0.1, "s", "reading, laws, start and result")
_PART: Final = Coefficient(0.03, "s", "joint with clearance: its tables")
_START_STATE: Final = Coefficient(1.0e-4, "s", "state: assembly and start")
_STATES_CUBED: Final = Coefficient(5.0e-11, "s", "cube of the number of states: matrices of the start")
_STEP: Final = Coefficient(2.0e-6, "s", "step in compiled code")
_STATE: Final = Coefficient(4.0e-7, "s", "state in a step")
_EVALUATION: Final = Coefficient(1.7e-9, "s", "node in an evaluation of the contact")
_EVALUATIONS: Final = Coefficient(
    3.5, "1", "evaluations of a step: two of the rates, a sixth of a Jacobian, path integrals"
)
_PYTHON_STEP: Final = Coefficient(5.0e-4, "s", "step of an integrator in Python, additional")
_LONG_STEPS: Final = Coefficient(0.3, "1", "step: steps of `radau` instead, which are longer")
_DENSE_CUBED: Final = Coefficient(1.0e-10, "s", "cube of the number of states in a step with full matrices")
_SAMPLE: Final = Coefficient(2.0e-6, "s", "sample")
_SAMPLE_NUMBER: Final = Coefficient(7.0e-8, "s", "number of a sample, saved")
_SAVED_NODE: Final = Coefficient(1.0e-8, "s", "node of a pressure field, saved")
_FILM_CELL: Final = Coefficient(2.0e-8, "s", "cell of an oil film in an evaluation")
_FILM_ENTRY: Final = Coefficient(3.0e-10, "s", "the same, times the square of the band")
_FILM_START: Final = Coefficient(60.0, "1", "evaluations of a film for the equilibrium")

#: All of them, by their symbols in the manual.
COEFFICIENTS: Final[dict[str, Coefficient]] = {
    **{"m_p": PROGRAM, "m_n": _NODE, "m_f": _FIELD_NODE, "m_q": _NUMBER, "m_b": _BREAK},
    **{"m_c": _CELL, "m_w": _BAND, "m_s": _ASSEMBLY, "m_d": _DENSE},
    **{"t_0": _START, "t_j": _PART, "t_x": _START_STATE, "t_3": _STATES_CUBED},
    **{"t_1": _STEP, "t_s": _STATE, "t_n": _EVALUATION, "e": _EVALUATIONS},
    **{"t_p": _PYTHON_STEP, "t_d": _DENSE_CUBED, "k": _LONG_STEPS, "t_r": _SAMPLE, "t_q": _SAMPLE_NUMBER},
    **{"t_f": _SAVED_NODE, "t_c": _FILM_CELL, "t_w": _FILM_ENTRY, "e_0": _FILM_START},
}


@dataclass(frozen=True)
class Part:
    """A part of an estimate, and the key that reduces it."""

    amount: float
    key: str


@dataclass(frozen=True)
class Estimate:
    """Expected time and memory of a run."""

    memory: float  #: Peak memory of the process [B].
    seconds: float  #: Processor time [s].
    #: Keys of the largest part of each.
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

    def require_memory(self, there: float) -> None:
        """Refuse a run that takes more than is ``there`` [B], even if it takes half of what is expected."""
        if self.memory > 2.0 * there:
            has = f"the {in_bytes(there)} of this machine"
            raise InputError(_warned(in_bytes(self.memory), "memory", has, self.memory_key))


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
    matrices = _ASSEMBLY if work.solver == "mebdf" else _DENSE
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
    step += 0.0 if work.solver == "mebdf" else _PYTHON_STEP + work.states**3 * _DENSE_CUBED
    steps = work.steps * (_LONG_STEPS if work.solver == "radau" else 1.0)
    length = keys.length if work.runs == 1.0 else keys.cycles
    saved = (work.nodes + work.mapped) * work.fields * _SAVED_NODE
    return [
        Part(work.runs * steps * step, length),
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
