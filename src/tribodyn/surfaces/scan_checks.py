"""Checks of a scan: what is refused, and remarks."""

import math
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.surfaces.scan import Scan
from tribodyn.surfaces.treatment import filled, levelled

#: In each direction: seven are read for one curvature, and a mean needs more than a few.
FEWEST_POINTS: Final = 32
MOST_MISSING: Final = 0.10  #: Share of heights that may be missing: the rest still stands for the surface.
_TALLEST: Final = 1.0
_WIDEST_STEP: Final = 0.1
_FEWEST_HEIGHTS: Final = 8
_SENTINEL: Final = 100.0
_SPIKE: Final = 8.0
_JUMP: Final = 12.0
_LINES_LOOKED_AT: Final = 64


def checked(scan: Scan) -> tuple[Scan, list[str]]:
    """Return a scan without empty borders, and what a reader of its numbers should know.

    Raises InputError if it is too small, flat, full of holes, stepped, or in the wrong unit.
    """
    scan = _cropped(scan)
    _check_size(scan)
    warnings = _check_missing(scan)
    _check_unit(scan)
    _check_levels(scan)
    warnings += _check_spikes(scan)
    _check_steps(scan)
    return scan, warnings


def _cropped(scan: Scan) -> Scan:
    """Cut off lines at the border that hold no height."""
    known = ~np.isnan(scan.heights)
    if not known.any():
        raise _refused(scan, "there is no height in this file, only missing ones")
    parts = []
    for axis in range(known.ndim):
        places = np.flatnonzero(known.any(axis=1 - axis) if scan.is_map else known)
        parts.append(slice(places[0], places[-1] + 1))
    return scan.with_heights(scan.heights[tuple(parts)])


def _check_size(scan: Scan) -> None:
    shape = scan.heights.shape
    if min(shape) >= FEWEST_POINTS:
        return
    size = " x ".join(str(n) for n in reversed(shape))
    one_line = "; cut out one line and give it as a profile" if max(shape) >= FEWEST_POINTS else ""
    raise _refused(
        scan,
        f"{size} heights are too few; allowed: a profile of at least {FEWEST_POINTS} points, or a map of at "
        f"least that many each way{one_line}",
    )


def _check_missing(scan: Scan) -> list[str]:
    share = scan.missing
    if share > MOST_MISSING:
        raise _refused(
            scan,
            f"{100 * share:.3g} % of the heights are missing; at most {100 * MOST_MISSING:g} % may be: "
            "cut out a part with fewer holes, or fill them in the instrument's program",
        )
    return [f"{100 * share:.2g} % of the heights are missing and have no say"] if share else []


def _check_unit(scan: Scan) -> None:
    tallest = float(np.nanmax(np.abs(scan.heights)))
    if not np.isfinite(tallest) or tallest > _TALLEST:
        raise _refused(scan, f"heights of up to {tallest:.4g} m; is their unit right?")
    if max(scan.spacing) > _WIDEST_STEP:
        raise _refused(scan, f"points {max(scan.spacing):.4g} m apart; is the unit of the spacing right?")


def _check_levels(scan: Scan) -> None:
    """Refuse scans that are flat, or so coarsely digitised that slopes and curvatures mean nothing."""
    found = np.unique(scan.heights[~np.isnan(scan.heights)]).size
    if found == 1:
        raise _refused(scan, "all heights are equal: this is no rough surface")
    if found < _FEWEST_HEIGHTS:
        raise _refused(
            scan,
            f"there are only {found} different heights; export the scan with more digits, or in a finer unit",
        )


def _check_spikes(scan: Scan) -> list[str]:
    """Refuse numbers that stand for a missing height; report points that stand out."""
    heights = levelled(scan, "mean").heights
    off = np.abs(heights - np.nanmedian(heights))
    scale = 1.4826 * float(np.nanmedian(off)) or float(np.nanmean(off))
    worst = np.unravel_index(int(np.nanargmax(off)), off.shape)
    if off[worst] > _SENTINEL * scale:
        place = ", ".join(str(k + 1) for k in worst)
        raise _refused(
            scan,
            f"the height {scan.heights[worst]:.4g} m at point ({place}) stands {off[worst] / scale:.3g} "
            "times the roughness away from the others; if it marks a missing height or is an error, "
            "leave it empty or write nan",
        )
    count = int(np.sum(off > _SPIKE * scale))
    return [f"{count} points stand more than {_SPIKE:g} times the roughness away"] if count else []


def _check_steps(scan: Scan) -> None:
    """Refuse a scan that runs over a step: its statistics would be those of the step."""
    heights = filled(levelled(scan, "plane").heights)
    for axis in range(heights.ndim):
        lines = np.atleast_2d(np.moveaxis(heights, axis, -1))
        lines = lines[:: max(1, len(lines) // _LINES_LOOKED_AT)]
        found = [step for step in map(_step, lines) if step is not None]
        if 2 * len(found) > len(lines):
            place, height = (float(np.median(values)) for values in zip(*found, strict=True))
            where = "xy"[heights.ndim - 1 - axis]
            raise _refused(
                scan,
                f"the scan runs over a step of {abs(height) * 1e6:.3g} um at {where} = "
                f"{(place + 0.5) * scan.spacing[axis] * 1e3:.4g} mm; cut it there and give one side",
            )


def _step(line: FloatArray) -> tuple[float, float] | None:
    """Return place and height of the step in a line, shape (n,), if there is one.

    A step is a single rise far beyond all others after which the level stays changed.
    """
    rises = np.diff(line)
    sizes = np.abs(rises)
    place = int(np.argmax(sizes))
    others = np.delete(sizes, place)
    scale = 1.4826 * float(np.median(others)) or float(np.mean(others)) or math.ulp(float(sizes[place]))
    if sizes[place] <= _JUMP * scale or np.sum(others > 0.5 * sizes[place]) > 0:
        return None
    window = max(4, line.size // 8)
    before, after = line[max(0, place + 1 - window) : place + 1], line[place + 1 : place + 1 + window]
    change = float(np.median(after) - np.median(before))
    stays = change * np.sign(rises[place]) > 0.5 * sizes[place]
    return (float(place), float(rises[place])) if stays else None


def _refused(scan: Scan, message: str) -> InputError:
    return InputError(message, source=scan.source or None)
