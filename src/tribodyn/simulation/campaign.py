"""Wear over many cycles by cycle jumping, and its numbers at every stop.

A campaign stops at some cycles. At each stop one drive cycle is simulated with the bushing as worn as it is
then, from the state and the memory of contact in which the cycle simulated before it ended. Its sliding load
is repeated over the cycles of the jump that follows, the simulated one among them. What lies between two
simulated cycles is a :class:`Campaign`, and nothing else: a campaign continues from it to the same bits.
"""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Final, Protocol

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.errors import Stopped
from tribodyn.core.problem import Statistics
from tribodyn.integrate import INTERRUPTED
from tribodyn.mechanisms.bushing import Carried
from tribodyn.results.variables import CAMPAIGN
from tribodyn.wear import Archard, JumpControl, load_change, worn_volume

#: Columns over the stops of a campaign, by their names in the result, each of shape (n_jumps,).
History = dict[str, FloatArray]

MOST_STAGES: Final = 32  #: Worn profiles that are kept of a campaign, however long it is.


def columns(of_cycle: Iterable[str]) -> tuple[str, ...]:
    """Return the names of all columns, those that a mechanism writes down about each cycle among them."""
    return (*CAMPAIGN, *of_cycle)


def thinned(cycles: FloatArray, depth: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return worn profiles and their cycles, every second one left out when they are too many.

    The latest is always kept. Later ones are added at every jump, so that a long campaign keeps early
    profiles further apart than late ones, never more than :data:`MOST_STAGES`.

    ``cycles``: cycles at the profiles, shape (n,); ``depth``: depth [m], shape (n, n_z + 2, n_theta).
    """
    if cycles.size <= MOST_STAGES:
        return cycles, depth
    kept = np.arange(cycles.size)[::-2][::-1]
    return cycles[kept], depth[kept]


@dataclass(frozen=True)
class CampaignPlan:
    """Request for a campaign."""

    cycles: int  #: Drive cycles to wear for.
    settling: int  #: Cycles simulated before the first one whose wear counts.
    feedback: bool  #: Whether the worn shape changes the gap.
    depth_limit: float  #: Depth at which the campaign ends [m]; infinite for none.
    #: Wear law, and what chooses the length of jumps.
    law: Archard
    control: JumpControl
    #: Area that each node stands for [m²], in the shape of the nodes; all fields below have it.
    node_area: FloatArray
    of_cycle: tuple[str, ...]  #: What is written down about the motion of each cycle, by name.
    #: Those of its entries that end the campaign, with the value at which they do.
    limits: Mapping[str, float] = field(default_factory=dict)
    changes: tuple[int, ...] = ()  #: Cycles at which temperatures change, increasing: no jump passes one.


@dataclass(frozen=True)
class Cycle:
    """One simulated cycle."""

    carried: Carried  #: State and memory of contact at its end.
    sliding_load: FloatArray  #: ∫P_c |u| dt over the cycle at the nodes [N/m].
    #: Entries of the history that describe its motion; empty if it was not completed.
    motion: dict[str, float]
    statistics: Statistics  #: What it cost.
    failure: str | None  #: Why it was not completed, if it was not.


class Cycles(Protocol):
    """The cycles of a system whose bushing wears."""

    def cycle(self, wear: FloatArray, carried: Carried | None, done: int) -> Cycle:
        """Simulate one cycle with a worn bushing, from the start of a run or from where one ended.

        ``wear``: depth at the nodes [m]; ``carried``: where to continue from; ``done``: cycles of wear
        behind; below zero before the first one whose wear counts.
        """
        ...

    def contact_energy(self, wear: FloatArray, carried: Carried) -> float:
        """Return the energy stored in the contact at a state [J]."""
        ...


@dataclass(frozen=True)
class Campaign:
    """A campaign between two simulated cycles."""

    cycles: int  #: Cycles of wear behind.
    depth: FloatArray  #: Wear depth at the nodes [m].
    carried: Carried | None  #: Where the last simulated cycle ended; none before the first.
    load: FloatArray  #: Its sliding load [N/m]; zero before the first stop.
    gain: float  #: Depth that the last jump gained at its deepest, over the roughness.
    life: float  #: Cycles after which a limit was reached; infinite if none was.
    history: History  #: What was written down at the stops so far.
    #: Selected worn profiles [m] and their cycles, shapes (n,) and (n, ...).
    stage_cycles: FloatArray
    stage_depth: FloatArray
    statistics: dict[str, float]  #: Cost so far.


def run_campaign(
    system: Cycles, plan: CampaignPlan, resumed: Campaign | None, keep: Callable[[Campaign], None]
) -> tuple[Campaign, Cycle]:
    """Run a campaign to its end, or to a cycle that fails.

    Return the bushing at the end, and the cycle simulated with it; if the caller stopped the campaign between
    two cycles, the last one simulated, with that as its failure. Raises ``Stopped`` if that was before a
    cycle was simulated. ``resumed``: where an earlier run of the same campaign was, None for the beginning;
    ``keep``: called after every jump with what the campaign continues from.
    """
    worn, cycle = (resumed, None) if resumed is not None else _settled(system, plan)
    while cycle is None or cycle.failure is None:
        try:
            cycle = system.cycle(_gap(worn, plan), worn.carried, worn.cycles)
            worn = replace(worn, statistics=_added(worn.statistics, cycle.statistics))
            if cycle.failure is None:
                worn = replace(worn, life=min(worn.life, _moved_until(worn, cycle, plan)))
                if worn.cycles >= plan.cycles or math.isfinite(worn.life):
                    return _noted(worn, cycle, plan), cycle
                worn = _jumped(system, worn, cycle, plan)
                keep(worn)
        except Stopped:
            if cycle is None:
                raise
            return worn, replace(cycle, failure=INTERRUPTED)
    return worn, cycle


def _settled(system: Cycles, plan: CampaignPlan) -> tuple[Campaign, Cycle | None]:
    """Simulate the cycles that let the start die away; return also the last of them, if there is any."""
    nothing = np.zeros(plan.node_area.shape)
    worn = Campaign(
        cycles=0,
        depth=nothing,
        carried=None,
        load=nothing,
        gain=0.0,
        life=math.inf,
        history={name: np.empty(0) for name in columns(plan.of_cycle)},
        stage_cycles=np.empty(0),
        stage_depth=np.empty((0, *plan.node_area.shape)),
        statistics=vars(Statistics()),
    )
    cycle: Cycle | None = None
    for done in range(-plan.settling, 0):
        cycle = system.cycle(nothing, worn.carried, done)
        statistics = _added(worn.statistics, cycle.statistics)
        worn = replace(worn, carried=cycle.carried, statistics=statistics)
        if cycle.failure is not None:
            break
    return worn, cycle


def _gap(worn: Campaign, plan: CampaignPlan) -> FloatArray:
    """Return the wear depth that the contact feels [m]."""
    return worn.depth if plan.feedback else np.zeros(plan.node_area.shape)


def _jumped(system: Cycles, worn: Campaign, cycle: Cycle, plan: CampaignPlan) -> Campaign:
    """Write the stop down and wear the bushing for the cycles of a jump."""
    per_cycle = plan.law.depth(cycle.sliding_load)
    until_limit = _cycles_to(plan.depth_limit, worn.depth, per_cycle)
    cycles = min(_jump(worn, cycle, plan), math.ceil(min(until_limit, plan.cycles)))
    after = replace(
        worn,
        cycles=worn.cycles + cycles,
        depth=worn.depth + cycles * per_cycle,
        carried=cycle.carried,
        load=cycle.sliding_load,
        gain=cycles * float(per_cycle.max()) / plan.control.roughness,
        life=worn.cycles + until_limit if until_limit <= cycles else math.inf,
    )
    lost = system.contact_energy(_gap(worn, plan), cycle.carried)
    lost -= system.contact_energy(_gap(after, plan), cycle.carried)
    stages = (
        np.append(worn.stage_cycles, after.cycles),
        np.append(worn.stage_depth, after.depth[None], axis=0),
    )
    stage_cycles, stage_depth = thinned(*stages)
    history = _noted(worn, cycle, plan, cycles, lost).history
    return replace(after, history=history, stage_cycles=stage_cycles, stage_depth=stage_depth)


def _jump(worn: Campaign, cycle: Cycle, plan: CampaignPlan) -> int:
    """Return the cycles of the next jump, the simulated one among them, as its change of load allows."""
    remaining = min([plan.cycles, *(at for at in plan.changes if at > worn.cycles)]) - worn.cycles
    if not (plan.feedback or plan.changes):
        return remaining
    gain = plan.control.first
    if worn.gain > 0.0:
        gain = plan.control.next(worn.gain, load_change(cycle.sliding_load, worn.load))
    return plan.control.cycles(gain, plan.law.depth(cycle.sliding_load), remaining)


def _cycles_to(limit: float, depth: FloatArray, per_cycle: FloatArray) -> float:
    """Return after how many cycles some point is as deep as ``limit`` [m]."""
    wearing = per_cycle > 0.0
    if not (math.isfinite(limit) and wearing.any()):
        return math.inf
    return float(((limit - depth[wearing]) / per_cycle[wearing]).min())


def _moved_until(worn: Campaign, cycle: Cycle, plan: CampaignPlan) -> float:
    """Return after how many cycles the motion reached a limit, straight between stops."""
    lives = [math.inf]
    for name, limit in plan.limits.items():
        stops = np.append(worn.history["wear_cycles"], worn.cycles)[-2:]
        values = np.append(worn.history[name], cycle.motion[name])[-2:]
        if values[-1] >= limit:
            lives.append(float(np.interp(limit, values, stops)))
    return min(lives)


def _noted(worn: Campaign, cycle: Cycle, plan: CampaignPlan, jump: int = 0, lost: float = 0.0) -> Campaign:
    """Return the campaign with a stop written down, from which a jump of ``jump`` cycles follows."""
    entry = {
        **cycle.motion,
        "wear_cycles": float(worn.cycles),
        "wear_jump_cycles": float(jump),
        "wear_depth_max": float(worn.depth.max()),
        "wear_volume": worn_volume(worn.depth, plan.node_area),
        "wear_rate": float(plan.law.depth(cycle.sliding_load).max()),
        "wear_load_change": load_change(cycle.sliding_load, worn.load),
        "wear_energy_lost": lost,
    }
    history = {name: np.append(values, entry[name]) for name, values in worn.history.items()}
    return replace(worn, history=history)


def _added(before: dict[str, float], cost: Statistics) -> dict[str, float]:
    """Return the cost so far with that of one more cycle."""
    return {name: before[name] + value for name, value in vars(cost).items()}
