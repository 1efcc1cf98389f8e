"""Physical constants."""

from __future__ import annotations

from typing import Final

STANDARD_GRAVITY: Final = 9.81
"""Acceleration of gravity [m/s²], rounded as in the source paper's field."""
