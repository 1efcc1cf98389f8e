"""What runs of user-defined mechanisms say of their contacts, and the gallery answers its questions."""

from pathlib import Path

import numpy as np
import pytest
from tests.unit.mechanism.test_system import bob

import tribodyn as td
from tribodyn.cases.case import with_entries
from tribodyn.mechanism.descriptor import GALLERY, TEMPLATES
from tribodyn.mechanisms.results import known, summarise
from tribodyn.simulation import check

BRIEF = {"run.duration": "20 ms", "run.output_interval": "5 ms", "solver.rtol": 1e-4}


def test_a_clearance_below_the_roughness_of_bronze_is_said_before_and_after_the_run() -> None:
    case = bob(friction_coefficient=0.1).case()
    bronze = {
        "joints.pivot.clearance.radial": "0.06 um",
        "joints.pivot.clearance.pair": "pin",
        "pairs.pin.surfaces.bushing.material": "bronze-c93200",
    }
    case = with_entries(case, {**bronze, "run.duration": "1 ms"}, "test")
    before = [text for text in check(case) if "pivot:barrel" in text]
    assert any("times the combined roughness" in text for text in before)
    result = td.simulate(case)
    said = " ".join(summarise(result)["warnings"])
    assert "In pivot:barrel this is a press fit: the radial clearance of 0.06 um" in said
    assert "In pivot:barrel the contact pressure reached" in said
    share = float(result["hardness_share"].sel(surface="pivot:barrel"))
    peak = float(result["pressure_peak"].sel(surface="pivot:barrel"))
    # Brinell 65 of C93200, by hand.
    assert share == pytest.approx(peak / (65 * 9.80665e6), rel=1e-9)
    assert share > 1.0 / 3.0


def test_a_joint_is_told_what_the_vane_mechanism_is_told_of_the_same_joint() -> None:
    drawn, vane = (td.simulate(td.load_case(name).replace(BRIEF)) for name in ("vsv-free", "vsv"))
    joint = drawn.sel(surface="trunnion:barrel")
    # Both begin in the same equilibrium; what follows differs by the true face of the collar.
    assert float(joint["grid_force_error"]) == pytest.approx(vane.attrs["grid_force_error"], rel=0.3)
    assert float(joint["hardness_share"]) == pytest.approx(vane.attrs["hardness_share"], rel=0.1)
    assert float(joint["pressure_at_rest"]) == pytest.approx(vane.attrs["pressure_at_rest"], rel=0.1)


def test_a_coarse_grid_is_said_by_the_name_of_the_surface() -> None:
    coarse = bob(nodes_around=12, nodes_along=2).case().replace({"run.duration": "2 ms"})
    said = summarise(td.simulate(coarse))["warnings"]
    (text,) = (text for text in said if text.startswith("In pivot:barrel on the chosen grid"))
    # solver.grid would change nothing where a joint has numbers of its own.
    assert text.endswith("raise joints.pivot.clearance.nodes_around and nodes_along from 12 and 2.")


def test_points_temperatures_and_worn_surfaces_have_their_checks() -> None:
    points = bob(contact="point-johnson")
    points._tables["joints"]["pivot"]["clearance"].pop("axial")
    said = summarise(td.simulate(points.case().replace({"run.duration": "1 ms"})))["warnings"]
    assert any("In pivot:barrel the contact is at a point" in text for text in said)
    warm = {
        "joints.pivot.clearance.temperature.trunnion": "60 degC",
        "surfaces.trunnion.thermal_expansion": "11e-6 1/K",
    }
    notes = check(with_entries(bob(friction_coefficient=0.1).case(), warm, "test"))
    assert any("In pivot at the temperatures of the run the clearance is" in text for text in notes)


def test_the_error_of_the_grid_is_that_of_the_worn_joint() -> None:
    case = bob(friction_coefficient=0.1)
    case._tables |= {
        "run": {"cycles": 1, "period": "5 ms"},
        "wear": {"cycles": 2, "specific_wear_rate": "1e-12 m^2/N"},
    }
    result = td.simulate(case.case())
    assert float(result["wear_depth"].max()) > 0.0
    errors = result["grid_force_error"].values
    assert np.all(np.isfinite(errors))
    assert np.all(errors < 0.1)


@pytest.mark.parametrize(
    "clearance",
    [
        {"width": "20 mm", "height": "20 mm"},
        {"shape": "cylinder", "radius": "10 mm"},
        {"shape": "dovetail", "width": "20 mm", "height": "10 mm", "flank_angle": "55 deg"},
    ],
    ids=["square", "cylinder", "dovetail"],
)
def test_walls_whose_forces_cancel_each_other_have_the_error_of_what_they_carry(
    clearance: dict[str, str],
) -> None:
    # 2 N m on a block of 40 mm are 50 N at each end and none in the joint: the error was over none.
    tilted = td.Mechanism("Tilted block", run={"duration": "50 ms"})
    tilted.body("block", mass="1 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    guide = {"length": "40 mm", "radial": "20 um", "friction_coefficient": 0.1, **clearance}
    along = {"axis": [0, 0, 1], "second_axis": [0, 1, 0], "clearance": guide}
    tilted.prismatic("guide", "ground", "block", point="0, 0, 0 mm", **along)
    tilted.load("couple", body="block", moment="2 N m", direction=[1, 0, 0])
    result = td.simulate(tilted)
    assert np.linalg.norm(result["contact_force"].values[-1]) < 1e-6
    assert np.all(result["grid_force_error"].values < 1e-3)
    assert not any("off by" in text for text in summarise(result)["warnings"])


def test_the_gallery_has_twelve_mechanisms() -> None:
    assert len(GALLERY) == 12


@pytest.mark.parametrize("name", TEMPLATES)
def test_a_template_says_what_it_is(name: str) -> None:
    assert TEMPLATES[name].title
    assert len(TEMPLATES[name].description.split()) > 5


@pytest.mark.parametrize(
    "name",
    [
        # The last two are in tests/golden, too.
        pytest.param(name, marks=pytest.mark.long)
        if name in ("four-bar-wear", "slider-crank-oil", "vsv-free")
        else name
        for name in GALLERY
    ],
)
def test_a_mechanism_of_the_gallery_answers_its_question(name: str, tmp_path: Path) -> None:
    path = tmp_path / f"{name}.toml"
    path.write_text(GALLERY[name].text, encoding="utf-8")
    result = td.simulate(path)
    summary = summarise(result)
    assert result.attrs["failure"] == ""
    assert not summary["doubtful"]
    assert GALLERY[name].question.endswith("?")
    assert 0 < len(GALLERY[name].results) == len(known(GALLERY[name].results, "mechanism"))
    assert set(GALLERY[name].results) <= set(summary)
