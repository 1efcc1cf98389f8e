"""What results hold of the outputs of a mechanism."""

from __future__ import annotations

from collections.abc import Sequence

from tribodyn.core.arrays import FloatArray
from tribodyn.mechanisms.general.actions import GIVEN
from tribodyn.mechanisms.general.assembly import Assembly
from tribodyn.mechanisms.general.case import MechanismCase
from tribodyn.mechanisms.general.ideal_motion import compared
from tribodyn.mechanisms.general.kinematics import velocity_ratios
from tribodyn.mechanisms.general.outputs import Motion, Output
from tribodyn.mechanisms.general.positions import DrivePath


def output_columns(
    assembly: Assembly, outputs: Sequence[Output], path: DrivePath, motion: Motion, analysis: str
) -> tuple[dict[str, FloatArray], tuple[str, ...]]:
    """Return outputs with their ideal values and errors, of a kinematic analysis their ratios, and notes."""
    columns, notes = compared(assembly, outputs, path, motion)
    if analysis == "kinematic":
        columns["output_ratio"] = velocity_ratios(assembly, outputs, path.times)
    return columns, notes


def output_coordinates(case: MechanismCase, outputs: Sequence[Output]) -> dict[str, list[str]]:
    """Return the names of outputs with their units, of a kinematic analysis those of its drives."""
    if not outputs:
        return {}
    drives = [name for name, keys in case.drives.items() if GIVEN[keys.gives][1] < 2]
    return {
        "output": [output.name for output in outputs],
        "output_unit": [output.unit for output in outputs],
        **({"drive": drives} if case.run.analysis == "kinematic" else {}),
    }
