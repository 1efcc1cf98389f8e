"""Keys of a run of a mechanism, of its integration and of the nodes of its joints."""

from typing import Final, Literal

from tribodyn.cases.case import Group, demand_known
from tribodyn.cases.fields import choice, count, names, number, quantity
from tribodyn.cases.groups import GridKeys
from tribodyn.cases.keys import ASSUMED
from tribodyn.mechanisms.workload import EVEN

ROWS: Final = 500  #: Rows of a result for which no interval was given.
SMALL: Final = 32  #: Joints of a model up to which results hold everything.
FEW_FRAMES: Final = 30  #: Pressure fields of a cycle of a larger model.


class RunKeys(Group):
    """Analysis, duration and outputs."""

    analysis: Literal["dynamic", "static", "kinematic", "vibrations"] = choice(
        "dynamic",
        "dynamic: motion over time; static: equilibrium in the clearances at positions along the drives; "
        "kinematic: ideal joints along the drives, forces by inverse dynamics; vibrations: natural "
        "frequencies and modes about positions at rest along the drives",
        ASSUMED,
    )
    directions: Literal["forward", "both"] = choice(
        "forward", "whether positions of a static analysis are passed backward, too", ASSUMED
    )
    cycles: float | None = number(
        None, "cycles to simulate; give this or duration", ASSUMED, gt=0, le=1e6, example="2"
    )
    duration: float | None = quantity(
        None, "simulated time; give this or cycles", ASSUMED, gt=0, example="0.5 s"
    )
    period: float | None = quantity(
        None, "time of one cycle; that of the first drive that has one without it", gt=0, example="12 ms"
    )
    start: Literal["equilibrium", "centred"] = choice(
        "equilibrium", "where shafts are in their sockets at the start", "manual, any mechanism"
    )
    output_interval: float | None = quantity(
        None,
        f"time between rows of the result; a {ROWS}th of the run or cycle without it",
        gt=0,
        example="0.1 ms",
    )
    positions: int = count(
        120,
        "positions of a static or vibration analysis in a cycle; of a kinematic one where it is given",
        ASSUMED,
        ge=2,
        le=1_000_000,
    )
    modes: int = count(
        12,
        "modes of a vibration analysis that are kept, those of the lowest frequency",
        ASSUMED,
        ge=1,
        le=1000,
    )
    step_rows: int = count(
        2000,
        "rows of each cycle that follow the steps, at most: those with the peaks; none with 0",
        ASSUMED,
        ge=0,
        le=1_000_000,
    )


class ResultKeys(Group):
    """Content of a run's result."""

    quantities: tuple[str, ...] | None = names(
        "quantities of bodies and joints that the result holds over time; of up to "
        f"{SMALL} joints all, of more those of key results, figures and report",
        length=0,
        example='["position", "orientation", "reaction_force"]',
        required=False,
    )
    frames: int | None = count(
        None,
        f"pressure fields of a cycle; {EVEN} for up to {SMALL} joints, {FEW_FRAMES} for more",
        ge=2,
        le=10_000,
        example=str(EVEN),
    )

    def check(self) -> None:
        """Refuse names that are not those of quantities."""
        if self.quantities is None:
            return
        from tribodyn.mechanism.mechanism_variables import BODIES, JOINTS

        for name in self.quantities:
            demand_known(name, (*BODIES, *JOINTS), "results.quantities", "quantity")


class Integration(Group):
    """The time integration; absolute tolerances follow from clearances and sizes."""

    name: str = choice("mebdf", "integrator", ASSUMED, family="tribodyn.integrate:SOLVERS")
    rtol: float = number(1e-5, "relative tolerance", ASSUMED, ge=1e-12, le=0.1)
    grid: GridKeys = GridKeys()
