"""Keys of a disc that falls."""

from typing import Literal

from tribodyn.cases.case import Case, Group
from tribodyn.cases.fields import choice, quantity, text
from tribodyn.cases.groups import Solver
from tribodyn.cases.keys import ASSUMED


class Disc(Group):
    """The disc and what it falls on."""

    mass: float = quantity("0.1 kg", "mass", ASSUMED, gt=0)
    height: float = quantity("20 um", "height at the start", ASSUMED, gt=0)
    stiffness: float = quantity("10 N/um", "stiffness of the floor", ASSUMED, gt=0)


class Run(Group):
    """How long."""

    duration: float = quantity("10 ms", "simulated time", ASSUMED, gt=0)


class DiscCase(Case):
    """A disc over an elastic floor."""

    case: Literal["disc"] = choice("disc", "the kind of system", "")
    title: str = text("Falling disc", "heading of figures and report")
    disc: Disc = Disc()
    solver: Solver = Solver(rtol=1e-6)
    run: Run = Run()

    @property
    def duration(self) -> float:
        """Simulated time [s]."""
        return self.run.duration
