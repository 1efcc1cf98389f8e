"""What the source paper says of wear, sections 2.4 and 5.3 and Fig. 19, in the formulation of its figures.

The paper divides the wear rate by the bare number 65 (Eq. 47); without that the depths are 65 times larger.
"""

from functools import cache

import numpy as np
import pytest

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.simulation import simulate


@cache
def worn(clearance):
    case = load_case("vsv").replace(
        {
            "mechanism.formulation": "paper",
            "joint.clearance": clearance,
            "wear.cycles": 400,
            "wear.paper_hardness_divisor": 65.0,
            "run.output_interval": "20 ms",
        }
    )
    return simulate(case)


@pytest.mark.parametrize(("clearance", "depth"), [("40 um", 2e-10), ("20 um", 2e-10 / 1.85)])
def test_depth_after_400_cycles(clearance, depth):
    # "The maximum wear depth is 2×10⁻⁴ µm [at 40 µm], which is about 1.85 times of the clearance of 20 µm."
    # Measured: 2.2e-4 µm and 0.94e-4 µm. A factor of 1.5 is what was asked for.
    assert depth / 1.5 < float(worn(clearance)["wear_depth"].max()) < 1.5 * depth


def test_wear_grows_with_clearance_and_cycles():
    # The paper: 1.85 times as deep at 40 µm as at 20 µm. Measured: 2.36 times on the edge itself, 1.79 times
    # 0.5 mm from it; where the paper's grid ends is not said.
    ratio = float(worn("40 um")["wear_depth"].max() / worn("20 um")["wear_depth"].max())
    assert 1.5 < ratio < 2.8
    for clearance in ("20 um", "40 um"):
        assert (np.diff(worn(clearance)["wear_depth_max"]) > 0.0).all()


@pytest.mark.parametrize("clearance", ["20 um", "40 um"])
def test_wear_is_concentrated_on_the_edges(clearance):
    result = worn(clearance)
    depth, z = result["wear_depth"].values.max(axis=0), result["z"].values
    assert depth[[0, -1]].min() > 0.0
    assert depth.max() in depth[[0, -1]]
    assert depth[np.abs(z) < 4e-3].max() < 0.05 * depth.max()
