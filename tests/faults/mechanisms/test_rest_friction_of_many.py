"""Random mechanisms with several frictions that hold at rest: they end, they do not creep, or say why not."""

import math
from typing import Any

import numpy as np
import pytest

import tribodyn as td

Chance = np.random.Generator
LOCKED = "its friction grows faster than the reaction that it follows"


def drawn(title: str, **more: Any) -> td.Mechanism:
    """Return an empty mechanism under gravity, whose friction holds."""
    more = {"run": {"duration": "1 s"}} | more
    return td.Mechanism(title, gravity="0, 0, -9.81 m/s^2", friction={"rest": True}, **more)


def body(mechanism: td.Mechanism, name: str, mass: float, centre: Any, about: float = 1e-3) -> None:
    """Add a body with its centre [m] and its moment of inertia about z [kg m²]."""
    place = ", ".join(f"{1e3 * x:.6g}" for x in centre)
    mechanism.body(name, mass=f"{mass:.4g} kg", centre=f"{place} mm", inertia=f"1e-3, 1e-3, {about} kg m^2")


def blocks(chance: Chance) -> td.Mechanism:
    """Return blocks on each other, on an incline."""
    mechanism, steep, below = drawn("Blocks"), float(chance.uniform(0.0, 0.5)), "ground"
    for k in range(int(chance.integers(2, 5))):
        body(mechanism, f"block-{k}", 10 ** chance.uniform(-1, 1), (0.0, 0.0, 0.02 * k))
        down, aside = steep + float(chance.normal(0.0, 0.05)), 0.1 * k
        axis = [math.cos(down) * math.cos(aside), math.cos(down) * math.sin(aside), -math.sin(down)]
        mechanism.prismatic(f"face-{k}", below, f"block-{k}", point=f"0, 0, {20 * k - 10} mm", axis=axis)
        mu = float(chance.uniform(0.05, 1.0))
        more = {"static_coefficient": mu * float(chance.uniform(1.0, 1.5))} if chance.uniform() < 0.5 else {}
        mechanism.friction(f"rubbing-{k}", joint=f"face-{k}", friction_coefficient=mu, **more)
        below = f"block-{k}"
    return mechanism


def chain(chance: Chance) -> td.Mechanism:
    """Return links with friction in each joint, at radii up to more than the length of a link."""
    mechanism, above, point, axis = drawn("Chain"), "ground", np.zeros(3), chance.normal(size=3)
    for k in range(int(chance.integers(2, 5))):
        way = chance.normal(size=3)
        end = point + 0.1 * way / np.linalg.norm(way)
        body(mechanism, f"link-{k}", 10 ** chance.uniform(-1, 0.5), 0.5 * (point + end))
        along = [float(x) for x in (axis if chance.uniform() < 0.6 else chance.normal(size=3))]
        place = ", ".join(f"{1e3 * x:.6g}" for x in point) + " mm"
        mechanism.revolute(f"joint-{k}", above, f"link-{k}", point=place, axis=along)
        load = {"normal_load": f"{10 ** chance.uniform(0, 3):.4g} N"} if chance.uniform() < 0.3 else {}
        size = {"radius": f"{10 ** chance.uniform(0, 2.2):.4g} mm"}
        mu = float(chance.uniform(0.05, 0.8))
        mechanism.friction(f"rubbing-{k}", joint=f"joint-{k}", friction_coefficient=mu, **size, **load)
        above, point = f"link-{k}", end
    return mechanism


def screw(chance: Chance) -> td.Mechanism:
    """Return a screw that a gear with losses drives, with friction in guide and bearings."""
    mechanism = drawn("Screw", run={"duration": "0.3 s"})
    for name, x, z in (("motor", 0.05, 0.05), ("screw", 0.0, 0.05)):
        body(mechanism, name, 1.0, (x, 0.0, z), 2e-4)
    body(mechanism, "nut", 10 ** chance.uniform(0.0, 1.5), (0.0, 0.0, 0.03))
    mechanism.revolute("shaft", "ground", "motor", point="50, 0, 0 mm", axis=[0, 0, 1])
    mechanism.revolute("bearing", "ground", "screw", point="0, 0, 0 mm", axis=[0, 0, 1])
    mechanism.prismatic(
        "guide", "ground", "nut", point=f"{chance.uniform(5, 60):.4g}, 0, 30 mm", axis=[0, 0, 1]
    )
    losses = {"efficiency": float(chance.uniform(0.5, 0.95))}
    if chance.uniform() < 0.5:
        losses["backward_efficiency"] = float(chance.uniform(-0.5, 0.9))
    mechanism.gear("mesh", joints=["shaft", "bearing"], ratio=-float(chance.uniform(0.2, 3)), **losses)
    thread = {"lead": f"{10 ** chance.uniform(0, 1.5):.4g} mm", "radius": "8 mm"}
    mu = float(chance.uniform(0.02, 0.4))
    mechanism.screw("thread", joints=["bearing", "guide"], friction_coefficient=mu, **thread)
    turning = {"radius": "10 mm"}
    for joint, more in (("guide", {}), ("bearing", turning), ("shaft", turning | {"normal_load": "20 N"})):
        mu = float(chance.uniform(0.05, 0.3))
        if chance.uniform() < 0.7:
            mechanism.friction(f"rubbing-{joint}", joint=joint, friction_coefficient=mu, **more)
    if chance.uniform() < 0.5:
        torque = f"{10 ** chance.uniform(-2, 0.7):.4g} N m"
        mechanism.load("push", body="motor", moment=torque, direction=[0, 0, 1])
    return mechanism


def unloaded(chance: Chance) -> td.Mechanism:
    """Return blocks that fall along their guides, now and then pushed aside."""
    mechanism = drawn("Unloaded")
    for k, below, aside in ((0, "ground", 0.0), (1, "block-0", float(chance.choice([0.0, 1e-9, 1e-3, 1.0])))):
        body(mechanism, f"block-{k}", 2.0, (0.0, 0.0, 0.05 * k))
        mechanism.prismatic(f"face-{k}", below, f"block-{k}", point=f"0, 0, {50 * k} mm", axis=[aside, 0, 1])
        mechanism.friction(f"rubbing-{k}", joint=f"face-{k}", friction_coefficient=0.3)
    if chance.uniform() < 0.5:
        swinging = {"amplitude": "60 N", "angular_frequency": "20 rad/s"}
        mechanism.load("side", body="block-0", point="0, 0, 0 mm", direction=[1, 0, 0], force=swinging)
    return mechanism


FORMS = (blocks, chain, screw, unloaded)
FEW = [(blocks, [0, 1, 59]), (chain, [5, 34, 43, 44, 55]), (screw, [3, 86]), (unloaded, [0, 1])]


@pytest.mark.parametrize(
    ("form", "seeds"), [*FEW, *(pytest.param(form, range(60), marks=pytest.mark.long) for form in FORMS)]
)
def test_frictions_end_in_a_state_or_a_sentence(form, seeds):
    for seed in seeds:
        case = form(np.random.default_rng([seed])).case()
        run = td.simulate(case)
        words = str(run.attrs["failure"])
        assert not words or LOCKED in words, f"seed {seed}: {words}"
        speed = np.abs(run["velocity"].values)
        assert np.isfinite(speed).all()
        if words or speed[-10:].max() > 1e-6:
            continue
        later = td.simulate(case.replace({"run.duration": "1000 s"}))
        late = later["position"].values[later["time"].values > 100.0]
        assert np.ptp(late, axis=0).max() < 1e-10, f"seed {seed} creeps"
