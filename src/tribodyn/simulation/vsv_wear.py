"""Wear campaigns of the variable stator vane mechanism."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import xarray as xr

from tribodyn.cases.vsv import Vsv as VsvCase
from tribodyn.core.arrays import FloatArray
from tribodyn.core.problem import Problem, Solution
from tribodyn.joints.bushing import contact_energy
from tribodyn.kernels.vsv.quantities import OBSERVED
from tribodyn.mechanisms.vsv import Carried
from tribodyn.simulation import checkpoint as checkpoints
from tribodyn.simulation.campaign import Cycle, Plan, Worn, run_campaign
from tribodyn.simulation.history import of_motion
from tribodyn.simulation.vsv import Gathered, More, archard, integrated, mechanism
from tribodyn.wear import JumpControl


def simulate_vsv_wear(
    case: VsvCase,
    *,
    progress: Callable[[float], None] | None = None,
    stop: Callable[[], bool] | None = None,
    checkpoint: Path | None = None,
) -> xr.Dataset:
    """Run the wear campaign of a ``vsv`` case, see :func:`tribodyn.simulation.simulate`."""
    text = case.to_toml()
    vane = _WearingVane(case, progress, stop)
    found = None if checkpoint is None else checkpoints.read(checkpoint, text, vane.plan.field_shape)
    resumed, told = (None, []) if found is None else found

    def keep(worn: Worn) -> None:
        if checkpoint is not None:
            checkpoints.write(checkpoint, worn, text)

    worn, _ = run_campaign(vane, vane.plan, resumed, keep)
    gathered = Gathered(case, vane.vsv, vane.problem, vane.solution, worn.depth, worn.statistics)
    return gathered.dataset(_more(case, worn, told))


class _WearingVane:
    """The mechanism as a campaign asks for it; keeps what the last cycle left."""

    problem: Problem
    solution: Solution

    def __init__(
        self, case: VsvCase, progress: Callable[[float], None] | None, stop: Callable[[], bool] | None
    ) -> None:
        self.case = case
        self.vsv = mechanism(case)
        self.progress = progress
        self.stop = stop

    @property
    def plan(self) -> Plan:
        """What the case asks for."""
        wear, joint = self.case.wear, self.vsv.joint
        assert self.case.run.cycles is not None
        return Plan(
            cycles=wear.cycles,
            settling=int(self.case.run.cycles) - 1,
            feedback=wear.feedback,
            depth_limit=math.inf if wear.depth_limit is None else wear.depth_limit,
            law=archard(self.case),
            control=JumpControl(wear.jump_limit, wear.jump_depth, joint.roughness),
            node_area=joint.node_area,
            field_shape=joint.field_shape,
        )

    def cycle(self, wear: FloatArray, carried: Carried | None, done: int) -> Cycle:
        """Simulate one cycle, see :class:`tribodyn.simulation.campaign.Mechanism`."""

        def within(t: float) -> None:
            if self.progress is not None:
                self.progress(min(done + t / self.case.period, float(self.case.wear.cycles)))

        self.problem, self.solution = integrated(
            self.case, self.vsv, self.case.period, wear=wear, carried=carried, progress=within, stop=self.stop
        )
        memory, solution = self.problem.memory, self.solution
        rows = {name: solution.rows[:, i] for i, name in enumerate(OBSERVED)}
        return Cycle(
            carried=Carried(solution.y_end, memory.joint.entry_velocity),
            sliding_load=memory.joint.sliding_load,
            motion=of_motion(solution.t, rows, memory.joint.peaks) if solution.complete else {},
            statistics=solution.statistics,
            failure=solution.failure,
        )

    def contact_energy(self, wear: FloatArray, carried: Carried) -> float:
        """Return the energy stored in the contact [J]."""
        data = self.vsv.joint.data(wear)
        return contact_energy(data, carried.state, carried.entry_velocity)


def _more(case: VsvCase, worn: Worn, told: list[str]) -> More:
    """Return what a campaign adds to the result of its last cycle."""
    n_jumps = worn.history["wear_cycles"].size
    attributes: dict[str, object] = {"wear_cycles_reached": worn.cycles}
    if math.isfinite(worn.life):
        attributes["wear_life_cycles"] = worn.life
    return More(
        coordinates={"jump": np.arange(n_jumps, dtype=np.float64), "stage_cycles": worn.stage_cycles},
        fields={**worn.history, "stage_depth": worn.stage_depth.transpose(0, 2, 1)},
        attributes=attributes,
        warnings=[*told, *_limit_not_reached(case, worn)],
    )


def _limit_not_reached(case: VsvCase, worn: Worn) -> list[str]:
    """Say how long the bushing would last if the last rate went on."""
    limit, rates = case.wear.depth_limit, worn.history["wear_rate"]
    if limit is None or math.isfinite(worn.life) or rates.size == 0 or rates[-1] == 0.0:
        return []
    left = (limit - float(worn.depth.max())) / float(rates[-1])
    return [
        f"The bushing was not worn out: at its last rate it would take {left:.2g} more cycles to "
        "wear.depth_limit."
    ]
