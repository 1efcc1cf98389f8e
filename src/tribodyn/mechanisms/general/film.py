"""What a joint with an oil film must be."""

from __future__ import annotations

from tribodyn.cases.case import demand
from tribodyn.cases.joint import FormKeys
from tribodyn.mechanisms.general.joints import JOINTS
from tribodyn.mechanisms.general.shapes import SHAPES


def check_film(kind: str, shape: str, pin_length: float | None, form: FormKeys) -> None:
    """Refuse an oil film that the kernels of the film do not describe.

    Parameters
    ----------
    kind, shape
        Type of the joint and shape of its clearance; an empty text where it has none.
    pin_length, form
        Keys of its clearance.

    Raises
    ------
    InputError
        If the joint is not a pin that turns in a round bore.
    """
    key = "film.viscosity"
    words = "an oil film is in the bore of a pin: a clearance with radius, radial and length is needed"
    demand(shape in SHAPES and SHAPES[shape].BORE, key, words)
    words = f"an oil film is that of a revolute joint; in a {kind} one oil would also resist sliding"
    demand("position" not in JOINTS[kind].COORDINATES, key, words)
    words = "an oil film is as long as its bore: leave pin_length out"
    demand(pin_length is None, "clearance.pin_length", words)
    words = "an oil film is between round surfaces: leave form or film out"
    demand(form == FormKeys(), "clearance.form", words)
