"""One assembly of the mechanism all the way: no jump to the other one, however far the crank turns."""

from dataclasses import replace

import numpy as np
import pytest

from tribodyn.papers.cheng_2022.reduced.parameters import Lengths
from tribodyn.papers.cheng_2022.reduced.reach import check_reach, closure, ideal_vane_angle, reachable

SEEDS = range(24)


def varied(lengths: Lengths, seed: int) -> Lengths:
    """Return a mechanism with lengths 20 % and angles 15° off at most."""
    chance = np.random.default_rng(seed)
    names = ("l_1", "l_2", "l_3", "l_4", "l_m")
    changes = {name: getattr(lengths, name) * chance.uniform(0.8, 1.2) for name in names}
    turned = {name: getattr(lengths, name) + chance.uniform(-0.26, 0.26) for name in ("gamma", "phi")}
    return replace(lengths, **changes, **turned)


def test_most_of_these_mechanisms_can_be_assembled(make_vsv):
    reaches = [reachable(varied(make_vsv().lengths, seed), 0.0, 0.0) for seed in SEEDS]
    assert sum(reach is not None for reach in reaches) > len(SEEDS) / 2


@pytest.mark.parametrize("seed", SEEDS)
def test_the_vane_angle_follows_the_crank_without_a_jump(make_vsv, seed):
    lengths = varied(make_vsv().lengths, seed)
    reach = reachable(lengths, 0.0, 0.0)
    if reach is None:
        return
    theta_a = np.linspace(*reach, 1001)
    theta_v = np.unwrap(ideal_vane_angle(lengths, theta_a))
    # Where the assemblies merge θ_v changes like a square root, by 0.1 rad here. A jump has 1 or more.
    assert np.abs(np.diff(theta_v)).max(initial=0.0) < 0.3
    np.testing.assert_allclose(closure(lengths, theta_a, theta_v), 0.0, atol=1e-15)


def test_the_other_assembly_passing_straight_down_changes_nothing(make_vsv):
    # Of this mechanism the smaller vane angle falls through −90° while the larger one is at 150°.
    lengths = replace(make_vsv().lengths, l_1=0.0491, l_2=0.1441, l_3=0.4196, l_4=0.0486, l_m=0.483)
    crank = np.radians(np.linspace(-10.0, 15.4, 200))
    check_reach(lengths, crank[0], crank[-1])
    vane = np.degrees(ideal_vane_angle(lengths, crank))
    assert 2.0 > np.diff(vane).max() > np.diff(vane).min() > 0.0
    assert vane[-1] == pytest.approx(159.9, abs=0.05)
