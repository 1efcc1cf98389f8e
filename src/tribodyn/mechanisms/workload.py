"""Amount of work and memory of a run: counts from the keys of a case alone, before anything is built."""

from dataclasses import dataclass, field

from tribodyn.cases.joint_keys import Wear


@dataclass(frozen=True)
class Keys:
    """Keys that reduce a part of the workload, as a message names them."""

    #: Of the counts of :class:`Workload` with these names; ``length`` of the simulated time.
    nodes: str = "solver.grid.theta or solver.grid.z"
    cells: str = "film.grid.theta or film.grid.z"
    length: str = "run.duration"
    samples: str = "run.output_interval"
    followed: str = "run.step_rows"
    cycles: str = "wear.cycles"


@dataclass(frozen=True)
class Workload:
    """Counts of one run; floats, since a case may ask for more than an array could hold."""

    #: Accepted steps of one run, expected from its motion; see the mechanism's own ``workload.py``.
    steps: float
    states: float  #: Number of states.
    nodes: float  #: Nodes of all contact surfaces.
    joints: float  #: Joints with clearance.
    fields: float  #: Pressure fields kept.
    samples: float  #: Samples at output times.
    followed: float  #: Samples that follow the steps.
    quantities: float  #: Numbers of a sample.
    breaks: float = 0.0  #: Times at which the integration restarts.
    #: Cells of an oil film, and how many of them its solution couples at once; none without oil.
    cells: float = 0.0
    band: float = 0.0
    mapped: float = 0.0  #: Nodes of films in each field kept.
    runs: float = 1.0  #: How often the run is made: once, or for each simulated cycle of a wear campaign.
    solver: str = "mebdf"  #: Of the case: only this one runs in compiled code, with sparse matrices.
    keys: Keys = field(default_factory=Keys)  #: What to change.


def simulated_cycles(wear: Wear, settling: int, roughness: float, radius: float, rows: int) -> float:
    """Return the number of cycles that a wear campaign simulates.

    Depth per cycle is that of a typical pressure over a slip of one radius, so this is an order of magnitude.

    ``wear``: its table of the case; ``settling``: cycles before the first one whose wear counts;
    ``roughness``: combined rms roughness σ [m]; ``radius``: of the shaft [m]; ``rows``: of temperatures that
    follow time: a jump ends at each.
    """
    if not (wear.feedback or rows):
        return settling + 2.0
    rate = wear.specific_wear_rate + wear.partner_wear_rate
    depth = wear.cycles * rate * _PRESSURE * radius
    if wear.depth_limit is not None:
        depth = min(depth, wear.depth_limit)
    jumps = _FIRST_JUMPS + depth / (_SHARE_OF_JUMP * wear.jump_depth * roughness)
    return settling + 1.0 + min(float(wear.cycles), jumps + rows)


#: Mean contact pressure over a slip of one radius per cycle [Pa], from wear campaigns of two mechanisms.
_PRESSURE = 5.0e5
_SHARE_OF_JUMP = 0.4  #: Mean gain of a jump over ``wear.jump_depth``, from the same.
_FIRST_JUMPS = 20.0  #: Jumps until their length has grown to that.
