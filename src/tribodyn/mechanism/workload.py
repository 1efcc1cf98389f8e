"""Amount of work and memory of a run of a user-defined mechanism."""

import math
from collections.abc import Iterator
from typing import Final

import numpy as np

from tribodyn.integrate.following import most_rows
from tribodyn.joints.shapes.rings import EDGES
from tribodyn.kernels.mechanism.data import N_STATES
from tribodyn.mechanism.assembly.clearance_surfaces import grid_of
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.model.parts import ClearanceKeys, JointKeys
from tribodyn.mechanism.results.kept_variables import frames, layout_of
from tribodyn.mechanism.shapes import SHAPES
from tribodyn.mechanisms.workload import Keys, Workload, simulated_cycles

_STEPS: Final = (300.0, 500.0, 1500.0)
"""Steps at the start, in a cycle of ideal joints, and more with the fourth root of the number of real ones.

Measured with built-in cases, rings of 5 to 80 vanes and chains of 10 and 30 bodies at ``rtol`` 1e-5.
"""
_OF_TURN: Final = 60.0  #: Steps in a turn of a shaft alone, measured with ``journal-oil`` at 300 rad/s.
_TOLERANCE_POWER: Final = -0.1


def workload(case: MechanismCase) -> Workload:
    """Return the counts of a case."""
    real = [*case.real.values()]
    oiled = {name: joint for name, joint in case.joints.items() if name in case.oiled}
    films = [joint.film for joint in oiled.values() if joint.film is not None]
    once = case.period if case.campaign_cycles else None
    duration = case.duration if once is None else once
    if real and _is_alone(case):
        steps = _STEPS[0] + (duration / case.period * _OF_TURN if case.period else 0.0)
    else:
        steps = _STEPS[0] + duration / _typical_time(case) * (_STEPS[1] + _STEPS[2] * len(real) ** 0.25)
    steps *= (case.solver.rtol / 1.0e-5) ** _TOLERANCE_POWER
    windows = max(1.0, duration / (case.period or duration))
    watched = len(case.joints) + len(real) + len(films) + 2 * len(case.drives)
    layout = layout_of(case)
    quantities = layout.size
    rows = most_rows(case.run.step_rows, quantities, watched) if case.run.step_rows else 0
    return Workload(
        steps=steps,
        states=float(N_STATES * layout.n_bodies),
        nodes=sum(map(float, _nodes(case))),
        joints=float(len(real)),
        cells=sum(float(film.grid.theta * film.grid.z) for film in films),
        band=max((_band(case, joint) for joint in oiled.values()), default=0.0),
        mapped=sum(float(film.grid.theta * (film.grid.z + 1)) for film in films),
        fields=(frames(case) + 1.0) * min(2.0, windows) if real else 0.0,
        samples=duration / case.output_interval,
        followed=min(rows * windows, steps) if real else 0.0,
        quantities=float(quantities),
        runs=_runs(case, real),
        solver=case.solver.name,
        keys=_keys(case, real),
    )


def _is_alone(case: MechanismCase) -> bool:
    """Return whether a single body comes to rest or turns steadily: no cycle repeats what it does."""
    signals = [signal for load in case.loads.values() for signal in load.given.values()]
    steady = not any(signal.axes or signal.period for signal in signals)
    return steady and len(case.bodies) == 1 and not any(case.gravity) and not case.springs


def _band(case: MechanismCase, joint: JointKeys) -> float:
    """Return the band of the film of a joint; that of a shaft held level is solved on half its length."""
    assert joint.film is not None
    level = any(
        set(one.between) == set(joint.between) and one.type == "planar" for one in case.joints.values()
    )
    return (0.5 if level else 1.0) * joint.film.grid.z + 1.0


def _keys(case: MechanismCase, real: list[ClearanceKeys]) -> Keys:
    own = any(clearance.nodes_around or clearance.nodes_along for clearance in real)
    nodes = "joints.NAME.clearance.nodes_around or nodes_along" if own else Keys().nodes
    return Keys(nodes=nodes, length="run.duration" if case.run.duration is not None else "run.cycles")


def _nodes(case: MechanismCase) -> Iterator[float]:
    """Yield the nodes of every surface; those of a mesh are its triangles."""
    for name, joint in case.joints.items():
        clearance = joint.real
        if clearance is None:
            continue
        around, along = grid_of(case, name, clearance)
        yield SHAPES[joint.shape].nodes(clearance, around, along + EDGES)


def _typical_time(case: MechanismCase) -> float:
    """Return the shortest of its cycle, of turns at the start and of a pendulum of its size [s]."""
    times = [case.duration if case.period is None else case.period]
    speeds = [abs(joint.start_speed) for joint in case.joints.values() if joint.start_speed]
    times += [2.0 * math.pi / speed for speed in speeds]
    gravity = math.hypot(*case.gravity)
    if gravity > 0.0 and case.period is None:
        centres = np.array([body.centre for body in case.bodies.values()])
        size = max(float(np.ptp(centres, axis=0).max()), 1.0e-3)
        times = [*times[1:], 2.0 * math.pi * math.sqrt(size / gravity)]
    return min(times)


def _runs(case: MechanismCase, real: list[ClearanceKeys]) -> float:
    if not case.campaign_cycles:
        return 1.0
    roughness = min(case.of_pair(clearance).surface_pair.roughness_rms for clearance in real)
    radius = max((clearance.radius or 0.0 for clearance in real), default=0.0)
    rows = len(case.temperature_times)
    return simulated_cycles(case.wear, case.settling_cycles, roughness, radius, rows)


WORKLOAD: Final = workload
