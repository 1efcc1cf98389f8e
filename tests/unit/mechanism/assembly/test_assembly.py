"""Assembly: gaps closed, freedoms and redundancy counted, and what is wrong said in words."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from tests.unit.mechanism.drawings import (
    body,
    bricard,
    chain,
    changed,
    joint,
    mechanism,
    rod,
    slider_crank,
    spatial_slider_crank,
    speed_drive,
    two_four_bars,
    with_joints,
)

import tribodyn as td
from tribodyn.cases.signals import AngleSignal
from tribodyn.core.errors import InputError
from tribodyn.mechanism.assembly.assembly import assemble
from tribodyn.mechanism.assembly.closing import System
from tribodyn.mechanism.assembly.parts_by_number import Model, model_of
from tribodyn.mechanism.assembly.passage import drive_through
from tribodyn.mechanism.builder.mechanism_builder import Mechanism
from tribodyn.mechanism.descriptor import TEMPLATES
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.model.drives_and_loads import DriveKeys
from tribodyn.mechanisms.catalogue import parse_case


def four_bar(crank: float = 0.2) -> Model:
    """Return a driven four-bar with a coupler and a rocker of 0.5 m, drawn with the crank along x."""
    pivot, end = np.zeros(3), np.array([crank, 0.0, 0.0])
    ground = np.array([0.6, 0.0, 0.0])
    across = ground - end
    half = 0.5 * float(np.linalg.norm(across))
    top = end + 0.5 * across + np.array([0.0, np.sqrt(0.25 - half**2), 0.0])
    bodies = {"crank": rod(pivot, end), "coupler": rod(end, top), "rocker": rod(top, ground)}
    joints = {
        "A": joint("revolute", ("ground", "crank"), pivot),
        "B": joint("revolute", ("crank", "coupler"), end),
        "C": joint("revolute", ("coupler", "rocker"), top),
        "D": joint("revolute", ("rocker", "ground"), ground),
    }
    return mechanism(bodies, joints, drives={"motor": speed_drive("A", 10.0)})


def moved(model: Model, name: str, change: tuple[float, float, float]) -> Model:
    """Return a drawing in which a joint's point on its second body is elsewhere."""
    point = tuple((np.array(model.case.joints[name].point) + change).tolist())
    return with_joints(model, [name], other_point=point)


@pytest.mark.parametrize(
    ("model", "freedoms", "redundant"),
    [
        (slider_crank(), 0, 3),
        (two_four_bars(), 1, 6),
        (spatial_slider_crank(), 1, 0),
        (bricard(), 1, 1),
        (four_bar(), 0, 3),
        (chain(5), 5, 0),
    ],
    ids=["slider-crank", "A02", "spatial", "Bricard", "four-bar", "chain"],
)
def test_freedoms_and_redundancy(model: Model, freedoms: int, redundant: int) -> None:
    assembly = assemble(model)
    assembly.require_sound()
    assert assembly.freedoms == freedoms
    number = 0 if assembly.redundancy is None else assembly.redundancy.number
    assert number == redundant
    assert (f"{redundant} constraint" in "".join(assembly.warnings)) == (redundant > 0)


@pytest.mark.parametrize(
    ("guided", "said"),
    [
        (True, "0 with ideal joints (fully driven); clearances free 2 more"),
        (False, "2 with ideal joints: slider is held by wrist only; clearances free 5 more"),
    ],
)
def test_degrees_of_freedom_are_told_apart(guided: bool, said: str, tmp_path: Path) -> None:
    # Guided, the pin moves in its bore in the plane alone; else it tilts and slides along the bore, too.
    text = td.load_case("slider-crank").to_toml()
    if not guided:
        text = re.sub(r"(?ms)^\[(joints\.guide|outputs\.slider(\.at)?)\]$.*?(?=^\[)", "", text)
    (tmp_path / "drawn.toml").write_text(text, encoding="utf-8")
    assert f"degrees of freedom: {said}" in td.check(td.load_case(tmp_path / "drawn.toml"))


def weighted(factors: tuple[float, float, float]) -> Model:
    """Return a chain of links so many times as heavy, each turning at 1 rad/s against the one before."""
    links = chain(3)
    bodies = {
        name: old.model_copy(
            update={"mass": old.mass * k, "inertia": tuple(moment * k for moment in old.inertia)}
        )
        for (name, old), k in zip(links.case.bodies.items(), factors, strict=True)
    }
    return with_joints(changed(links, bodies=bodies), start_speed=1.0)


def test_masses_do_not_decide_what_is_redundant() -> None:
    for factors in ((1.0, 1e-6, 1.0), (1e3, 1e-9, 1e3), (1e-9, 1.0, 1e3)):
        assembly = assemble(weighted(factors))
        assert assembly.freedoms == 3
        assert assembly.redundancy is None
        # Axes of neighbours stand at right angles.
        turning = np.linalg.norm(assembly.state.reshape(3, -1)[:, -3:], axis=1)
        np.testing.assert_allclose(turning, np.sqrt([1.0, 2.0, 5.0]), rtol=1e-6)


def test_a_body_too_light_for_its_joints_is_told() -> None:
    # Without this, joints of the bead come apart by tenths of a metre; at a millionth they hold to rounding.
    assert not assemble(weighted((1.0, 1e-6, 1.0))).findings
    finding = assemble(weighted((1e3, 1e-9, 1e3))).findings[0]
    assert finding.key == "bodies.link 1.mass"
    assert "link 1 with 1e-10 kg is too light beside link" in finding.text


def test_redundancy_names_the_joints_of_the_loop_alone() -> None:
    loop = four_bar()
    tail = {"tail": rod((0.6, 0.0, 0.0), (0.9, 0.0, 0.0))}
    hinge = {"tail": joint("revolute", ("ground", "tail"), (0.6, 0.0, 0.0))}
    assembly = assemble(changed(loop, bodies=tail, joints=hinge))
    assert assembly.redundancy is not None
    assert assembly.redundancy.joints == ("A", "B", "C", "D")


def test_a_small_gap_is_closed_on_the_branch_that_was_drawn() -> None:
    assembly = assemble(moved(four_bar(), "C", (1e-3, 2e-3, 0.0)))
    assembly.require_sound()
    assert 0.0 < assembly.moved.max() < 0.01
    assert assembly.state[13 + 1] > 0.0
    assert re.search(r"assembly moved \w+ by", assembly.remarks[-1])


def test_a_gap_that_does_not_close_is_told_with_its_joint_and_bodies() -> None:
    assembly = assemble(moved(four_bar(), "C", (0.0, 0.0, 5e-3)))
    finding = assembly.findings[0]
    assert finding.key == "joints.C"
    assert "does not close" in finding.text
    assert "5 mm apart" in finding.text
    with pytest.raises(InputError, match="does not close"):
        assembly.require_sound()


def test_a_drive_starts_elsewhere_than_the_drawing() -> None:
    start = np.radians(100.0)
    angle = AngleSignal(value=float(start), amplitude=0.1, angular_frequency=5.0)
    assembly = assemble(changed(four_bar(), drives={"motor": DriveKeys(joint="A", angle=angle)}))
    assembly.require_sound()
    assert assembly.state[:2] == pytest.approx([0.1 * np.cos(start), 0.1 * np.sin(start)], abs=1e-9)
    # ω = 0.1 · 5 at the start.
    assert assembly.state[12] == pytest.approx(0.5, rel=1e-9)


def test_velocities_follow_from_the_drive() -> None:
    state = assemble(slider_crank(100.0)).state.reshape(-1, 13)
    assert state[0, 12] == pytest.approx(100.0, rel=1e-12)
    # At the dead centre the slider rests and the rod turns by −r/l of the crank.
    assert state[2, 7] == pytest.approx(0.0, abs=1e-9)
    assert state[1, 12] == pytest.approx(-100.0 * 0.05 / 0.12, rel=1e-9)


def test_findings_name_what_to_change() -> None:
    loop = four_bar()
    loose = assemble(changed(loop, bodies={"loose": body(1.0, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))}))
    assert [finding.key for finding in loose.findings] == ["bodies.loose"]
    twice = assemble(changed(loop, drives={"second": speed_drive("D", 1.0)}))
    assert "motor and second drive one freedom" in twice.findings[0].text


def test_a_drive_against_a_locked_joint_has_nothing_to_drive() -> None:
    bodies = {"arm": rod((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))}
    joints = {
        "pivot": joint("revolute", ("ground", "arm"), (0.0, 0.0, 0.0)),
        "lock": joint("fixed", ("ground", "arm"), (1.0, 0.0, 0.0)),
    }
    findings = assemble(mechanism(bodies, joints, drives={"motor": speed_drive("pivot", 1.0)})).findings
    assert "drive motor has nothing to drive: joint pivot, joint lock leave" in findings[0].text


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (
            "crankpin",
            (0.0, 0.1, 1.0),
            "the axis of crankpin is not parallel to that of main, wrist, by 5.71 deg",
        ),
        (
            "guide",
            (1.0, 0.0, 0.1),
            "the axis of guide is not perpendicular to that of main, crankpin, wrist, by 5.71 deg",
        ),
    ],
)
def test_an_axis_out_of_plane_that_locks_a_drive_is_named(old, new, words):
    keys = {f"joints.{old}.axis": list(new), "joints.wrist.clearance.ideal": True}
    assembly = assemble(model_of(td.load_case("slider-crank").replace(keys)))
    found = [*assembly.findings, drive_through(assembly, 0.01).finding]
    assert any(finding and words in finding.text.replace(" and ", ", ") for finding in found)


def test_a_loop_that_does_not_close_over_the_drive_is_found() -> None:
    # Crank and ground are too long for coupler and rocker: no full turn.
    late = drive_through(assemble(four_bar(crank=0.5)), 1.0)
    assert late.finding is not None
    assert 0.0 < late.time < 0.5
    assert "does not close" in late.finding.text
    assert drive_through(assemble(four_bar()), 0.7).finding is None


def test_a_ring_with_many_dependent_rows_closes_as_runs_do(monkeypatch: pytest.MonkeyPatch) -> None:
    # Rows that are independent as drawn hardly are at the end of the stroke.
    ring = parse_case(TEMPLATES["vsv-ring"].text, "ring").replace({"pattern.vanes.count": 20})
    assert isinstance(ring, MechanismCase)
    assembly = assemble(model_of(ring))
    monkeypatch.setattr(System, "close", lambda *_: pytest.fail("joints stay open"))
    assert drive_through(assembly, ring.span).finding is None


def test_speeds_that_contradict_a_drive_are_refused() -> None:
    findings = assemble(with_joints(slider_crank(), ["main"], start_speed=1.0)).findings
    assert findings[0].key == "joints.main"


def swinging(mass: float) -> Mechanism:
    """Return a block of 1 kg below the end of a link of some mass, let go with the link level."""
    drawn = Mechanism("Light link", gravity="0, 0, -9.81 m/s^2", run={"duration": "1 ms"})
    drawn.body(
        "link",
        mass=f"{mass:g} kg",
        centre="50, 0, 0 mm",
        inertia=", ".join([f"{mass * 1e-3:g}"] * 3) + " kg m^2",
    )
    drawn.body("block", mass="1 kg", centre="100, 0, -100 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.revolute("pivot", "ground", "link", point="0, 0, 0 mm", axis=[0, 1, 0])
    return drawn.revolute("pin", "link", "block", point="100, 0, 0 mm", axis=[0, 1, 0])


@pytest.mark.parametrize(("mass", "warned"), [(1e-4, False), (1e-6, True)])
def test_reactions_of_a_light_body_are_exact_or_a_warning_names_it(mass: float, warned: bool) -> None:
    result = td.simulate(swinging(mass).case())
    # Moments about the pivot, where the link has the inertia 3.5e-3 m^2 times its mass.
    alpha = 9.81 * (0.05 * mass + 0.1) / (3.5e-3 * mass + 1e-2)
    found = float(result["reaction_force_global"].sel(joint="pin", axis="z")[0])
    error = abs(found / (9.81 - 0.1 * alpha) - 1.0) if warned else abs(found - (9.81 - 0.1 * alpha)) / 9.81
    text = " ".join(json.loads(result.attrs["warnings"]))
    assert ("link with 1e-06 kg is light beside block with 1 kg" in text) == warned
    assert (1e-5 < error < 2e-3) if warned else error < 1e-9
    assert ("may be wrong by up to 2 %" in text) == warned


def test_a_body_whose_reactions_would_be_wrong_is_refused() -> None:
    finding = assemble(model_of(swinging(1e-8).case())).findings[0]
    assert finding.key == "bodies.link.mass"
    assert "link with 1e-08 kg is too light beside block with 1 kg" in finding.text


def test_no_body_of_a_chain_of_like_bodies_is_light() -> None:
    chain = td.Mechanism("Chain", gravity="9.81, 0, 0 m/s^2", run={"duration": "1 ms"})
    for k in range(50):
        inertia = "1e-5, 1e-4, 1e-4 kg m^2"
        chain.body(f"link-{k}", mass="0.1 kg", centre=f"{100 * k + 50}, 0, 0 mm", inertia=inertia)
        before = "ground" if k == 0 else f"link-{k - 1}"
        chain.revolute(f"pin-{k}", before, f"link-{k}", point=f"{100 * k}, 0, 0 mm", axis=[0, 0, 1])
    assert not [text for text in td.check(chain) if "light" in text]
    force = td.simulate(chain)["reaction_force"].isel(time=0).to_numpy()
    # Each pin bears the weight of what hangs from it.
    np.testing.assert_allclose(np.abs(force[:, 0]), 0.981 * np.arange(50, 0, -1), rtol=1e-9)


def test_a_search_that_ends_in_no_number_names_a_joint_too():
    system = System(slider_crank())
    system.now.couplings.residual[:] = np.nan
    assert "joint" in str(system.open_joint())
