import contextlib
import math
from decimal import Decimal

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from tribodyn.cases.keys import keys_of
from tribodyn.cases.known_units import SIZES, ZEROS
from tribodyn.cases.other_units import looked_up
from tribodyn.cases.units import (
    _KNOWN,
    MEASURES,
    UnitProblem,
    dimension,
    from_si,
    rms_roughness,
    si_unit,
    to_si,
)
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.papers.cheng_2022.reduced.case import VsvCase

UNITS = ("um", "mm", "m", "deg", "rad", "GPa", "N m", "deg/s", "1/um^2", "m^2/N", "kg m^2", "ms", "um/s")


@pytest.mark.parametrize(
    ("text", "like", "value"),
    [
        ("20 um", "m", 2e-5),
        ("20um", "m", 2e-5),
        ("20 µm", "m", 2e-5),
        ("20 μm", "m", 2e-5),
        (" 2e1  um ", "m", 2e-5),
        ("0.02 mm", "m", 2e-5),
        ("1 in", "m", 0.0254),
        ("203 GPa", "Pa", 203e9),
        ("-16 deg", "rad", math.radians(-16)),
        ("−16°", "rad", math.radians(-16)),
        ("0.038 1/um^2", "1/m^2", 0.038e12),
        ("0.038/um^2", "1/m^2", 0.038e12),
        ("0.038 um**-2", "1/m^2", 0.038e12),
        ("0.84 Nm", "N m", 0.84),
        ("0.84 N m", "N m", 0.84),
        ("840 mN*m", "N m", 0.84),
        ("6.22e-4 kg·m²", "kg m^2", 6.22e-4),
        ("60 rpm", "rad/s", 2 * math.pi),
        ("5 ms", "s", 5e-3),
        ("200 HV", "Pa", 200 * 9.80665e6),
        ("60 HB", "Pa", 60 * 9.80665e6),
        ("1e-6 mm^3/(N m)", "m^2/N", 1e-15),
        ("1e-6 mm3/Nm", "m^2/N", 1e-15),
        ("1e-6 mm³/(N·m)", "m^2/N", 1e-15),
        ("10 mPa s", "Pa s", 0.01),
        ("10 cP", "Pa s", 0.01),
    ],
)
def test_quantities_are_read(text: str, like: str, value: float) -> None:
    # One rounding at most: 4 units in the last place cover the reference value's own rounding.
    assert to_si(text, like) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize("value", [2e-5, 3e-5, 1.1e-15, 7.17e9, 0.392e-6])
def test_a_decimal_scaled_by_a_power_of_ten_is_the_same_float(value: float) -> None:
    assert to_si(f"{value!r} m", "m") == value


@pytest.mark.parametrize(
    ("text", "like", "reason"),
    [
        ("20", "m", "unit is missing"),
        ("20 kg", "m", "not a unit of length"),
        ("20 parsnip", "m", "unknown unit 'parsnip'"),
        ("um", "m", "not a number"),
        ("", "m", "not a number"),
        ("nan um", "m", "finite"),
        ("-inf m", "m", "finite"),
        ("1e999 m", "m", "too large"),
        ("1e999999999 m", "m", "not a unit"),
        ("1,5 um", "m", "a decimal point, not a comma"),
        ("20 um + 3 um", "m", "not a unit"),
        ("2*3 um", "m", "not a number|not a unit"),
        ("20 m^99999999", "m", "not a unit"),
        ("20 um; import os", "m", "not a unit"),
        ("20 __import__('os')", "m", "not a unit"),
        ("20 " + "m*" * 100 + "m", "m", "too long"),
        ("٢٠ um", "m", "not a number"),
        ("1 percent", "rad", "not a unit of angle"),
        ("1 dB", "rad", "a unit"),
        ("1 Hz", "rad/s", "not a unit of angular speed"),
        ("20 degC", "m", "not a unit of length"),
        ("10 cSt", "Pa s", "kinematic; say the density, as in .10 cSt at 870 kg/m"),
        ("1 m/((s))", "m/s", "not a unit"),
        ("1 m/(s", "m/s", "not a unit"),
        ("1 ()", "m", "not a unit"),
    ],
)
def test_other_text_is_refused_with_the_reason(text: str, like: str, reason: str) -> None:
    with pytest.raises(UnitProblem, match=reason):
        to_si(text, like)


@given(st.text(max_size=120))
def test_no_text_breaks_the_reader(text: str) -> None:
    with contextlib.suppress(UnitProblem):
        assert math.isfinite(to_si(text, "m"))


@example(1.5e308, "GPa")
@example(1.5e308, "um")
@example(5e-324, "GPa")
@given(st.floats(allow_nan=False, allow_infinity=False), st.sampled_from(UNITS))
def test_what_is_written_reads_back_exactly(value: float, unit: str) -> None:
    assert to_si(from_si(value, unit), unit) == value


def test_what_is_written_is_what_a_person_would_write() -> None:
    assert from_si(2e-5, "um") == "20 um"
    assert from_si(to_si("-16 deg", "deg"), "deg") == "-16 deg"
    assert from_si(203e9, "GPa") == "203 GPa"
    assert [from_si(zero, "um") for zero in (0.0, -0.0, 0.0)] == ["0 um", "-0 um", "0 um"]


@given(st.integers(1, 10**11 - 1), st.integers(-9, 9), st.sampled_from(sorted({*UNITS} - {*ZEROS})))
def test_no_digit_is_written_that_nobody_gave(digits: int, power: int, unit: str) -> None:
    written = from_si(to_si(f"{digits}e{power} {unit}", unit), unit)
    assert Decimal(written.removesuffix(unit)) == Decimal(f"{digits}e{power}")


@pytest.mark.parametrize("unit", UNITS)
def test_every_unit_has_an_si_unit_of_factor_one(unit: str) -> None:
    assert to_si(f"1.5 {si_unit(unit)}", unit) == 1.5
    assert dimension(unit) == dimension(si_unit(unit))


def test_other_measures_of_height_become_the_root_mean_square() -> None:
    # Of Gaussian heights the mean magnitude is √(2/π) σ.
    assert rms_roughness("Ra 0.8 um") == pytest.approx(0.8e-6 * math.sqrt(math.pi / 2.0), rel=1e-12)
    assert rms_roughness("Rz = 5.6 um") == pytest.approx(rms_roughness("Ra 1 um"), rel=1e-12)
    assert rms_roughness("Rq 1 um") == rms_roughness("1 um") == 1e-6
    with pytest.raises(UnitProblem):
        rms_roughness("Rk 1 um")


def test_a_kinematic_viscosity_comes_with_its_density() -> None:
    assert to_si("32 cSt at 870 kg/m^3", "Pa s") == pytest.approx(0.02784, rel=1e-12)
    with pytest.raises(UnitProblem, match="say the density"):
        to_si("32 cSt", "Pa s")
    with pytest.raises(UnitProblem, match="density"):
        to_si("32 cSt at 870 kg", "Pa s")
    with pytest.raises(UnitProblem):
        to_si("32 um at 870 kg/m^3", "m")


def test_micrometres_are_the_float_a_person_expects() -> None:
    assert to_si("20 um", "m") == 20e-6 == 2e-05


@pytest.mark.parametrize(("base", "unit"), [(base, unit) for base, sizes in SIZES.items() for unit in sizes])
def test_what_is_known_by_heart_is_what_pint_says(base: str, unit: str) -> None:
    size, zero, units = looked_up(unit)
    assert (size, zero, units) == (Decimal(SIZES[base][unit]), Decimal(ZEROS.get(unit, "0")), base)


def test_the_units_of_all_keys_are_known_without_pint() -> None:
    """A case with one of the others loads pint, which takes longer than to read and write it."""
    keys = {**keys_of(MechanismCase), **keys_of(VsvCase)}
    assert {key.unit for key in keys.values()} - {""} | set(MEASURES) <= set(_KNOWN)


def test_a_unit_that_no_key_has_yet_is_its_own() -> None:
    # A new element may have keys in N m^2 or rad/s^2.
    assert si_unit("N m^2") == dimension("N m^2") == "N m^2"
    assert to_si("3 kN m^2", "N m^2") == pytest.approx(3000.0)
    assert to_si("180 deg/s^2", "rad/s^2") == pytest.approx(math.pi)
    with pytest.raises(UnitProblem, match="N m\\^2"):
        to_si("3 N", "N m^2")
