"""A mechanism as a file, as calls in Python and as equations, and values that hardly belong together."""

from pathlib import Path

import numpy as np
import pytest
from tests.unit.mechanism.slider_crank import FILE, IDEAL, built, parsed

import tribodyn as td
from tribodyn.cases.load import parse
from tribodyn.core.errors import InputError
from tribodyn.mechanism.assembly.parts_by_number import model_of
from tribodyn.mechanism.assembly.records import mechanism_data
from tribodyn.mechanism.builder.mechanism_builder import Mechanism
from tribodyn.mechanism.descriptor import TEMPLATES
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.studies.plan import make_plan

CASE = parsed()


def test_calls_in_python_make_the_case_that_a_file_makes() -> None:
    assert built() == CASE
    assert parsed(built().to_toml()) == CASE


@pytest.mark.parametrize("comments", [False, True])
def test_what_is_written_reads_back(comments: bool) -> None:
    assert parsed(CASE.to_toml(comments=comments)) == CASE
    assert 'speed = "5000 rpm"' in CASE.to_toml()


def test_a_run_is_as_long_as_its_cycles() -> None:
    assert CASE.period == pytest.approx(0.012)
    assert CASE.duration == pytest.approx(0.024)
    assert CASE.output_interval == pytest.approx(0.012 / 500)
    assert CASE.replace({"run.duration": "1 s"}).duration == 1.0


def test_every_key_of_every_joint_can_be_changed_and_varied() -> None:
    changed = CASE.replace({"joints.wrist.clearance.radial": "40 um", "drives.motor.speed": "3000 rpm"})
    assert changed.at("joints.wrist.clearance.radial") == 40e-6
    assert changed.period == pytest.approx(0.02)
    real = CASE.replace(
        {
            "joints.pin.clearance.radius": "9 mm",
            "joints.pin.clearance.radial": "10 um",
            "joints.pin.clearance.length": "9 mm",
        }
    )
    assert real.joints["pin"].clearance is not None
    plan = make_plan(
        CASE, {"joints.wrist.clearance.radial": "20:60:20 um", "joints.pin.point.x": "49, 50 mm"}
    )
    assert len(plan.points) == 6


def test_principal_axes_turn_the_inertia() -> None:
    turned = CASE.replace({"bodies.rod.first_axis": "[0, 2, 0]", "bodies.rod.second_axis": "[-1, 0, 0]"})
    # Rounding of products of unit vectors.
    np.testing.assert_allclose(
        mechanism_data(model_of(turned)).parts.bodies[1].inertia, np.diag([2.5e-4, 2e-5, 2.5e-4]), atol=1e-19
    )


def test_a_pair_has_surfaces_and_law_of_its_own() -> None:
    assert CASE.pairs["steel-polyimide"].contact.law == "gw"
    assert CASE.contact.law == "rsdc"
    plain = CASE.replace(
        {"joints.wrist.clearance.pair": "steel-polyimide", "pairs.steel-polyimide.contact.law": "ke"}
    )
    assert plain.pairs["steel-polyimide"].contact.law == "ke"


def test_a_pair_may_take_its_numbers_from_a_scan(tmp_path: Path) -> None:
    heights = np.random.default_rng(3).normal(scale=0.5, size=(64, 64))
    rows = "\n".join(",".join(f"{h:.6f}" for h in row) for row in heights)
    (tmp_path / "scan.csv").write_text(f"# unit: um\n# spacing: 1 um\n{rows}\n")
    text = FILE.replace(
        "[drives.motor]", '[pairs.steel-polyimide.asperities]\nsurface = "scan.csv"\n[drives.motor]'
    )
    found = parse(text, "mine.toml", {"mechanism": MechanismCase}, tmp_path)
    assert found.at("pairs.steel-polyimide.asperities.surface") is None
    # The scan's roughness, to the scatter of 4096 heights.
    assert found.at("pairs.steel-polyimide.surfaces.bushing.roughness") == pytest.approx(0.5e-6, rel=0.05)
    assert found.at("surfaces.bushing.roughness") == pytest.approx(1.586e-6)
    with pytest.raises(
        InputError, match=r"pairs\.steel-polyimide\.asperities\.level: this belongs to a scan"
    ):
        parsed(text.replace('surface = "scan.csv"', 'level = "plane"'))


def test_an_undamped_law_of_a_pair_has_no_damping_factor() -> None:
    text = FILE.replace("restitution = 0.8\n", "")
    assert parsed(text).pairs["steel-polyimide"].contact.damping_factor == "none"


def test_a_builder_names_what_is_written_twice_or_too_early() -> None:
    twice = Mechanism().body("rod", mass="1 kg")
    with pytest.raises(InputError, match=r"bodies\.rod: this name is given twice"):
        twice.body("rod", mass="2 kg")
    with pytest.raises(InputError, match="write the joint first"):
        twice.clearance("pin", radius="1 mm", radial="1 um")
    with pytest.raises(InputError, match=r"Mechanism: bodies\.rod\.centre: this key is missing"):
        twice.case()


STOP = """
[stops.end]
joint = "{}"
{}
"""
ANGLE = 'angular_stiffness = "1000 N m/rad"\nangle = '
PLACE = 'stiffness = "1000 N/mm"\nposition = '


def said(more: str, text: str = IDEAL) -> str:
    remarks = parsed(text + more).remarks()
    return "\n".join((*remarks.warnings, *remarks.notes))


def test_the_slider_crank_itself_is_plausible() -> None:
    for text in (FILE, IDEAL):
        assert parsed(text).remarks().warnings == ()


def test_a_depth_limit_of_ideal_joints_alone_is_reported() -> None:
    limit = '[wear]\ndepth_limit = "5 um"\n'
    assert "wear.depth_limit has no effect" in said(limit)
    assert "wear.depth_limit" not in said(limit, FILE)


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ('[parameters]\nspare = "3 mm"\n', "parameters.spare is used by no value"),
        ('[parameters]\nspare = "3 mm"\nother = "2 * spare"\n', "parameters.other is used by no value"),
        (STOP.format("main", ANGLE + '"30 deg"'), "its drive moves main to 720 deg"),
        (STOP.format("main", ANGLE + '"30 deg"\nside = "below"'), "main starts at 0 deg, inside it"),
        (STOP.format("guide", PLACE + '"-1 mm"'), "guide starts at 0 mm, inside it"),
    ],
)
def test_a_value_that_hardly_belongs_is_reported(more: str, words: str) -> None:
    assert words in said(more)


@pytest.mark.parametrize(
    "more",
    [
        STOP.format("main", ANGLE + '"721 deg"'),
        STOP.format("main", ANGLE + '"-1 deg"\nside = "below"'),
        STOP.format("guide", PLACE + '"1 mm"'),
    ],
)
def test_a_stop_outside_the_motion_is_not_reported(more: str) -> None:
    assert "stop end" not in said(more)


@pytest.mark.parametrize(
    ("period", "words"),
    [
        ("7 ms", "drive motor repeats after 0.012 s: cycles, lives"),
        ("24 ms", "A cycle is run.period: 2 cycles of drive motor"),
        ("12 ms", ""),
    ],
)
def test_a_period_that_contradicts_a_drive_is_reported(period: str, words: str) -> None:
    remarks = parsed(IDEAL).replace({"run.period": period}).remarks()
    assert words == "" or any(words in text for text in (*remarks.warnings, *remarks.notes))
    assert bool(remarks.warnings) == ("lives" in words)


def test_a_body_too_light_for_a_contact_is_reported() -> None:
    remarks = parsed(FILE).replace({"bodies.slider.mass": "1e-9 kg"}).remarks()
    assert "Check bodies.slider.mass and its unit" in "".join(remarks.warnings)
    assert parsed(IDEAL).replace({"bodies.slider.mass": "1e-9 kg"}).remarks().warnings == ()


def test_what_does_nothing_is_reported_or_refused() -> None:
    spring = 'between = ["ground", "rod"]\nfirst_point = "0, 0, 0 mm"\nsecond_point = "9, 9, 0 mm"'
    assert "Spring idle has neither stiffness nor damping" in said(f"\n[springs.idle]\n{spring}")
    load = 'body = "slider"\ndirection = [1, 0, 0]\nforce = "3 N"\nalong = "main"'
    notes = parsed(f"{IDEAL}\n[loads.idle]\n{load}").remarks().notes
    assert any("loads.idle.along has no effect" in note for note in notes)


def test_a_run_says_that_assembly_moved_a_body() -> None:
    case = parsed(IDEAL).replace({"joints.wrist.other_point": "175, 0, 0 mm", "run.analysis": "kinematic"})
    assert "assembly moved slider by 5 mm" in td.simulate(case).attrs["notes"]


@pytest.mark.parametrize(("stiffness", "warns"), [("1e7 N/m", False), ("1e16 N/m", True)])
def test_a_stiffness_is_reported_whose_force_is_the_rounding_of_positions(
    stiffness: str, warns: bool
) -> None:
    ends = 'between = ["ground", "slider"]\nfirst_point = "-1, 0, 0 m"\nsecond_point = "170, 0, 0 mm"'
    told = said(f'[springs.coil]\n{ends}\nstiffness = "{stiffness}"\n')
    assert ("springs.coil.stiffness is a stiffness of 1e+16 N/m: the rounding of positions" in told) == warns


@pytest.mark.parametrize("factor", [1.0, 1e6])
def test_a_beam_of_a_million_times_its_stiffness_is_reported(factor: float) -> None:
    ring = parsed(TEMPLATES["vsv-ring"].text)
    words = " ".join(
        ring.replace({"bodies.lever.beam.young_modulus": f"{110 * factor} GPa"}).remarks().warnings
    )
    assert ("beam.young_modulus is a stiffness of" in words) == (factor > 1.0)
