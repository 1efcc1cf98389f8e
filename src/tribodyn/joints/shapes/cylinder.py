"""A shaft in a bore, with or without faces at its ends: trunnions, pins, bearings of cranks and rods.

The barrel has nodes as those of the bushing, weighed by the area of the bore. They belong to the shorter
part: to the bore through which a shaft slides, or to a pin that moves along a longer bore, such as a
piston. The shaft's flanges stand outside the ends of the bore and rest on them.
"""

import math
from dataclasses import dataclass, field, replace

import numpy as np

from tribodyn.core.errors import InputError
from tribodyn.joints.rows import Form
from tribodyn.joints.shapes.rings import Annulus, Rings, with_edges
from tribodyn.joints.shapes.surface import Points, Surface, check_positive
from tribodyn.kernels.joints.surface.bulk import RING
from tribodyn.kernels.joints.surface.tilt import AXIS

ENDS = {"upper": 1.0, "lower": -1.0}
FEWEST_ACROSS = 4  #: Rows of a face, however narrow it is, unless the barrel has fewer.


def rows_of_face(n_z: int, width: float, length: float) -> int:
    """Return the number of rows that resolve an end face of a width as ``n_z`` do a barrel of a length [m].

    The shaft tilts no further than the barrel lets it. So the gap changes across a face and along the barrel
    as their widths do, and the numbers of rows that resolve it go with the roots of these, see
    ``joints/rows.py``.

    Examples
    --------
    >>> rows_of_face(16, 6e-3, 20e-3)
    9
    """
    return min(max(math.ceil(n_z * math.sqrt(width / length)), FEWEST_ACROSS), n_z)


@dataclass(frozen=True)
class Cylinder:
    """Sizes of a shaft in a bore [m]."""

    radius: float  #: Of the shaft.
    clearance: float  #: Radial clearance c.
    length: float  #: Of the bore.
    pin_length: float | None = None  #: Of the shaft; None if it is longer than the bore.
    axial: float | None = None  #: Gap at both end faces as drawn; none without faces.
    #: The same at one end each, along the axis and against it.
    axial_upper: float | None = None
    axial_lower: float | None = None
    flange: float | None = None  #: Outer radius of the end faces; the bore is their inner one.
    form: Form = field(default_factory=Form)  #: What shaft and bore stand back from cylinders.

    def __post_init__(self) -> None:
        """Refuse sizes that make no joint."""
        check_positive("cylinder", radius=self.radius, radial=self.clearance, length=self.length)
        if self.pin_length is not None:
            check_positive("cylinder", pin_length=self.pin_length)
        if self.faces and self._pin_is_shorter:
            raise InputError(
                f"must be at least the length, {self.length:g} m, with end faces, not {self.pin_length:g} m",
                key="pin_length",
            )
        if bool(self.faces) != (self.flange is not None):
            raise InputError(
                "end faces need both their gap, axial, and their outer radius, flange", key="flange"
            )

    @property
    def bore_radius(self) -> float:
        """Radius of the bore [m]."""
        return self.radius + self.clearance

    @property
    def faces(self) -> dict[str, float]:
        """Gaps of the end faces it has [m]: ``upper``, ``lower``."""
        gaps = {"upper": self.axial_upper, "lower": self.axial_lower}
        gaps = {end: self.axial if gap is None else gap for end, gap in gaps.items()}
        return {end: gap for end, gap in gaps.items() if gap is not None}

    @property
    def _pin_is_shorter(self) -> bool:
        return self.pin_length is not None and self.pin_length < self.length

    @property
    def overlap(self) -> float:
        """Length along which shaft and bore can touch [m]."""
        return self.length if self.pin_length is None else min(self.length, self.pin_length)

    def surfaces(self, grid: tuple[int, int]) -> tuple[Surface, ...]:
        """Return the barrel and the faces."""
        n_theta, n_z = grid
        length, lean = self.overlap, -self.radius if self._pin_is_shorter else self.radius
        half = 0.5 * length
        z, weight = with_edges(-half, half, *self.form.quadrature(n_z, length))
        ones = np.ones(z.size)
        rings = Rings(self.radius * ones, z, ones, 0.0 * ones, (self.radius + self.clearance) * weight)
        barrel = rings.surface("barrel", ("z", z), self.clearance + self.form.gap(z, length), n_theta, AXIS)
        measured = self.form.measured(barrel.axes["theta"], z).ravel()
        barrel = replace(
            barrel,
            gap=barrel.gap + measured,
            slides=lean > 0.0,
            lean=lean,
            extent=RING,
            size=self.bore_radius,
        )
        return (
            barrel,
            *(
                replace(
                    self._face(end, gap).surface(f"{end} face", (n_theta, self._rows_across(n_z))),
                    opens=(0.0, self._share(gap)),
                )
                for end, gap in self.faces.items()
            ),
        )

    def _share(self, gap: float) -> float:
        """Return the share of a face in a change of the play; none of one alone, which the shaft rests on."""
        return gap / sum(self.faces.values()) if len(self.faces) == 2 else 0.0

    def _rows_across(self, n_z: int) -> int:
        assert self.flange is not None
        return rows_of_face(n_z, self.flange - self.radius - self.clearance, self.length)

    def _face(self, end: str, gap: float) -> Annulus:
        assert self.flange is not None
        return Annulus(
            inner=self.radius + self.clearance,
            outer=self.flange,
            clearance=gap,
            height=0.5 * ENDS[end] * self.length,
            direction=-ENDS[end],
        )

    def points(self) -> Points:
        """Return a circle at each end."""
        if self.faces:
            raise InputError(
                "end faces touch over their surface, not at points; leave axial out", key="axial"
            )
        half = 0.5 * self.overlap
        return Points(self.radius, self.clearance, self.overlap, (-half, half))
