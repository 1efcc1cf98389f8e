"""Patterns: copies of bodies with all that names them, values that differ, single copies, refusals."""

from pathlib import Path
from typing import Final

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import tribodyn as td
from tribodyn.cases.case import Case, with_entries
from tribodyn.core.errors import InputError
from tribodyn.mechanism.descriptor import TEMPLATES
from tribodyn.mechanism.results.copies import why, worst
from tribodyn.mechanisms.catalogue import MECHANISMS, parse_case

RING: Final = """
case = "mechanism"
run.duration = "1 s"
run.analysis = "static"
run.positions = 12
[bodies.ring]
mass = "1 kg"
centre = "0, 40, 0 mm"
inertia = "3e-2, 5e-2, 3e-2 kg m^2"
[joints.guide]
type = "cylindrical"
between = ["ground", "ring"]
point = "0, 40, 0 mm"
axis = [0, 1, 0]
[drives.actuator]
joint = "guide"
angle = { value = "0 deg", swing = "-6 deg", angular_frequency = "6.2 rad/s" }
[pattern.vanes]
count = 3
bodies = ["vane"]
about = { axis = [0, 1, 0] }
[bodies.vane]
mass = "0.25 kg"
centre = "0, 0, 320 mm"
inertia = "5e-4, 6e-4, 1e-3 kg m^2"
[joints.pin]
type = "pin-slot"
between = ["ring", "vane"]
point = "24, 40, 400 mm"
axis = [0.06, 0, 1]
[joints.trunnion]
type = "revolute"
between = ["ground", "vane"]
point = "0, 0, 390 mm"
axis = [0, 0, 1]
[joints.trunnion.clearance]
radius = "6 mm"
radial = "20 um"
length = "20 mm"
axial = "50 um"
[loads.air]
body = "vane"
frame = "motion"
direction = [0, 0, 1]
moment = "0.84 N m"
[outputs.vane]
quantity = "angle"
body = "vane"
along = [0, 0, 1]
"""
RADIAL: Final = "joints.trunnion.clearance.radial"


@pytest.fixture(scope="module")
def ring() -> Case:
    return parse_case(RING, "test")


def radials(case: Case) -> list[float]:
    """Return the radial clearances of all trunnions [m]."""
    return [case.at(f"joints.trunnion[{k}].clearance.radial") for k in (1, 2, 3)]


def test_what_names_a_repeated_body_is_repeated_and_moved_with_it(ring: Case) -> None:
    assert list(ring.bodies) == ["ring", "vane[1]", "vane[2]", "vane[3]"]
    assert [*ring.joints] == ["guide", *(f"{name}[{k}]" for name in ("pin", "trunnion") for k in (1, 2, 3))]
    assert ring.joints["pin[2]"].between == ("ring", "vane[2]")
    turned = 0.32 * np.array([np.sin(2.0 * np.pi / 3.0), 0.0, np.cos(2.0 * np.pi / 3.0)])
    assert ring.bodies["vane[2]"].centre == pytest.approx(turned)
    assert ring.loads["air[3]"].direction == pytest.approx((np.sin(4.0 * np.pi / 3.0), 0.0, -0.5))
    assert ring.bodies["vane[1]"].centre == (0.0, 0.0, 0.32)


def test_keys_of_one_copy_go_before_those_of_all(ring: Case) -> None:
    found = ring.replace({RADIAL: "30 um", "joints.trunnion[2].clearance.radial": "40 um"})
    assert radials(found) == [3e-5, 4e-5, 3e-5]
    assert ring.at(RADIAL) == 2e-5


def test_what_all_copies_share_has_a_value_where_only_copies_hold_it(ring: Case) -> None:
    """Slopes, tolerances and scatter start from it."""
    assert ring.at("joints.trunnion.tilt.x") == ring.at("joints.pin.deviation.y") == 0.0
    assert ring.at("joints.pin.point.x") == 0.024
    assert ring.at("joints.pin.other_point") is None
    assert ring.replace({"joints.trunnion.tilt.x": "1 mrad"}).at("joints.trunnion[1].tilt") == (
        1e-3,
        0.0,
        0.0,
    )


def test_values_of_copies_come_from_lists_files_and_distributions(ring: Case, tmp_path: Path) -> None:
    scatter = {"scatter.play.pattern": "vanes", "scatter.play.key": RADIAL}
    listed = with_entries(ring, scatter | {"scatter.play.values": ["20 um", "25 um", "30 um"]}, "test")
    assert radials(listed) == [2e-5, 2.5e-5, 3e-5]
    (tmp_path / "vanes.csv").write_text("radius [mm], radial [um]\n6, 21\n6, 22\n6, 23\n")
    file = {"scatter.play.csv": str(tmp_path / "vanes.csv"), "scatter.play.column": "radial"}
    assert radials(with_entries(ring, scatter | file, "test")) == pytest.approx([21e-6, 22e-6, 23e-6])
    law = {"scatter.play.distribution": "normal", "scatter.play.arguments": ["0 um", "2 um"]}
    drawn = with_entries(ring, scatter | law | {"scatter.play.added": True}, "test")
    parts = np.random.default_rng(1).random(3)
    assert np.argsort(radials(drawn)).tolist() == np.argsort(parts).tolist()
    assert radials(drawn) == radials(with_entries(ring, scatter | law | {"scatter.play.added": True}, "test"))
    moved = {
        "scatter.pin.pattern": "vanes",
        "scatter.pin.key": "joints.pin.point.y",
        "scatter.pin.added": True,
    }
    found = with_entries(ring, moved | {"scatter.pin.values": ["0 mm", "1 mm", "0 mm"]}, "test")
    assert found.at("joints.pin[2].point")[1] == pytest.approx(0.041)


def test_a_pattern_along_a_line_repeats_springs_and_elements() -> None:
    text = """
case = "mechanism"
run.duration = "1 s"
[pattern.row]
count = 4
bodies = ["mass"]
step = "0, 20, 0 mm"
[bodies.mass]
mass = "1 kg"
centre = "10, 0, 0 mm"
inertia = "1e-4, 1e-4, 1e-4 kg m^2"
[joints.slide]
type = "prismatic"
between = ["ground", "mass"]
point = "10, 0, 0 mm"
axis = [1, 0, 0]
[springs.coil]
between = ["ground", "mass"]
first_point = "0, 0, 0 mm"
second_point = "10, 0, 0 mm"
stiffness = "1 N/mm"
[nonlinear_springs.pad]
between = ["ground", "mass"]
first_point = "0, 0, 0 mm"
second_point = "10, 0, 0 mm"
force = { positions = "-1, 1 mm", values = "1, -1 N" }
"""
    found = parse_case(text, "test")
    assert found.springs["coil[4]"].second_point == pytest.approx((0.01, 0.06, 0.0))
    assert list(found.nonlinear_springs) == ["pad[1]", "pad[2]", "pad[3]", "pad[4]"]


def test_a_written_case_reads_back(ring: Case) -> None:
    written = ring.to_toml()
    assert parse_case(written, "test") == ring
    with pytest.raises(InputError, match="written with its 3 copies"):
        parse_case(written, "test").replace({"pattern.vanes.count": 9})


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"pattern.vanes.about.step": "360 deg"}, "overlaps itself: copies 1 and 2 are at one place"),
        ({"pattern.vanes.bodies": ["wane"]}, '"wane" is no body.*did you mean'),
        (
            {"pattern.more.count": 2, "pattern.more.bodies": ["vane"], "pattern.more.step": "1, 0, 0 mm"},
            "overlap: both repeat vane",
        ),
        (
            {
                "scatter.a.pattern": "vanes",
                "scatter.a.key": "joints.guide.point.x",
                "scatter.a.values": ["1 mm"],
            },
            "is no key of what the pattern vanes repeats",
        ),
        (
            {"scatter.a.pattern": "vanes", "scatter.a.key": RADIAL, "scatter.a.values": ["1 um"]},
            "the pattern has 3 copies, and here are 1 values",
        ),
    ],
)
def test_a_wrong_pattern_is_refused_in_one_sentence(ring, changes, words):
    with pytest.raises(InputError, match=words) as caught:
        with_entries(ring, changes, "test")
    assert "\n" not in str(caught.value)


def test_keys_that_scatter_do_not_go_together(ring: Case) -> None:
    law = {"pattern": "vanes", "distribution": "normal", "arguments": ["0 um", "10 um"], "added": True}
    keys = {"play": RADIAL, "hole": "joints.pin.deviation.x", "bore": "joints.trunnion.deviation.y"}
    entries = {f"scatter.{name}.{key}": value for name in keys for key, value in law.items()}
    found = with_entries(ring, entries | {f"scatter.{n}.key": key for n, key in keys.items()}, "test")
    off = [np.array(radials(found)) - 20e-6]
    for joint, axis in (("pin", 0), ("trunnion", 1)):
        ways = [found.at(f"joints.{joint}[{k}].deviation") for k in (1, 2, 3)]
        as_first = [found.pattern["vanes"].as_first(k, way) for k, way in enumerate(ways, 1)]
        # A way turns with its copy, and is as long.
        assert np.delete(as_first, axis, axis=1) == pytest.approx(0.0, abs=1e-18)
        off.append(np.array(as_first)[:, axis])
    assert np.abs(np.corrcoef(off)[np.triu_indices(3, 1)]).max() < 0.9


def test_a_tilt_turns_with_its_copy_and_says_which_copy_is_the_worst(ring: Case) -> None:
    tilt = {"scatter.tilt.pattern": "vanes", "scatter.tilt.key": "joints.trunnion.tilt.x"}
    given = ["0.001 rad", "0 rad", "-0.002 rad"]
    found = with_entries(ring, tilt | {"scatter.tilt.values": given}, "test")
    turned = Rotation.from_rotvec([[0.0, 2.0 * np.pi * k / 3.0, 0.0] for k in range(3)])
    expected = turned.apply(np.outer([0.001, 0.0, -0.002], [1.0, 0.0, 0.0]))
    tilts = [found.at(f"joints.trunnion[{k}].tilt") for k in (1, 2, 3)]
    np.testing.assert_allclose(tilts, expected, atol=1e-18)
    # Errors that follow the key in a line, at two times.
    [sentence] = why(found, np.array([0.0, 0.01]), np.outer([1.0, 2.0], [1e-3, 0.0, -2e-3]))
    assert sentence.startswith("vane[3] is the copy furthest from the mean: 100% of that by ")
    assert "by joints.trunnion.tilt.x, -1.3 standard deviations off" in sentence


def test_components_of_copies_turn_as_their_vectors_do(ring: Case) -> None:
    """Those of ways and directions do, and moments of inertia about axes of the body do not."""
    drawn = {
        "joints.trunnion.tilt.x": np.array([[1e-3, 2e-3, 3e-3]]),
        "bodies.vane.inertia.x": np.array([[1e-4, 2e-4, 3e-4]]),
        "bodies.vane.mass": np.array([[0.1, 0.2, 0.3]]),
    }
    found = ring.pattern["vanes"].of_copies(drawn, ring)
    whole = 2.0 * np.pi / 3.0
    for axis, share in (("x", np.cos(whole)), ("y", 0.0), ("z", -np.sin(whole))):
        assert found[f"joints.trunnion[2].tilt.{axis}"] == pytest.approx(2e-3 * share, abs=1e-18)
    assert [found[f"bodies.vane[3].inertia.{axis}"][0] for axis in "xyz"] == [3e-4, 6e-4, 1e-3]
    assert found["bodies.vane[2].mass"].tolist() == [0.2]


def test_a_hole_off_its_place_is_an_error_at_rest_too(ring: Case) -> None:
    error = td.simulate(ring)["output_error"].values
    found = td.simulate(ring.replace({"joints.pin[1].deviation": "10, 0, 0 um"}))
    moved = error - found["output_error"].values
    # Between the turn of a lever (24, 40) mm with a hole that gives way along it, and with one that does not.
    assert 10e-6 * 40e-3 / (24e-3**2 + 40e-3**2) < np.mean(moved[:, 0]) < 10e-6 / 40e-3
    assert np.max(np.abs(moved[:, 1:])) < 0.05 * np.min(moved[:, 0])


def test_equal_copies_have_equal_errors_and_a_looser_one_its_own(ring: Case) -> None:
    error = td.simulate(ring)["output_error"].values
    assert np.max(np.ptp(error, axis=1)) < 1e-4 * np.max(np.abs(error))
    loose = td.simulate(ring.replace({"joints.trunnion[2].clearance.radial": "40 um"}))["output_error"].values
    # The ring is free along its axis and gives way a little.
    others = np.abs(loose[:, [0, 2]] - error[:, [0, 2]])
    assert np.max(others) < 2e-2 * np.max(np.abs(error))
    assert np.max(np.abs(loose[:, 1])) > 1.5 * np.max(np.abs(error[:, 1]))


def test_a_second_link_spares_the_first_actuator_its_force() -> None:
    text = TEMPLATES["vsv-ring"].text.replace('elastic = "beam"\n', "")
    link = text[text.index("[bodies.actuator]") : text.index("[bodies.vane]")]
    for old, new in (
        *(("actuator", "second"), ("cylinder", "other"), ("piston", "push"), ("drag-link", "drag-link-2")),
        *((" 420 mm", " -420 mm"), ('"150, ', '"-150, ')),
    ):
        link = link.replace(old, new)
    motion = next(line for line in link.splitlines() if line.startswith("position"))
    both = text + "\n" + link.replace(motion, 'force = { value = "20 N" }')
    few = {"run.cycles": 0.1, "pattern.vanes.count": 2, "solver.rtol": 1e-5}
    alone, shared = (td.simulate(parse_case(one, "test").replace(few)) for one in (text, both))
    pulls = (one["drive_force"].sel(joint="cylinder") for one in (alone, shared))
    pull, spared = (np.interp([0.1, 0.3, 0.5], one["time"].values, one.values) for one in pulls)
    np.testing.assert_allclose(np.abs(pull - spared), 20.0, rtol=0.01)
    with pytest.raises(InputError, match="drive one freedom"):
        td.simulate(parse_case(text + "\n" + link, "test").replace(few))


@pytest.mark.parametrize(
    ("drive", "power"),
    [('position = { value = "0 mm", swing = "-40 mm", angular_frequency = "W rad/s" }', 1.0),
     ('force = { value = "0 N", amplitude = "F N", angular_frequency = "1000 rad/s" }', 0.5)],
)  # fmt: skip
def test_velocities_are_resolved_by_what_drives_give(drive: str, power: float) -> None:
    text = TEMPLATES["vsv-ring"].text
    motion = next(line for line in text.splitlines() if line.startswith("position"))

    def tolerances(factor: float, duration: float) -> np.ndarray:
        given = drive.replace("W", f"{factor}").replace("F", f"{1e3 * factor}")
        changed = text.replace(motion, given).replace("cycles = 1", f'duration = "{duration} s"')
        few = parse_case(changed, "test").replace({"pattern.vanes.count": 2, "run.start": "centred"})
        return MECHANISMS["mechanism"].system(few).problem(duration).atol.reshape(-1, 13)[0, 7:]

    plain = tolerances(1.0, 20.0)
    np.testing.assert_allclose(tolerances(1.0, 40.0), plain, rtol=0.01)
    np.testing.assert_allclose(tolerances(4.0, 20.0), 4.0**power * plain, rtol=0.01)


def test_a_written_case_with_elastic_copies_reads_back() -> None:
    """Copies are written as their nodes; figures and reports of a result read the case again."""
    ring = parse_case(TEMPLATES["vsv-ring"].text, "test")
    assert parse_case(ring.to_toml(), "test") == ring


@pytest.mark.parametrize("points", ["0, 0, 400 mm", "0, 0, 400, 0, 0, 400 mm"])
def test_a_repeated_beam_without_a_line_is_refused_at_the_key_that_was_written(points: str) -> None:
    case = parse_case(TEMPLATES["vsv-ring"].text, "test")
    with pytest.raises(InputError, match=r"bodies\.lever\.beam\.points"):
        with_entries(case, {"bodies.lever.beam.points": points}, "test")


def test_the_worst_copy_is_so_over_time_and_not_over_rows():
    time, error = np.append(np.linspace(0.0, 0.01, 100), [0.0101, 1.0]), np.zeros((102, 3))
    error[:100, 0], error[100:, 2] = 1.0, 0.5
    assert worst(error, time) == 2
