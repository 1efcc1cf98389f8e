"""Form and temperatures of any joint that can have them: those of the vane mechanism."""

from collections.abc import Mapping

import numpy as np
import pytest

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.joints.clearances import Clearance, places
from tribodyn.mechanism.assembly.clearance_surfaces import clearances_of
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanisms.bushing import bushing_of

EXPANSION = {
    "surfaces.trunnion.thermal_expansion": "12e-6 1/K",
    "surfaces.bushing.thermal_expansion": "20e-6 1/K",
}
FORMS: dict[str, dict[str, object]] = {
    "crown": {"form.crown": "3 um"},
    "chamfer": {"form.chamfer_length": "0.5 mm", "form.chamfer_depth": "20 um"},
    "bore": {
        "form.bushing.angles": "0, 90, 180, 270 deg",
        "form.bushing.positions": "-10.2, 10.2 mm",
        "form.bushing.values": "0, 1, 4, 3, 0, 2, 4, 1 um",
    },
    "profile": {"form.trunnion.positions": "-10.2, 0, 10.2 mm", "form.trunnion.values": "0, 2, -1 um"},
    "warm": {"temperature.trunnion": "150 degC", "temperature.bushing": "200 degC"},
    "bonded": {
        "liner.thickness": "1 mm",
        "temperature.bushing": "120 degC",
        "temperature.casing": "100 degC",
        "temperature.fit": "bonded",
        "temperature.casing_expansion": "11e-6 1/K",
    },
}


def clearance_of(case: object, joint: str = "trunnion") -> Clearance:
    assert isinstance(case, MechanismCase)
    return clearances_of(case)[joint]


def free(changes: Mapping[str, object], case: str = "vsv-free", joint: str = "trunnion") -> object:
    own = {f"joints.{joint}.clearance.{key}": value for key, value in changes.items()}
    return td.load_case(case).replace({**EXPANSION, **own})


@pytest.mark.parametrize("changes", [*FORMS.values(), {k: v for f in FORMS.values() for k, v in f.items()}])
def test_they_are_those_of_the_vane_mechanism(changes: dict[str, object]) -> None:
    prefix = {key: key if key.startswith("temperature") else f"joint.{key}" for key in changes}
    vane = td.load_case("vsv").replace({**EXPANSION, **{prefix[k]: v for k, v in changes.items()}})
    wanted, found = bushing_of(vane), clearance_of(free(changes))
    for own, other in zip(found.table, wanted.table, strict=True):
        np.testing.assert_array_equal(own, other)
    barrel = places([found])[0].surface
    gap = wanted.geometry.clearance + wanted.form_gap
    assert gap.max() - gap.min() > 0.0 or "form" not in next(iter(changes))
    # Sums in another order: rounding.
    np.testing.assert_allclose(barrel.gap.reshape(gap.shape), gap, rtol=1e-14)
    np.testing.assert_array_equal(barrel.axes["z"], wanted.z)
    area = np.repeat(wanted.node_area, wanted.grid.theta)
    np.testing.assert_allclose(barrel.area, area, rtol=1e-14)
    radius = np.linalg.norm(barrel.position[:, :2], axis=1)
    np.testing.assert_allclose(radius, wanted.geometry.radius, rtol=1e-14)


def test_a_map_from_a_file_is_that_map(tmp_path) -> None:
    text = "angle [deg], -11 mm [um], 11 mm [um]\n0, 0, 1\n90, 4, 3\n180, 0, 2\n270, 4, 1\n"
    (tmp_path / "bore.csv").write_text(text)
    text = td.load_case("vsv-free").to_toml()
    (tmp_path / "case.toml").write_text(
        f'{text}\n[joints.trunnion.clearance.form.bushing]\nmap = "bore.csv"\n', encoding="utf-8"
    )
    read = td.load_case(tmp_path / "case.toml")
    again = FORMS["bore"] | {"form.bushing.positions": "-11, 11 mm"}
    for case in (read, read.replace({"title": "another"})):
        found, wanted = (places([clearance_of(one)])[0].surface for one in (case, free(again)))
        np.testing.assert_allclose(found.gap, wanted.gap, rtol=1e-12)


def test_flanges_go_apart_with_the_shaft_and_ends_of_the_bore_with_the_bushing() -> None:
    warm = clearance_of(free(FORMS["warm"])).shape
    assert warm.axial_upper == 7e-6  # a single face: the shaft stands where it is drawn
    warm = clearance_of(free(FORMS["warm"] | {"axial_lower": "93 um"})).shape
    # 20 mm of bushing at 200 °C, 20.1 mm of shaft at 150 °C; shared as drawn.
    play = 20.1e-3 * (1.0 + 12e-6 * 130.0) - 20e-3 * (1.0 + 20e-6 * 180.0)
    assert warm.axial_upper == pytest.approx(0.07 * play, rel=1e-9)
    assert warm.axial_lower == pytest.approx(0.93 * play, rel=1e-9)


def test_a_ball_and_its_race_grow() -> None:
    changes = {"temperature.trunnion": "120 degC"}
    cold, warm = (
        clearance_of(free(given, "vsv-joints", "ring-ball"), "ring-ball").shape for given in ({}, changes)
    )
    assert warm.radius == pytest.approx(cold.radius * (1.0 + 1.2e-3), rel=1e-12)
    assert warm.clearance == pytest.approx(cold.clearance - 1.2e-3 * cold.radius, rel=1e-9)


@pytest.mark.parametrize(
    ("case", "joint", "changes", "words"),
    [
        ("vsv-joints", "ring-ball", FORMS["crown"], "a shaft in a bore, not of the shape sphere"),
        ("vsv-joints", "pin", FORMS["crown"], "a shaft in a bore, not of the shape ball"),
        ("vsv-joints", "ring-ball", {"temperature.fit": "bonded"}, "bonded sleeve"),
        ("vsv-free", "trunnion", {"form.chamfer_length": "1 mm"}, "both or neither"),
        ("vsv-free", "trunnion", FORMS["chamfer"] | {"nodes_along": 4}, "points of their own"),
        ("vsv-free", "trunnion", FORMS["crown"] | {"contact": "point-johnson"}, "no form"),
        ("vsv-free", "trunnion", {"temperature.trunnion": "900 degC"}, "radial: the joint would seize"),
        (
            "vsv-free",
            "trunnion",
            {"axial_lower": "7 um", "temperature.bushing": "200 degC"},
            "temperature: the joint would seize along its axis: more than 72 um of play",
        ),
    ],
)
def test_what_cannot_be_is_refused_by_its_key(case, joint, changes, words):
    with pytest.raises(InputError, match=words) as caught:
        places([clearance_of(free(changes, case, joint), joint)])
    assert f"joints.{joint}." in str(caught.value) or "grid" in str(caught.value)


def test_an_expansion_that_is_not_known_is_asked_for() -> None:
    case = td.load_case("vsv-free").replace({"joints.trunnion.clearance.temperature.bushing": "90 degC"})
    with pytest.raises(InputError, match=r"surfaces\.bushing\.thermal_expansion: needed"):
        clearance_of(case)
