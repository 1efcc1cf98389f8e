"""Draw the figure of ``tribodyn surface`` for the manual, of a generated scan with a hole and a tilt.

python docs/plots/surface.py OUTPUT_DIRECTORY
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from tribodyn.figures.surface import draw
from tribodyn.surfaces import SelfAffine, Treatment, analyse, dependence, generate

SPACING = 0.6e-6


def main() -> None:
    """Generate, analyse, draw."""
    scan = generate(SelfAffine(1.2e-6, 0.75, roll_off=60e-6, shortest=3e-6), (384, 512), SPACING, seed=4)
    heights = scan.heights + 0.02 * SPACING * np.arange(512)
    heights[100:110, 200:215] = np.nan
    scan = replace(scan, heights=heights, source="scan.csv")
    surface = analyse(scan, Treatment(short_cutoff=3e-6, long_cutoff=0.2e-3))
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    draw(surface, dependence(surface, scan)).savefig(folder / "surface.png", dpi=120)


if __name__ == "__main__":
    main()
