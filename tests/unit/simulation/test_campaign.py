"""Cycle jumping on a made-up joint whose wear is known: no motion is simulated."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tribodyn.core.errors import Stopped
from tribodyn.core.problem import Statistics
from tribodyn.mechanisms.bushing import Carried
from tribodyn.simulation.campaign import MOST_STAGES, CampaignPlan, Cycle, run_campaign
from tribodyn.wear import Archard, JumpControl

ROUGHNESS = 1.6e-6
LENGTH = 0.5 * ROUGHNESS  #: Depth over which the pressure of the made-up joint falls by e [m].
SHAPE = (4, 6)
LOAD = 1e6 * np.linspace(0.5, 1.0, 24).reshape(SHAPE)
RATE = 1e-15


class Punch:
    """A joint held in place: each point wears alone, dh/dn = k L exp(−h/ℓ), so h = ℓ ln(1 + k L n/ℓ).

    Cycle ``fails_at`` is not completed.
    """

    def __init__(self, fails_at=math.inf):
        self.cycles = []
        self.fails_at = fails_at

    def cycle(self, wear, carried, done):
        count = 0.0 if carried is None else float(carried.state[0])
        failure = "interrupted" if len(self.cycles) == self.fails_at else None
        motion = {"wear_force_mean": float(wear.max())}
        found = Cycle(
            Carried(np.full(8, count + 1.0), np.zeros(SHAPE)),
            LOAD * np.exp(-wear / LENGTH),
            motion,
            Statistics(steps=10),
            failure,
        )
        self.cycles.append((wear.copy(), done, found))
        return found

    def contact_energy(self, wear, carried):
        return float(np.exp(-wear / LENGTH).sum())


def plan(
    cycles=10_000, *, limit=0.05, depth=0.25, feedback=True, depth_limit=math.inf, rate=RATE, settling=1
):
    return CampaignPlan(
        cycles=cycles,
        settling=settling,
        feedback=feedback,
        depth_limit=depth_limit,
        of_cycle=("wear_force_mean",),
        law=Archard(rate),
        control=JumpControl(limit, depth, ROUGHNESS),
        node_area=np.broadcast_to(np.array([[0.0], [1e-6], [2e-6], [0.0]]), SHAPE),
    )


def campaign(asked, resumed=None, punch=None):
    kept = []
    worn, cycle = run_campaign(punch or Punch(), asked, resumed, kept.append)
    return worn, cycle, kept


def exact(cycles, rate=RATE):
    return LENGTH * np.log1p(rate * LOAD * cycles / LENGTH)


def same(one, other):
    """Tell whether two campaigns are the same to the bit."""
    assert one.cycles == other.cycles
    assert one.statistics == other.statistics
    for name in ("depth", "load", "stage_cycles", "stage_depth"):
        assert getattr(one, name).tobytes() == getattr(other, name).tobytes()
    for name in one.history:
        assert one.history[name].tobytes() == other.history[name].tobytes()


def test_depth_follows_the_closed_form_and_halving_the_jump_halves_the_error():
    errors = []
    for limit in (0.08, 0.04, 0.02):
        worn, _, kept = campaign(plan(limit=limit))
        assert len(kept) > 10
        errors.append(np.abs(worn.depth / exact(10_000) - 1.0).max())
    assert errors[1] < 0.02
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=0.15)  # an explicit Euler step is of first order
    assert errors[1] / errors[2] == pytest.approx(2.0, rel=0.15)


def test_with_little_wear_feedback_makes_no_difference():
    shortfall = []
    for rate in (RATE, RATE / 10.0, RATE / 100.0):
        worn, *_ = campaign(plan(1000, rate=rate, limit=1e-3))
        without, *_ = campaign(plan(1000, rate=rate, feedback=False))
        np.testing.assert_allclose(without.depth, 1000 * rate * LOAD, rtol=1e-12)
        shortfall.append(float((1.0 - worn.depth / without.depth).max()))
    # ln(1 + x)/x = 1 − x/2: in proportion to the rate.
    assert shortfall[2] < 1e-2
    assert shortfall[1] / shortfall[2] == pytest.approx(10.0, rel=0.1)


def test_jumps_grow_with_the_bushing_worn_in():
    worn, _, kept = campaign(plan(10**9))
    assert worn.cycles == 10**9
    assert len(kept) < 500
    jumps = worn.history["wear_jump_cycles"][:-2]
    assert jumps[-1] > 1e4 * jumps[0]
    gains = np.diff(worn.history["wear_depth_max"])
    assert gains.max() <= 0.25 * ROUGHNESS * (1.0 + 1e-12)
    assert np.median(worn.history["wear_load_change"][1:]) < 0.06


def test_cycles_before_the_first_stop_do_not_wear():
    punch = Punch()
    campaign(plan(settling=3), punch=punch)
    assert all(not wear.any() for wear, _, _ in punch.cycles[:4])
    assert punch.cycles[4][0].any()
    assert [int(found.carried.state[0]) for _, _, found in punch.cycles] == [*range(1, len(punch.cycles) + 1)]


def test_a_campaign_ends_at_the_depth_limit():
    limit = 0.3e-6
    worn, cycle, _ = campaign(plan(10**9, limit=1e-3, depth_limit=limit))
    assert cycle.failure is None
    assert worn.depth.max() == pytest.approx(limit, rel=1e-2)
    assert worn.depth.max() >= limit
    # n = ℓ (e^(h/ℓ) − 1)/(k L) of the closed form; jumps of a thousandth of the load leave an error
    # of less than a hundredth.
    life = LENGTH * math.expm1(limit / LENGTH) / (RATE * LOAD.max())
    assert worn.life == pytest.approx(life, rel=1e-2)
    assert worn.cycles == math.ceil(worn.life)


def test_a_campaign_ends_where_the_motion_reaches_its_limit():
    # The motion of the made-up joint is its depth: both limits are passed at the same cycle.
    limit = 0.3e-6
    deep, *_ = campaign(plan(10**9, limit=1e-3, depth_limit=limit))
    moved, cycle, _ = campaign(replace(plan(10**9, limit=1e-3), limits={"wear_force_mean": limit}))
    assert cycle.failure is None
    assert moved.life == pytest.approx(deep.life, rel=1e-9)
    assert moved.history["wear_force_mean"][-2] < limit <= moved.history["wear_force_mean"][-1]
    begun, *_ = campaign(replace(plan(), limits={"wear_force_mean": -1.0}))
    assert (begun.life, begun.cycles) == (0.0, 0)


@pytest.mark.parametrize("stop", [0, 1, 7])
def test_it_goes_on_from_what_was_kept_to_the_same_bits(stop):
    whole, last, kept = campaign(plan())
    again, repeated, _ = campaign(plan(), resumed=kept[stop])
    same(whole, again)
    assert last.sliding_load.tobytes() == repeated.sliding_load.tobytes()


def test_a_cycle_that_fails_ends_it_and_what_was_kept_goes_on():
    whole, *_ = campaign(plan())
    worn, cycle, kept = campaign(plan(), punch=Punch(fails_at=5))
    assert cycle.failure == "interrupted"
    assert worn.cycles == kept[-1].cycles > 0
    again, *_ = campaign(plan(), resumed=kept[-1])
    same(whole, again)


class Stopping(Punch):
    """A punch whose caller stops the campaign while the model of a later cycle is set up, or after it."""

    def __init__(self, method, after):
        super().__init__()
        self.method, self.after = method, after

    def _count(self, method):
        if method == self.method and len(self.cycles) >= self.after:
            raise Stopped

    def cycle(self, wear, carried, done):
        self._count("cycle")
        return super().cycle(wear, carried, done)

    def contact_energy(self, wear, carried):
        self._count("contact_energy")
        return super().contact_energy(wear, carried)


@pytest.mark.parametrize("method", ["cycle", "contact_energy"])
def test_stopped_between_two_cycles_it_ends_as_interrupted_and_what_was_kept_goes_on(method):
    whole, *_ = campaign(plan())
    worn, cycle, kept = campaign(plan(), punch=Stopping(method, after=4))
    assert cycle.failure == "interrupted"
    assert worn.cycles == kept[-1].cycles > 0
    again, *_ = campaign(plan(), resumed=kept[-1])
    same(whole, again)


def test_stopped_before_the_first_cycle_it_raises():
    with pytest.raises(Stopped):
        campaign(plan(), punch=Stopping("cycle", after=0))


def test_a_failure_before_the_first_stop_leaves_an_unworn_bushing():
    worn, cycle, kept = campaign(plan(), punch=Punch(fails_at=0))
    assert cycle.failure == "interrupted"
    assert kept == []
    assert not worn.depth.any()
    assert worn.history["wear_cycles"].size == 0


def test_worn_profiles_are_kept_few_and_the_last_always():
    worn, _, kept = campaign(plan(10**9, limit=0.01))
    assert len(kept) > 3 * MOST_STAGES
    assert MOST_STAGES // 2 <= worn.stage_cycles.size <= MOST_STAGES
    assert worn.stage_cycles[-1] == worn.cycles
    assert (np.diff(worn.stage_cycles) > 0.0).all()
    np.testing.assert_array_equal(worn.stage_depth[-1], worn.depth)


def test_volume_of_each_jump_is_the_rate_times_the_sliding_load():
    asked, punch = plan(), Punch()
    worn, *_ = campaign(asked, punch=punch)
    jumps = worn.history["wear_jump_cycles"]
    assert jumps[-1] == 0.0
    assert jumps.sum() == worn.cycles == 10_000
    loads = [float((asked.node_area * found.sliding_load).sum()) for _, _, found in punch.cycles[1:-1]]
    worn_off = RATE * jumps[:-1] * np.array(loads)
    # To rounding; asked for are 1e-10.
    np.testing.assert_allclose(np.diff(worn.history["wear_volume"]), worn_off, rtol=1e-11)
    assert worn.history["wear_volume"][0] == 0.0


def test_without_feedback_the_gap_stays_as_it_was():
    punch = Punch()
    worn, *_ = campaign(plan(feedback=False), punch=punch)
    assert len(punch.cycles) == 3
    assert all(not wear.any() for wear, _, _ in punch.cycles)
    assert list(worn.history["wear_cycles"]) == [0.0, 10_000.0]


def test_a_campaign_that_does_not_reach_the_limit_says_nothing_of_life():
    worn, *_ = campaign(plan(100, depth_limit=1e-3))
    assert worn.life == math.inf


def test_no_wear_rate_no_wear():
    worn, *_ = campaign(plan(10**6, rate=0.0, depth_limit=1e-6))
    assert worn.cycles == 10**6
    assert not worn.depth.any()


def test_energy_taken_away_and_cost_are_written_down():
    worn, *_ = campaign(plan())
    energy = worn.history["wear_energy_lost"]
    assert (energy[:-1] > 0.0).all()
    assert energy.sum() == pytest.approx(24.0 - np.exp(-worn.depth / LENGTH).sum(), rel=1e-12)
    # The settling cycle, and one a stop.
    assert worn.statistics["steps"] == 10 * (1 + worn.history["wear_cycles"].size)
