"""The built-in journals, as several tests take them."""

import re
from collections.abc import Mapping
from typing import Any

import tribodyn as td
from tribodyn.mechanisms.catalogue import parse_case, template

BORE = "joints.bearing.clearance"  #: Table of the size and the friction of a journal's bearing.


def journal(name: str, changes: Mapping[str, object] | None = None, *, tilts: bool = False) -> Any:
    """Return a built-in journal with some keys changed; it tilts without the joint that holds it level."""
    case = td.load_case(name)
    if tilts:
        case = parse_case(re.sub(r"\[joints\.plane\]\n(?:.+\n)+", "", template(name)), name)
    return case.replace(changes or {})


def loads(force: tuple[float, float], moment: tuple[float, ...] = ()) -> dict[str, object]:
    """Return the keys of forces along X and Y [N], and of right-handed moments about them [N m]."""
    forces = {f"loads.{axis}.force": f"{size!r} N" for axis, size in zip("xy", force, strict=True)}
    moments = zip("xy", moment, strict=False)
    return {**forces, **{f"loads.x.moment_{axis}": f"{size!r} N m" for axis, size in moments}}
