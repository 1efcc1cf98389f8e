"""Heights as drawings state them: Ra, Rq, Rz of a profile (ISO 21920-2), Sa and Sq of a map (ISO 25178-2)."""

from __future__ import annotations

from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray

SECTIONS: Final = 5
"""Sections of a profile whose heights from the lowest to the highest point Rz is the mean of."""


def arithmetic_mean(heights: FloatArray) -> float:
    """Return the mean magnitude of heights about their mean [m], Ra or Sa; NaN where one is missing."""
    return float(np.nanmean(np.abs(heights - np.nanmean(heights))))


def mean_total_height(heights: FloatArray) -> float:
    """Return Rz [m] of a profile: the mean height of its sections, each from lowest to highest point."""
    sections = [part for part in np.array_split(heights, SECTIONS) if np.isfinite(part).any()]
    return float(np.mean([np.nanmax(part) - np.nanmin(part) for part in sections]))
