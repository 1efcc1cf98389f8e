"""What is said of values of a mechanism that hardly belong together, in every run and check."""

import pytest
from tests.unit.mechanism.slider_crank import FILE, IDEAL, parsed

import tribodyn as td

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
