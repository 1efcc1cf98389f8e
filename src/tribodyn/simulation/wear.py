"""Wear: the linear estimate of a plain run, and campaigns over many cycles of a system that wears."""

import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Final, cast

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.joint_keys import Wear
from tribodyn.mechanisms.bushing import Carried, Worn
from tribodyn.mechanisms.mechanism_protocol import FinishedRun, ResultPart, WearingCase, WearingSystem
from tribodyn.simulation import checkpoint as checkpoints
from tribodyn.simulation.campaign import Campaign, CampaignPlan, Cycle, run_campaign
from tribodyn.simulation.session import Session
from tribodyn.wear import Archard, JumpControl, worn_volume

if TYPE_CHECKING:
    import xarray as xr

_ROUNDING: Final = 1.0e-9


def simulate_plain(session: Session) -> "xr.Dataset":
    """Run a case of a system that wears once; its wear is what one run makes, without feedback."""
    system, wear = cast(WearingSystem, session.system), cast(WearingCase, session.case).wear
    run = session.integrated(session.case.duration)
    load = system.sliding_load(run.problem)
    depth = _archard(system, wear).depth(load) if load.size else load
    cycles = run.solution.t_end / system.period
    of_outputs, notes = _by_error(system, run, cycles, depth)
    life = _linear_life(wear, cycles, depth, of_outputs)
    if life:
        life |= _stated_factor(cast(WearingCase, session.case))
    part = _worn(system, depth, cast(WearingCase, session.case), life)
    fields = {**part.fields, **of_outputs}
    return session.dataset(run, replace(part, fields=fields, notes=[*part.notes, *notes]))


def simulate_campaign(session: Session, checkpoint: Path | None) -> "xr.Dataset":
    """Run the wear campaign of a case, see :func:`tribodyn.simulation.simulate`."""
    text, cycles = session.case.to_toml(), _Cycles(session)
    columns = tuple(session.mechanism.of_cycle)
    shape, n_states = cycles.plan.node_area.shape, cycles.system.nodes.n_states
    found = None if checkpoint is None else checkpoints.read(checkpoint, text, shape, n_states, columns)
    resumed, changes = (None, []) if found is None else found

    def keep(campaign: Campaign) -> None:
        if checkpoint is not None:
            checkpoints.write(checkpoint, campaign, text)

    campaign, cycle = run_campaign(cycles, cycles.plan, resumed, keep)
    attributes: dict[str, object] = {"wear_cycles_reached": campaign.cycles}
    if math.isfinite(campaign.life):
        attributes |= {"wear_life_cycles": campaign.life} | _stated_factor(cast(WearingCase, session.case))
    part = _worn(cycles.system, campaign.depth, cycles.case, attributes)
    more = replace(
        part,
        coordinates={
            "jump": np.arange(campaign.history["wear_cycles"].size, dtype=np.float64),
            "stage_cycles": campaign.stage_cycles,
        },
        fields={
            **part.fields,
            **campaign.history,
            "stage_depth": cycles.system.as_field(campaign.stage_depth),
        },
        warnings=[*changes, *_not_reached(cycles.case, campaign)],
        failure=cycle.failure or "",
    )
    return cycles.session.dataset(replace(cycles.last, cost=campaign.statistics), more)


def _archard(system: WearingSystem, wear: Wear) -> Archard:
    """Return the wear law of a case."""
    bushing, partner = system.wear_rates
    return Archard(bushing + partner, wear.paper_hardness_divisor)


def _of_partner(system: WearingSystem, depth: FloatArray, volume: float) -> ResultPart:
    """Return the wear of the bushing's partner; nothing where only the bushing wears."""
    bushing, partner = (np.broadcast_to(rate, depth.shape) for rate in system.wear_rates)
    both = np.maximum(bushing + partner, np.finfo(np.float64).tiny)
    own = depth * partner / both
    share = 100.0 * worn_volume(own, system.nodes.area) / volume if volume > 0.0 else 0.0
    if share == 0.0:
        return ResultPart()
    words = f"Of the worn depth and volume {share:.3g} % are worn off the partner of the bushing."
    return ResultPart(fields={"partner_wear_depth": system.as_field(own)}, notes=[words])


def _worn(
    system: WearingSystem, depth: FloatArray, case: WearingCase, attributes: Mapping[str, object]
) -> ResultPart:
    """Return the wear in a result after its run; ``depth`` at the nodes [m]."""
    if not depth.size:
        return ResultPart()
    limit = case.wear.depth_limit
    volume = worn_volume(depth, system.nodes.area)
    partner = _of_partner(system, depth, volume)
    return ResultPart(
        fields={"wear_depth": system.as_field(depth), **partner.fields},
        attributes={
            "worn_volume": volume,
            **({} if limit is None else {"wear_depth_limit": limit}),
            **attributes,
        },
        notes=[*partner.notes, *_deepest(system, depth, case), *_uncertain(case, attributes)],
    )


def _deepest(system: WearingSystem, depth: FloatArray, case: WearingCase) -> list[str]:
    """Return the deepest wear and its distance from the depth limit, in words; nothing without one."""
    limit = case.wear.depth_limit
    if limit is None or not depth.any():
        return []
    node = int(np.argmax(depth))
    share = 100.0 * float(depth.ravel()[node]) / limit
    low, high = (f"{share * end:.2g}" for end in _scatter(case))
    return [f"Worn deepest is {system.part_of(node)}: {low} to {high} % of wear.depth_limit."]


def _uncertain(case: WearingCase, attributes: Mapping[str, object]) -> list[str]:
    """Return the scatter of a life in words; nothing without a life."""
    if "wear_life_factor" not in attributes:
        return []
    low, high = (f"{end:.2g}" for end in _scatter(case))
    return [
        f"Wear and lives are intervals: equal parts wear {low} to {high} times as fast as the rate says. "
        "Give wear.repeats, the measured wear of equal parts."
    ]


def _scatter(case: WearingCase) -> tuple[float, float]:
    """Return the interval of the wear of equal parts over that at the rate [1]."""
    return case.wear_scatter().get("", (1.0, 1.0))


def _linear_life(
    wear: Wear, cycles: float, depth: FloatArray, of_outputs: Mapping[str, FloatArray]
) -> dict[str, object]:
    """Return after how many cycles the first limit is reached if the wear of this run goes on."""
    limit, deepest = wear.depth_limit, float(depth.max(initial=0.0))
    if not _has_cycle(cycles) or deepest == 0.0:
        return {}
    by_error = of_outputs.get("output_life", np.empty(0))
    by_depth = [] if limit is None else [limit * cycles / deepest]
    found = [*by_error[np.isfinite(by_error)].tolist(), *by_depth]
    return {"wear_life_cycles": min(found)} if found else {}


def _has_cycle(cycles: float) -> bool:
    """Return whether a run holds a whole cycle."""
    return cycles >= 1.0 - 1e-9


def _by_error(
    system: WearingSystem, run: FinishedRun, cycles: float, depth: FloatArray
) -> tuple[dict[str, FloatArray], list[str]]:
    """Return the lives by the errors of outputs at the wear of this run, and what is to be said of them.

    ``system``: what wears; ``cycles``: how many cycles that is; ``depth``: what it wore off at the nodes [m].
    """
    if not _has_cycle(cycles) or not depth.any():
        return {}, []
    found = system.output_lives(run, depth / cycles)
    known = {name: life for name, life in found.items() if math.isfinite(life)}
    if not known:
        return {}, []
    first = min(known, key=lambda name: known[name])
    reached = float(depth.max()) / cycles * known[first]
    share = reached / system.nodes.roughness
    small = "the contact hardly changes"
    words = small if share < 1.0 else "a wear campaign follows how the contact changes"
    note = (
        f"Life by the error of output {first} is a linear estimate from this run: by then the "
        f"largest depth is {1e6 * reached:.3g} um, {share:.2g} times the roughness; {words}."
    )
    return {"output_life": np.array(list(found.values()))}, [note]


def _stated_factor(case: WearingCase) -> dict[str, object]:
    """Return the longest over the shortest life of equal parts, one digit."""
    low, high = _scatter(case)
    return {"wear_life_factor": float(f"{high / low:.1g}")}


class _Cycles:
    """The cycles of a system as a campaign asks for them; keeps what the last one left."""

    last: FinishedRun

    def __init__(self, session: Session) -> None:
        self.session = session
        self.case = cast(WearingCase, session.case)
        self.system = cast(WearingSystem, session.system)

    @property
    def plan(self) -> CampaignPlan:
        """Campaign of the case."""
        wear, nodes = self.case.wear, self.system.nodes
        return CampaignPlan(
            cycles=wear.cycles,
            settling=self.case.settling_cycles,
            feedback=wear.feedback,
            depth_limit=math.inf if wear.depth_limit is None else wear.depth_limit,
            law=_archard(self.system, wear),
            control=JumpControl(wear.jump_limit, wear.jump_depth, nodes.roughness),
            node_area=nodes.area,
            of_cycle=tuple(self.session.mechanism.of_cycle),
            limits=self.case.wear_limits,
            changes=self._changes,
        )

    @property
    def _changes(self) -> tuple[int, ...]:
        """Cycles of wear with which rows of temperatures are reached."""
        rounded, begin = self.system.period * (1.0 + _ROUNDING), self.case.settling_cycles
        reached = {math.ceil(time / rounded) - begin for time in self.case.temperature_times}
        return tuple(sorted(cycles for cycles in reached if cycles > 0))

    def cycle(self, wear: FloatArray, carried: Carried | None, done: int) -> Cycle:
        """Simulate one cycle, see :class:`tribodyn.simulation.campaign.Cycles`."""
        cycles, period = self.case.wear.cycles, self.system.period
        self.system = system = self.system.beginning((self.case.settling_cycles + done) * period)
        self.session = session = replace(self.session, system=system)

        def within(t: float) -> None:
            if session.progress is not None:
                session.progress(min(max(done, 0) + t / period, float(cycles)))

        self.last = run = session.integrated(period, Worn(wear, carried), within)
        return Cycle(
            carried=system.carried(run),
            sliding_load=system.sliding_load(run.problem),
            motion=system.of_cycle(run) if run.solution.complete else {},
            statistics=run.solution.statistics,
            failure=run.solution.failure,
        )

    def contact_energy(self, wear: FloatArray, carried: Carried) -> float:
        """Return the energy stored in the contact [J]."""
        return float(self.system.contact_energy(Worn(wear, carried)))


def _not_reached(case: WearingCase, campaign: Campaign) -> list[str]:
    """Report the bushing's life if all went on as between the last two stops."""
    history, wear = campaign.history, case.wear
    if math.isfinite(campaign.life) or history["wear_cycles"].size < 2:
        return []
    limits = {
        **case.wear_limits,
        **({} if wear.depth_limit is None else {"wear_depth_max": wear.depth_limit}),
    }
    lives = {}
    for name, limit in limits.items():
        rate = np.diff(history[name])[-1] / np.diff(history["wear_cycles"])[-1]
        if rate > 0.0:
            lives[name] = (limit - history[name][-1]) / rate
    if not lives:
        return []
    first = min(lives, key=lambda name: lives[name])
    slow, fast = _scatter(case)
    return [
        f"The bushing was not worn out: at its last rate it would take {lives[first] / fast:.2g} to "
        f"{lives[first] / slow:.2g} more cycles to {wear.LIMIT_OF[first]}."
    ]
