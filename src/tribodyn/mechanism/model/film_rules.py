"""Requirements on a joint with an oil film."""

from __future__ import annotations

from typing import Any

from tribodyn.cases.case import demand
from tribodyn.cases.joint import FormKeys
from tribodyn.mechanism.shapes import SHAPES


def check_film(joint: Any) -> None:
    """Refuse an oil film that the kernels of the film do not describe; the keys are those of its joint.

    Raises
    ------
    InputError
        If the joint is not a pin that turns in a round bore.
    """
    key, clearance = "film.viscosity", joint.clearance
    words = "an oil film is in the bore of a pin: a clearance with radius, radial and length is needed"
    demand(clearance is not None and SHAPES[joint.shape].BORE, key, words)
    words = f"an oil film is that of a revolute joint; in a {joint.type} one oil would also resist sliding"
    demand("position" not in joint.kind.COORDINATES, key, words)
    words = "an oil film is as long as its bore: leave pin_length out"
    demand(clearance.pin_length is None, "clearance.pin_length", words)
    words = "an oil film is between round surfaces: leave form or film out"
    demand(clearance.form == FormKeys(), "clearance.form", words)
    words = "an oil film has one viscosity and one clearance: give constant temperatures"
    demand(not clearance.temperature.tables, "clearance.temperature.over_time", words)
