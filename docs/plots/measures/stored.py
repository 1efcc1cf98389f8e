"""Numbers inside sentences that ``make bench`` has stored."""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path
from typing import Any, Final

from measures.base import Numbers
from tribodyn.papers.cheng_2022.runs import Runs

SOURCE: Final = Path(__file__).parents[2] / "_static" / "benchmarks.json"
FOUND: Final[dict[str, Any]] = json.loads(SOURCE.read_text(encoding="utf-8"))
_KINKS: Final = FOUND["kinks"]


def saved(runs: Runs, variant: str, what: str) -> str:
    """Return how many of the steps a variant of the mechanism saves [%]."""
    before, after = (_KINKS[name][what] for name in ("as it is", variant))
    return f"{100.0 * (1.0 - after / before):.0f}"


def shorter(runs: Runs, when: str) -> str:
    """Return the share of steps that are shorter than the one before [%]."""
    return f"{_KINKS['as it is'][when]:.0f}"


def exudyn(runs: Runs, end: int) -> str:
    """Return the least or largest time of Exudyn over ours at equal errors."""
    ratios = sorted(float(at["ratio"]) for at in FOUND["mechanism"]["ratios"])
    return f"{ratios[end]:.2g}"


def exudyn_angle(runs: Runs) -> str:
    """Return the difference of the vane angle to Exudyn with our surface contact [deg]."""
    peers = FOUND["vsv"]["peers"]
    return f"{min(one['angle'] for one in peers if one['name'] == 'Exudyn, surface contact'):.0e}"


#: Numbers by name.
NUMBERS: Final[Numbers] = {
    "steps saved without cut-off [%]": partial(saved, variant="no clip", what="steps"),
    "steps saved without collar [%]": partial(saved, variant="no moment of the collar", what="steps"),
    "steps saved with wide traction [%]": partial(
        saved, variant="traction developed at 100 times the slip", what="steps"
    ),
    "later steps saved with wide switch [%]": partial(
        saved, variant="air force switched over 10 times the angle", what="later"
    ),
    "steps shorter after a change of contact [%]": partial(shorter, when="shorter after them"),
    "steps shorter after others [%]": partial(shorter, when="after others"),
    "Exudyn over ours, least": partial(exudyn, end=0),
    "Exudyn over ours, most": partial(exudyn, end=-1),
    "Exudyn, surface contact, angle [deg]": exudyn_angle,
}
