import pytest

import tribodyn as td
from tribodyn.core.errors import InputError

EXPANSIONS = {
    "surfaces.trunnion.thermal_expansion": "12e-6 1/K",
    "surfaces.bushing.thermal_expansion": "50e-6 1/K",
}
HOT = {"temperature.trunnion": "300 degC", "temperature.bushing": "300 degC"}
WARMING = {
    "temperature.over_time.bushing.times": "0, 2 s",
    "temperature.over_time.bushing.values": "20, 60 degC",
}
TABLE = {
    "temperature.properties.temperatures": "20, 200, 400 degC",
    "temperature.properties.young_modulus": "7, 5, 3 GPa",
    "temperature.properties.specific_wear_rate": "1e-15, 2e-15, 6e-15 m^2/N",
}


def refusal(changes: dict[str, object]) -> InputError:
    """Return what is said when the case is read, long before it runs."""
    with pytest.raises(InputError) as caught:
        td.load_case("vsv").replace(changes)
    return caught.value


def test_temperatures_are_read_in_degrees_and_kelvin() -> None:
    case = td.load_case("vsv").replace(EXPANSIONS | {"temperature.bushing": "300 degC"})
    assert case.temperature.bushing == 573.15
    assert case.temperature.assembly == 293.15
    assert case.replace({"temperature.bushing": "573.15 K"}).temperature.bushing == 573.15
    assert 'bushing = "300 degC"' in case.to_toml()


def test_what_is_missing_is_said_once_and_with_its_place() -> None:
    said = str(refusal({"temperature.bushing": "300 degC"}))
    assert said.startswith("replace: surfaces.bushing.thermal_expansion: needed")
    assert said.count("needed") == 1


def test_a_material_follows_its_table() -> None:
    case = td.load_case("vsv").replace(EXPANSIONS | HOT | TABLE)
    assert case.surfaces.bushing.young_modulus == pytest.approx(4e9, rel=1e-12)
    assert case.wear.specific_wear_rate == pytest.approx(4e-15, rel=1e-12)
    cooler = case.replace({"temperature.bushing": "200 degC"})
    assert cooler.surfaces.bushing.young_modulus == pytest.approx(5e9, rel=1e-12)


def test_a_material_is_that_of_the_start() -> None:
    case = td.load_case("vsv").replace(EXPANSIONS | TABLE | WARMING)
    assert case.surfaces.bushing.young_modulus == pytest.approx(7e9, rel=1e-12)


def test_a_key_that_is_given_goes_before_the_table() -> None:
    case = td.load_case("vsv").replace(TABLE | {"surfaces.bushing.young_modulus": "6 GPa"})
    assert case.surfaces.bushing.young_modulus == 6e9


@pytest.mark.parametrize(
    ("changes", "key", "words"),
    [
        (HOT, "surfaces.trunnion.thermal_expansion", "not as warm"),
        (EXPANSIONS | HOT | {"temperature.fit": "bonded"}, "joint.liner.thickness", "thickness"),
        (TABLE | {"temperature.bushing": "500 degC"}, "temperature.properties.young_modulus", "ends"),
        (
            TABLE | {"temperature.properties.young_modulus": "7, 5 GPa"},
            "temperature.properties.young_modulus",
            "2 values for 3",
        ),
        (
            {"temperature.properties.hardness": "7, 5 GPa"},
            "temperature.properties.temperatures",
            "one for each",
        ),
        (
            TABLE | {"temperature.properties.temperatures": "20, 400, 200 degC"},
            "temperature.properties.temperatures",
            "above the one before",
        ),
        ({"temperature.bushing": "-300 degC"}, "temperature.bushing", "> 0"),
        (WARMING, "surfaces.bushing.thermal_expansion", "not as warm"),
        (
            EXPANSIONS | WARMING | {"temperature.over_time.bushing.times": "1, 2 s"},
            "temperature.over_time.bushing",
            "begins at 1 s",
        ),
        (EXPANSIONS | WARMING | HOT, "temperature.over_time.bushing.times", "temperature.bushing"),
        (
            EXPANSIONS
            | {
                "temperature.over_time.casing.times": "0, 1 s",
                "temperature.over_time.casing.values": "20, 30 degC",
            },
            "temperature.over_time.casing",
            "bonded",
        ),
    ],
)
def test_what_cannot_be(changes: dict[str, object], key: str, words: str) -> None:
    error = refusal(changes)
    assert error.key == key
    assert words in str(error)
