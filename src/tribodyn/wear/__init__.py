"""Wear: from sliding loads to depth and volume, and how far one simulated cycle may be extrapolated."""

from tribodyn.wear.archard import (
    Archard,
    JumpControl,
    between_edges,
    load_change,
    loaded_depth,
    resampled,
    worn_roughness,
    worn_volume,
)

__all__ = [
    "Archard",
    "JumpControl",
    "between_edges",
    "load_change",
    "loaded_depth",
    "resampled",
    "worn_roughness",
    "worn_volume",
]
