"""Files of a new set of a user's own measurements, to be filled in."""

from pathlib import Path
from typing import Final

from tribodyn.core.errors import InputError

README: Final = "README.md"
NUMBERS: Final = "numbers.csv"
TEMPLATE: Final = {
    README: """# Title: quantity, machine, conditions

**Measured.** What was measured, over which range, how often.

**Apparatus.** Machine, dimensions, materials, lubricant, sensors, temperature. What is not known.

**Uncertainty.** Half widths of 95 % intervals: of the reading, from run to run, from unit to unit.

**Source and licence.** Who measured it, when, where it is recorded, who may use it.

**Inputs.** Which keys of the case are known, and which are assumed, with their ranges (given with --assume).

**Known problems.** What may be wrong with the data.

**Use.** Which numbers are judged, with which band and why. Write the bands before the first run.
Never widen them.
""",
    NUMBERS: """quantity,measured,half_width,accepted,null,source,explanation
force_mean_N_wrist,1460,20,10 %,,example: mean force of the case slider-crank,
drive_power_mean_W,226,5,,,example without a band: reported only,
""",
}
"""Files of a new set, by name."""


def write_template(folder: Path) -> None:
    """Write README and table of a new set into a folder; files that are there already are kept.

    Raises
    ------
    InputError
        One of them is there already.
    """
    there = [name for name in TEMPLATE if (folder / name).exists()]
    if there:
        raise InputError(f"{folder} already has {', '.join(there)}; choose another folder", key="--template")
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in TEMPLATE.items():
        (folder / name).write_text(text, encoding="utf-8")
