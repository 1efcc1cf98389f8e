"""Interface of a mechanism: one descriptor, and the systems that its cases describe.

A mechanism is one folder beside this file and one line in ``FOLDERS`` of ``catalogue.py``, or a package of
its own that registers its descriptor under the entry points ``tribodyn.mechanisms``. Everything above reads
the descriptor and knows no mechanism by name.
"""

from __future__ import annotations

import importlib
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final, Protocol, Self, TypeAlias, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mebdf.arrays import FloatArray
from tribodyn.cases.case import Case
from tribodyn.cases.joint_keys import Wear
from tribodyn.cases.load import BuiltIn
from tribodyn.cases.messages import Remarks
from tribodyn.core.problem import Problem, Solution
from tribodyn.core.remembered import Remembered
from tribodyn.mechanisms.bushing import Carried, WearNodes, Worn
from tribodyn.mechanisms.workload import Workload
from tribodyn.results.summary import KeyResult
from tribodyn.results.variables import Variable

if TYPE_CHECKING:
    from tribodyn.figures.chart import Animation, Family
    from tribodyn.mechanisms.bushing import Bearing
    from tribodyn.views.common import Overlay
    from tribodyn.views.section import Chapter


WearRates: TypeAlias = tuple[float | FloatArray, float | FloatArray]


@dataclass(frozen=True)
class FinishedRun:
    """A finished or interrupted integration on its way to a result."""

    #: What was integrated, and what came of it.
    problem: Problem
    solution: Solution
    #: By the names of :class:`~tribodyn.core.problem.Statistics`; of a campaign that of all its cycles.
    cost: Mapping[str, float]
    carried: bool = False  #: Whether it went on from where another run ended.
    #: Of its data and of its rows, by the names of attributes of a result; of a campaign those of the last
    #: cycle.
    hashes: Mapping[str, str] = field(default_factory=dict)

    @property
    def duration(self) -> float:
        """Simulated time that was asked for [s]."""
        return float(self.problem.t_span[1])

    def rows(self, names: Sequence[str]) -> dict[str, FloatArray]:
        """Return the observed quantities by name, each of shape (n_t,)."""
        return {name: self.solution.rows[:, i] for i, name in enumerate(names)}


@dataclass(frozen=True)
class ResultPart:
    """A part of a result: coordinates, columns, fields, attributes and warnings, by their names in it."""

    #: As :func:`tribodyn.results.build` takes them.
    coordinates: Mapping[str, ArrayLike] = field(default_factory=dict)
    columns: Mapping[str, FloatArray] = field(default_factory=dict)
    fields: Mapping[str, NDArray[np.floating[Any]]] = field(default_factory=dict)
    attributes: Mapping[str, object] = field(default_factory=dict)  #: Facts about the run.
    #: What a user should know before trusting the numbers, and what to read them with; one sentence each.
    warnings: Sequence[str] = ()
    notes: Sequence[str] = ()
    #: Why the run stopped before its end, if it did and the mechanism knows more than the integrator.
    failure: str = ""


class Steps(Protocol):
    """Values of a table ``[solver]`` that a run needs."""

    @property
    def name(self) -> str:
        """Name of the integrator."""
        ...

    @property
    def rtol(self) -> float:
        """Relative tolerance."""
        ...


class SystemCase(Protocol):
    """Values of a case that a run needs, whatever its kind."""

    @property
    def title(self) -> str:
        """Heading of figures and report."""
        ...

    @property
    def duration(self) -> float:
        """Simulated time of the whole run [s]."""
        ...

    @property
    def solver(self) -> Steps:
        """Its table ``[solver]``."""
        ...

    def assumed_wear(self) -> tuple[str, ...]:
        """Return the joints whose wear rate nobody chose, see :class:`~tribodyn.cases.case.Case`."""
        ...

    def wear_scatter(self) -> Mapping[str, tuple[float, float]]:
        """Return the interval of the wear of equal joints, see :class:`~tribodyn.cases.case.Case`."""
        ...

    def remarks(self) -> Remarks:
        """Return remarks on its values."""
        ...

    def to_toml(self) -> str:
        """Return the case as TOML."""
        ...


class WearingCase(SystemCase, Protocol):
    """Values of a case that a wear campaign needs."""

    @property
    def wear(self) -> Wear:
        """Its table ``[wear]``."""
        ...

    @property
    def wear_limits(self) -> Mapping[str, float]:
        """Limits of the motion that end a wear campaign, by what its history calls them."""
        ...

    @property
    def settling_cycles(self) -> int:
        """Cycles simulated before the first one whose wear counts."""
        ...

    @property
    def temperature_times(self) -> tuple[float, ...]:
        """Times of the rows of all temperatures that follow time [s], increasing; none without any."""
        ...


class SimulatedSystem(Protocol):
    """System of one case, ready to be integrated."""

    def check(self) -> Sequence[str]:
        """Put the mechanism together, joints and contact laws with it; raise what a run would refuse.

        Returns what a user should know of the mechanism before it runs, one sentence each.
        """
        ...

    def problem(self, duration: float, worn: Worn | None = None) -> Problem:
        """Return the initial value problem over ``duration`` [s]; where nothing wears ``worn`` is None.

        Raises Stopped if the caller wanted to stop while a place to begin at was looked for.
        """
        ...

    def output_times(self, duration: float) -> FloatArray:
        """Return the times of the rows [s], increasing."""
        ...

    def picture_times(self, duration: float) -> FloatArray:
        """Return the times of the fields [s], increasing; none where no field is kept."""
        ...

    def gather(self, run: FinishedRun) -> ResultPart:
        """Return the mechanism's facts about a run; rows of no length give columns of no length."""
        ...


class WearingSystem(SimulatedSystem, Protocol):
    """A system whose joints wear, in cycles of its drive."""

    def beginning(self, time: float) -> Self:
        """Return the system of a cycle that begins so long [s] after the first: temperatures follow time."""
        ...

    @property
    def nodes(self) -> WearNodes:
        """Worn nodes; none where all joints are ideal."""
        ...

    @property
    def wear_rates(self) -> WearRates:
        """Specific wear rates of bushing and partner [m²/N], each one number or one for each node."""
        ...

    @property
    def period(self) -> float:
        """Time of one drive cycle [s]."""
        ...

    def sliding_load(self, problem: Problem) -> FloatArray:
        """Return ∫P_c |u| dt at the nodes over the run [N/m], in their shape."""
        ...

    def part_of(self, node: int) -> str:
        """Return in words what a node belongs to, counted over the flattened nodes."""
        ...

    def as_field(self, depth: FloatArray) -> FloatArray:
        """Return wear depths [m], the nodes being the last dimensions, as results hold ``wear_depth``."""
        ...

    def carried(self, run: FinishedRun) -> Carried:
        """Return the state from which the next cycle continues."""
        ...

    def of_cycle(self, run: FinishedRun) -> dict[str, float]:
        """Return the numbers of a complete cycle that a campaign keeps, by name."""
        ...

    def output_lives(self, run: FinishedRun, depth: FloatArray) -> Mapping[str, float]:
        """Return after how many cycles the errors of outputs reach their limits, by their names.

        ``run``: a complete cycle at least; ``depth``: what is worn off at the nodes in each cycle [m], in
        their shape. The result holds NaN for outputs that never do, or of which nothing is known.
        """
        ...

    def contact_energy(self, worn: Worn) -> float:
        """Return the energy stored in the contact [J]."""
        ...


#: Returns a key result of the part with a name; the name of the number ends in that of the part.
ByPart: TypeAlias = Callable[[str], KeyResult]


def plain(name: str) -> str:
    """Return the name that a user gave a part as it stands in the name of a number."""
    return re.sub(r"[-\[:]", "_", name).replace("]", "")


#: Key results of the parts of the last cases: those of a sweep have the same.
_of_parts: Final[Remembered[dict[str, KeyResult]]] = Remembered(8)


@dataclass(frozen=True)
class MechanismDescriptor:
    """All that is known of one kind of case.

    What compiles or draws stands in modules of the mechanism's folder that are imported when they are asked
    for: reading a case needs neither.
    """

    folder: str  #: Dotted name of its folder.
    case: type[Case]  #: Its case model.
    built_in: Mapping[str, BuiltIn]  #: Cases that can be run by name.
    #: Quantities of its results beside those that every result has, by name.
    variables: Mapping[str, Variable]
    #: Its key results by their names in ``summary.json``, in reading order.
    key_results: Mapping[str, KeyResult]
    #: Names of those that a reader wants first; ``*`` stands for any part of a name.
    key_numbers: tuple[str, ...]
    #: What its wear campaigns write down about each cycle, by name; empty where nothing wears.
    of_cycle: Mapping[str, Variable] = field(default_factory=dict)
    #: Texts of case files that ``tribodyn new`` copies, by name.
    templates: Mapping[str, str] = field(default_factory=dict)
    #: Key results that each part has, by the table of the case that names these parts, such as ``joints``,
    #: and then by name; see :class:`ByPart`.
    by_part: Mapping[str, Mapping[str, ByPart]] = field(default_factory=dict)
    #: Paths of the keys that a user turns first, the most important one first; ``*`` stands for any name.
    controls: tuple[str, ...] = ()
    #: Tables that a user adds and removes on a page, such as ``joints.*``, with the keys that most of them
    #: need.
    parts: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    #: The function that returns the shafts in bores of a case by the names of their joints, as
    #: ``module:function``; empty where there are none.
    bearings: str = ""

    def bearings_of(self, case: Case) -> Mapping[str, Bearing]:
        """Return the shafts in bores of a case by the names of their joints."""
        if not self.bearings:
            return {}
        module, _, name = self.bearings.partition(":")
        return cast("Mapping[str, Bearing]", getattr(importlib.import_module(module), name)(case))

    def key_results_of(self, parts: Mapping[str, Iterable[str]]) -> dict[str, KeyResult]:
        """Return all key results in reading order, with those of parts, given as names by table."""
        asked = [(table, part) for table in self.by_part for part in parts.get(table, ())]
        named = _of_parts.made(
            (self.folder, *asked),
            lambda: {
                f"{name}_{plain(part)}": made(part)
                for table, part in asked
                for name, made in self.by_part[table].items()
            },
        )
        return {**self.key_results, **named}

    @property
    def kind(self) -> str:
        """Its name under ``case =`` in a file."""
        return self.case.kind()

    def system(self, case: SystemCase) -> SimulatedSystem:
        """Return the system of a case: ``SYSTEM`` of ``system.py``, called with it."""
        return cast(SimulatedSystem, self._module("system").SYSTEM(case))

    def workload(self, case: SystemCase) -> Workload:
        """Return the amount of work and memory of a run of a case: ``WORKLOAD`` of ``workload.py``."""
        return cast(Workload, self._module("workload").WORKLOAD(case))

    @property
    def figures(self) -> Mapping[str, Family]:
        """``FIGURES`` of ``figures``: its figures by the names of their files, in reading order."""
        return cast("Mapping[str, Family]", self._module("figures").FIGURES)

    @property
    def animation(self) -> Animation | None:
        """``ANIMATION`` of ``figures``: how it moves; None where it has none."""
        return cast("Animation | None", getattr(self._module("figures"), "ANIMATION", None))

    @property
    def chapters(self) -> Sequence[Chapter]:
        """``CHAPTERS`` of ``sections``: the chapters of its report, in reading order."""
        return cast("Sequence[Chapter]", self._module("sections").CHAPTERS)

    @property
    def overlays(self) -> Sequence[Overlay]:
        """``OVERLAYS`` of ``sections``: what a comparison of several runs shows."""
        return cast("Sequence[Overlay]", self._module("sections").OVERLAYS)

    def _module(self, name: str) -> Any:
        return importlib.import_module(f"{self.folder}.{name}")
