"""Teeth and threads: backlash, losses, and flanks that touch one after the other.

With backlash j the sum of the legs is no constraint but the path of the teeth along their pitch lines, zero
in the middle of the gap. Beyond ±j/2 a flank is in contact, by the law of a limit stop.

Losses follow the tooth force, also that of a flank: a torque κ |λ| r against the motion of the first wheel,
with 1 + κ = 1/η where it drives and 1 − κ = η where it is driven.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import Self

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.cases.case import demand
from tribodyn.cases.fields import choice, number, quantity, switch
from tribodyn.kernels import dense
from tribodyn.mechanism.elements import element as base
from tribodyn.mechanism.elements.element import ElementKeys, ForceLaw
from tribodyn.mechanism.elements.joint_friction import friction_law
from tribodyn.mechanism.elements.stop import LEAST_RATE, RESTITUTION, damping_of, one_sided


class Flanks(ElementKeys):
    """Base of the keys of elements whose flanks may have backlash."""

    backlash: float | None = quantity(None, "play of the flanks; none without it", ge=0, example="0.1 mm")
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


#: Forces that push both wheels apart, over the tooth force, shape (3,) each.
Pushes = tuple[FloatArray, FloatArray]


class Teeth(Flanks):
    """Base of the keys of elements with teeth, whose first leg is that of the wheel which drives forward."""

    backlash: float | None = quantity(
        None, "play j of the teeth along the pitch circles; none without it", ge=0, example="0.1 mm"
    )
    mesh_stiffness: float | None = quantity(
        None, "tooth force over indentation, of teeth with backlash", gt=0, example="100 N/um"
    )
    efficiency: float | None = number(
        None,
        "power out over power in where the first wheel drives; without it no loss",
        gt=0,
        lt=1,
        example="0.95",
    )
    backward_efficiency: float | None = number(
        None,
        "likewise where the first wheel is driven, below 0 of what locks itself; 2 - 1/efficiency without it",
        ge=-10,
        le=1,
        example="0.9",
    )
    slip_velocity: float = quantity("1 mm/s", "speed at which friction is developed, u_s", "assumed", gt=0)

    @property
    def without_friction(self) -> Self:
        """The teeth without losses."""
        return self.model_copy(update={"efficiency": None})

    def losses(self) -> tuple[float, float]:
        """Return torque against the first wheel over that of the teeth, where it drives and is driven."""
        if self.efficiency is None:
            demand(self.backward_efficiency is None, "backward_efficiency", "give both efficiencies")
            return 0.0, 0.0
        lost = 1.0 / self.efficiency - 1.0
        return lost, lost if self.backward_efficiency is None else 1.0 - self.backward_efficiency

    def meshing(self, legs: tuple[base.Leg, ...], pushes: Pushes | None) -> Iterator[base.Equation]:
        """Yield the constraint, or the contact of each flank; then the friction that follows each of them."""
        if self.has_play:
            demand(
                self.mesh_stiffness is not None, "mesh_stiffness", "teeth with backlash need their stiffness"
            )
            law = self.flank_law(self.mesh_stiffness or 0.0)
            flanks = [_flank(legs, side, pushes) for side in (1.0, -1.0)]
            yield from (base.Equation(flank, law) for flank in flanks)
        else:
            # Its force pushes the wheels apart as well.
            both = zip(legs, pushes or [None] * len(legs), strict=True)
            flanks = [tuple(replace(wheel, push=push) for wheel, push in both)]
            yield base.Equation(flanks[0], None)
        forward, backward = self.losses()
        for k, flank in enumerate(flanks if forward > 0.0 else ()):
            slant = dense.norm(legs[0].along) / dense.norm(flank[0].along) if np.any(legs[0].along) else 1.0
            share = backward / forward
            law = friction_law(forward * slant, self.slip_velocity, load_leg=k * len(legs), backward=share)
            turning = replace(flank[0], along=np.zeros(3), push=None, reported=flank[0].along)
            yield base.Equation((turning,), law)


def pushing(legs: tuple[base.Leg, ...], angle: float) -> Pushes:
    """Return the forces that push both wheels apart by a pressure angle [rad]."""
    towards = [np.cross(wheel.along, [0.0, 0.0, wheel.about]) for wheel in legs]
    apart = min(towards, key=lambda arm: float(dense.norm(arm)))
    apart = apart / dense.norm(apart) * (1.0 if apart is towards[0] else -1.0)
    return -portable.tan(angle) * apart, portable.tan(angle) * apart


def _flank(legs: tuple[base.Leg, ...], side: float, pushes: Pushes | None) -> tuple[base.Leg, ...]:
    """Return the legs of one flank: its contact, with λ below zero, pushes the wheels apart as well."""
    return tuple(
        replace(wheel, along=side * wheel.along - push, about=side * wheel.about, reported=wheel.along)
        for wheel, push in zip(legs, pushes or (np.zeros(3),) * len(legs), strict=True)
    )
