"""Flanks of teeth and threads: with backlash they touch one after the other, each by the law of a stop."""

from typing import Self

from tribodyn.cases.fields import choice, number, quantity, switch
from tribodyn.mechanism.elements.element import ElementKeys, ForceLaw
from tribodyn.mechanism.elements.stop import LEAST_RATE, RESTITUTION, damping_of, one_sided


class Flanks(ElementKeys):
    """Base of the keys of elements whose flanks may have backlash."""

    backlash: float | None = quantity(None, "play of the flanks; none without it", "", ge=0, example="0.1 mm")
    damping_factor: str = choice(
        "calibrated",
        "how damping of flanks with backlash follows from restitution",
        "assumed",
        family="tribodyn.contact:DAMPING_FACTORS",
    )
    restitution: float = number(
        RESTITUTION, "coefficient of restitution of flanks with backlash", "manual, elements", gt=0, le=1
    )
    ideal: bool = switch(False, "treat the flanks as without backlash", "assumed")

    @property
    def has_play(self) -> bool:
        """Whether its flanks have backlash."""
        return self.backlash is not None and not self.ideal

    @property
    def without_play(self) -> Self:
        """The element without backlash."""
        return self.model_copy(update={"backlash": None})

    def flank_law(self, stiffness: float) -> ForceLaw:
        """Return the law of one flank of a stiffness [N/m], which touches after half the backlash."""
        return ForceLaw(
            one_sided,
            {
                "at": 0.5 * (self.backlash or 0.0),
                "side": 1.0,
                "exponent": 1.0,
                "scale": stiffness,
                "damping": damping_of(self.damping_factor, self.restitution),
                "least_rate": LEAST_RATE,
            },
        )
