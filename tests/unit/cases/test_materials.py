"""The library of materials, and what a case takes from it."""

import pytest

import tribodyn as td
from tribodyn.cases.case import Case, with_entries
from tribodyn.cases.materials import MATERIALS, OF_PAIR, OF_SURFACE, wear_scatter
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import parse_case

LINER = {"surfaces.bushing.material": "ptfe-liner"}
BRONZE = {"surfaces.bushing.material": "bronze-c93200"}


@pytest.mark.parametrize("name", MATERIALS)
def test_every_property_has_a_source_and_could_be_one(name: str) -> None:
    material = td.materials[name]
    assert material.title
    for key, known in material.properties.items():
        assert key in OF_SURFACE | OF_PAIR
        assert known.source
        assert known.validity
        assert len(known.values) == max(1, len(known.temperatures))
        assert list(known.temperatures) == sorted(known.temperatures)
    # Bounds that no solid of a bearing leaves: a slip of a power of ten shows.
    bounds = {
        "poisson_ratio": (0.2, 0.5),
        "hardness": (1e7, 1e10),
        "thermal_expansion": (5e-6, 2e-4),
        "loss_factor": (1e-4, 1.0),
        "friction_coefficient": (0.01, 1.0),
        "specific_wear_rate": (1e-18, 1e-12),
        "wear_scatter": (0.0, 100.0),
    }
    for key, known in material.properties.items():
        least, largest = bounds.get(key, (1e8, 3e11))
        assert all(least < known.at(warmth) < largest for warmth in (200.0, 293.15, 900.0))


def test_a_material_gives_all_that_it_has() -> None:
    case = td.load_case("vsv").replace(LINER | {"surfaces.trunnion.material": "titanium-6al-4v"})
    assert case.at("surfaces.bushing.young_modulus") == 3.1e9
    assert case.at("surfaces.trunnion.young_modulus") == 113.8e9
    assert case.at("joint.friction_coefficient") == pytest.approx(0.06, rel=1e-12)
    # The geometric mean of 0.07e-6 and 5.52e-6 mm³/(N m), by hand.
    assert case.at("wear.specific_wear_rate") == pytest.approx(0.6216e-15, rel=1e-4)
    assert case.replace({"surfaces.bushing.material": "bronze-c93200"}).at("surfaces.bushing.hardness") == (
        pytest.approx(65 * 9.80665e6, rel=1e-12)
    )


def test_what_no_source_gives_is_said_to_be_unknown() -> None:
    bronze = td.materials["bronze-c93200"]
    assert bronze.unknown == ("friction_coefficient", "specific_wear_rate")
    assert str(bronze).endswith("\n  not known: friction_coefficient, specific_wear_rate")


def test_what_it_does_not_have_stays_and_is_told() -> None:
    case = td.load_case("vsv").replace(BRONZE)
    assert case.at("wear.specific_wear_rate") == 1.1e-15
    told = " ".join(case.remarks().warnings)
    assert "wear.specific_wear_rate stays at 1.1e-15 m^2/N" in told
    assert "hardness" not in told
    given = case.replace({"wear.specific_wear_rate": "3e-14 m^2/N", "joint.friction_coefficient": "0.2"})
    assert given.remarks().warnings == ()


def test_a_value_beside_it_goes_first_and_is_told() -> None:
    case = td.load_case("vsv").replace(BRONZE | {"surfaces.bushing.hardness": "90 HB"})
    assert case.at("surfaces.bushing.hardness") == pytest.approx(90 * 9.80665e6)
    told = " ".join(case.remarks().notes)
    assert "surfaces.bushing.hardness = 882.6 MPa goes before 637.4 MPa of bronze-c93200" in told


def test_a_stored_case_says_nothing_new() -> None:
    case = td.load_case("vsv").replace(LINER)
    again = parse_case(case.to_toml(), "stored")
    assert again.remarks() == case.remarks()
    assert all("goes before" not in note for note in case.remarks().notes)


def test_a_material_is_as_warm_as_its_part() -> None:
    wide = td.load_case("vsv").replace({"joint.clearance": "200 um"})
    case = wide.replace({"surfaces.trunnion.material": "inconel-718", "temperature.trunnion": "427 degC"})
    assert case.at("surfaces.trunnion.young_modulus") == 186e9
    assert case.at("surfaces.trunnion.thermal_expansion") == pytest.approx(14.2e-6, rel=1e-12)
    table = {
        "temperature.properties.temperatures": "20, 400 degC",
        "temperature.properties.young_modulus": "7, 5 GPa",
        "temperature.bushing": "400 degC",
    }
    assert case.replace(BRONZE | table).at("surfaces.bushing.young_modulus") == 5e9
    far = wide.replace(BRONZE | {"temperature.bushing": "300 degC"})
    assert "surfaces.bushing.hardness of bronze-c93200 is known" in " ".join(far.remarks().warnings)


def test_pairs_of_a_mechanism_have_materials_of_their_own() -> None:
    pair = '[pairs.pin.surfaces.bushing]\nmaterial = "bronze-c95400"\n'
    case = parse_case(f"{td.load_case('slider-crank').to_toml()}\n{pair}", "test")
    assert case.at("pairs.pin.surfaces.bushing.young_modulus") == 110e9
    assert case.at("surfaces.bushing.young_modulus") == 7.17e9
    told = case.replace({"pairs.pin.surfaces.bushing.hardness": "1 GPa"}).remarks().notes
    assert any("pairs.pin.surfaces.bushing.hardness = 1000 MPa goes before" in text for text in told)


def test_an_unknown_material_names_the_nearest() -> None:
    with pytest.raises(InputError, match='did you mean "ptfe-liner"'):
        td.load_case("vsv").replace({"surfaces.bushing.material": "ptfe-lner"})


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"surfaces.bushing.roughness": "2 um"}, "asperities are still those"),
        ({"surfaces.bushing.young_modulus": "3 GPa"}, "wears as that of the paper"),
    ],
)
def test_surfaces_that_leave_the_paper_behind_are_told(changes: dict[str, str], words: str) -> None:
    case = td.load_case("vsv")
    assert case.remarks().warnings == ()
    assert any(words in text for text in case.replace(changes).remarks().warnings)


PTFE = {"surfaces.bushing.material": "ptfe"}


def with_pair(pair: dict[str, str]) -> Case:
    """Return the built-in slider-crank whose wrist has a pair of its own."""
    keys = {f"pairs.pin.{path}": value for path, value in pair.items()}
    return with_entries(td.load_case("slider-crank"), {**keys, "joints.wrist.clearance.pair": "pin"}, "test")


def test_friction_and_wear_of_a_pair_are_those_of_its_material() -> None:
    case = with_pair(PTFE)
    # The middle of 0.008 and 0.28, and the geometric mean of 403e-8 and 5040e-8 mm³/(N m), by hand.
    assert case.at("pairs.pin.friction_coefficient") == pytest.approx(0.144, rel=1e-12)
    assert case.at("joints.wrist.clearance.friction_coefficient") == pytest.approx(0.144, rel=1e-12)
    assert case.at("pairs.pin.wear.specific_wear_rate") == pytest.approx(1.4252e-14, rel=1e-4)
    assert parse_case(case.to_toml(), "stored").remarks() == case.remarks()
    told = " ".join(case.remarks().notes)
    for key in ("pairs.pin.friction_coefficient", "pairs.pin.wear.specific_wear_rate"):
        assert f"{key} = " in told
    assert told.count("is the middle of a range that ptfe has") >= 2


def test_what_a_pair_or_joint_is_given_goes_before_its_material_and_is_said() -> None:
    case = with_pair(PTFE).replace({"joints.wrist.clearance.friction_coefficient": 0.3})
    assert case.at("joints.wrist.clearance.friction_coefficient") == 0.3
    told = " ".join(case.remarks().notes)
    assert "joints.wrist.clearance.friction_coefficient = 0.3 goes before 0.144 of ptfe" in told
    given = with_pair({"friction_coefficient": "0.2", **PTFE})
    assert given.at("joints.wrist.clearance.friction_coefficient") == 0.2
    assert "pairs.pin.friction_coefficient = 0.2 goes before" in " ".join(given.remarks().notes)


def test_what_the_library_does_not_know_of_the_material_of_a_pair_is_said() -> None:
    told = " ".join(with_pair(BRONZE).remarks().warnings)
    assert "no specific_wear_rate of bronze-c93200: pairs.pin.wear.specific_wear_rate stays at" in told
    assert "no friction_coefficient of bronze-c93200: pairs.pin.friction_coefficient stays at 0.1" in told


def test_a_pair_without_a_material_has_friction_and_wear_of_the_case() -> None:
    case = with_pair({"contact.law": "gw", "contact.restitution": "0.8"})
    assert case.replace({"wear.specific_wear_rate": "5e-15 m^2/N"}).at(
        "pairs.pin.wear.specific_wear_rate"
    ) == pytest.approx(5e-15)
    rubbed = case.replace({"friction_coefficient": 0.2})
    assert rubbed.at("joints.wrist.clearance.friction_coefficient") == 0.2
    assert case.at("joints.wrist.clearance.friction_coefficient") == 0.1


def test_surfaces_of_the_case_give_their_friction_to_joints_without_a_pair() -> None:
    case = td.load_case("slider-crank").replace(LINER)
    assert case.at("friction_coefficient") == pytest.approx(0.06, rel=1e-12)
    assert case.at("joints.wrist.clearance.friction_coefficient") == pytest.approx(0.06, rel=1e-12)
    assert case.at("wear.specific_wear_rate") == pytest.approx(0.6216e-15, rel=1e-4)


def test_another_bushing_of_a_pair_wears_as_that_of_the_paper_and_says_so() -> None:
    case = with_pair({"surfaces.bushing.hardness": "800 MPa"})
    assert "give pairs.pin.wear.specific_wear_rate" in " ".join(case.remarks().warnings)


@pytest.mark.parametrize(
    ("given", "material", "rate", "ends"),
    [
        (None, None, 1.1e-15, (0.0976, 8.880)),
        (2e-15, None, 2e-15, (0.0976, 1.73)),
        (None, "ptfe-liner", MATERIALS["ptfe-liner"].properties["specific_wear_rate"].at(), (0.0976, 8.880)),
        (2e-15, "ptfe-liner", 2e-15, (0.0976, 1.73)),
        (None, "polyimide-cheng", 1.1e-15, (0.0976, 1.73)),
        (None, "bronze-c93200", 1.1e-15, (0.0976, 1.73)),
    ],
)
def test_wear_has_the_scatter_of_equal_parts_and_the_range_of_published_rates(given, material, rate, ends):
    assert wear_scatter(given, material, rate) == pytest.approx(ends, rel=1e-3)


def test_keys_go_before_the_scatter_of_the_material_and_those_of_a_pair_before_both() -> None:
    case = td.load_case("slider-crank")
    assert case.wear_scatter()["wrist"] == pytest.approx((0.0976, 8.880), rel=1e-3)
    assert case.replace({"wear.scatter": "[0.5, 2]"}).wear_scatter()["wrist"] == (0.5, 2.0)
    pair = with_pair({"wear.scatter": "[0.5, 2]"})
    assert pair.wear_scatter() == {"": (0.5, 2.0), "wrist": (0.5, 2.0)}
    repeated = with_pair({"wear.repeats": "[1, 1, 1]"})
    assert repeated.wear_scatter()["wrist"] == (1 / 1.5, 1.5)


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("scatter", "[2, 3]"),
        ("scatter", "[0, 3]"),
        ("scatter", "[1]"),
        ("repeats", "[1]"),
        ("repeats", "[0, 1]"),
    ],
)
def test_a_scatter_that_is_none_is_refused(key: str, value: str) -> None:
    with pytest.raises(InputError, match=rf"wear\.{key}"):
        td.load_case("vsv").replace({f"wear.{key}": value})
    with pytest.raises(InputError, match=rf"pairs\.pin\.wear\.{key}"):
        with_pair({f"wear.{key}": value})


@pytest.mark.parametrize("name", ["slider-crank", "vsv"])
def test_a_case_that_is_read_back_has_the_same_interval(name: str) -> None:
    case = td.load_case(name)
    assert parse_case(case.to_toml(), "test").wear_scatter() == case.wear_scatter()


def test_either_scatter_or_repeats() -> None:
    with pytest.raises(InputError, match="either"):
        td.load_case("vsv").replace({"wear.scatter": "[0.5, 2]", "wear.repeats": "[1, 2]"})
