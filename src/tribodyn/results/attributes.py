"""The attribute table: what a result says about itself beside its variables, and in which form.

One line an attribute that this program reads again. What is not listed is a fact for readers: a text or a
number. Names that end in ``_version`` hold texts.
"""

from typing import Final

TEXT: Final = "text"
SIZE: Final = "finite number above zero"
NUMBER: Final = "finite number"
GAPS: Final = "finite number, or none (NaN)"
OUTCOME: Final = "number"
"""A number that may be missing (NaN) or beyond all bounds (infinite)."""
TEXTS: Final = "list of texts, as JSON"
FACTS: Final = "table of numbers and texts, as JSON"

CARRIED: Final = "carried on"
"""The ``start`` of a run that continues from where another one ended."""
SWEEP: Final = "sweep"
"""The ``kind`` of a sweep; that of a run is the kind of its case."""

DATA_HASH: Final = "data_sha256"
"""SHA-256 of all that a run was computed from."""
ROWS_HASH: Final = "rows_sha256"
"""SHA-256 of its rows."""
ASSUMED_WEAR: Final = "assumed_wear"
"""Joints, as in names of numbers, whose wear rate nobody chose; an empty name for all."""
MODEL: Final = "model"
"""The model file of the mechanism that a case of another kind stands for."""
NOT_KEPT: Final = "not_kept"
"""Names of variables that the case did not ask for."""

ATTRIBUTES: Final[dict[str, str]] = {
    **dict.fromkeys(("kind", "title", "case", "failure", "formulation", "contact_law", "start", MODEL), TEXT),
    **dict.fromkeys(("clearance", "assembly_clearance", "joint_length", "cycle_period", "impact_time"), SIZE),
    **dict.fromkeys(("roughness", "friction_coefficient"), NUMBER),
    **dict.fromkeys(("energy_residual", "clearance_energy_residual", "grid_force_error"), OUTCOME),
    **dict.fromkeys(("separation_least", "collar_lift_off_time", "tensile_clip_time"), OUTCOME),
    "time_reached": OUTCOME,
    "wear_depth_limit": SIZE,
    **dict.fromkeys(("worn_volume", "wear_life_cycles", "wear_life_factor", "wear_cycles_reached"), OUTCOME),
    **dict.fromkeys(("points_in_all", "points_failed", "samples", "sampling_seed"), NUMBER),
    **dict.fromkeys(("sampling_method", DATA_HASH, ROWS_HASH), TEXT),
    "solver": FACTS,
    "warnings": TEXTS,
    "notes": TEXTS,
    "varied": TEXTS,
    ASSUMED_WEAR: TEXTS,
    NOT_KEPT: TEXTS,
}
"""Attributes of a dataset by name."""

VARIABLE_ATTRIBUTES: Final[dict[str, str]] = {
    **dict.fromkeys(("units", "long_name", "comment", "group", "shown_unit"), TEXT),
    "shown_scale": SIZE,
}
"""Attributes of a variable by name."""
