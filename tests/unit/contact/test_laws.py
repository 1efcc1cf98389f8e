"""What every contact law keeps, over the list of laws and the surfaces they take."""

import dataclasses
import math

import numpy as np
import pytest

from tribodyn.contact import DAMPING_FACTORS, LAWS, RSDC, SurfacePair, law
from tribodyn.contact.asperities import AsperityLaw
from tribodyn.contact.greenwood_tripp import GreenwoodWilliamson
from tribodyn.core.errors import InputError

H_STAR = np.linspace(-4.0, 8.0, 121)


@pytest.mark.parametrize("name", LAWS)
def test_pressure_falls_with_separation(table_1_pair: SurfacePair, name: str) -> None:
    pressure = law(name, table_1_pair).stiffness_pressure(H_STAR)
    assert np.all(pressure >= 0.0)
    assert np.all(np.diff(pressure) <= 0.0)
    assert pressure[0] > 0.0


@pytest.mark.parametrize("name", LAWS)
def test_area_and_count_fall_with_separation_where_the_theory_has_them(table_1_pair, name):
    found = law(name, table_1_pair)
    for values in (found.real_area_fraction(H_STAR), found.contact_count(H_STAR)):
        assert values.shape == H_STAR.shape
        if np.isfinite(values).any():
            assert np.all(values > 0.0)
            assert np.all(np.diff(values) < 0.0)
        else:
            assert not issubclass(LAWS[name], AsperityLaw)


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("factor", DAMPING_FACTORS)
def test_every_law_takes_every_damping_factor(table_1_pair: SurfacePair, name: str, factor: str) -> None:
    h = H_STAR.reshape(11, 11)
    damping = law(name, table_1_pair, damping_factor=factor, restitution=0.6).damping_pressure(h)
    assert damping.shape == h.shape
    assert np.all(damping >= 0.0)
    assert damping.any() == (factor != "none")
    lively = law(name, table_1_pair, damping_factor=factor, restitution=1.0).damping_pressure(h)
    assert not lively.any()


@pytest.mark.parametrize("name", sorted(set(LAWS) - {RSDC.name}))
def test_damping_is_proportional_to_the_stiffness(table_1_pair: SurfacePair, name: str) -> None:
    found = law(name, table_1_pair, damping_factor="flores", restitution=0.6)
    expected = 1.6 * 0.4 / 0.6 * found.stiffness_pressure(H_STAR)
    np.testing.assert_allclose(found.damping_pressure(H_STAR), expected, rtol=1e-14)


def test_dashpots_stand_where_asperities_touch(table_1_pair: SurfacePair) -> None:
    found = GreenwoodWilliamson(table_1_pair, "kelvin-voigt", restitution=0.6)
    h_design = found.design_separation()
    assert found.stiffness_pressure(np.array([h_design]))[0] == pytest.approx(50e6, rel=1e-10)
    count = found.contact_count(np.array([0.0, h_design]))
    damping = found.damping_pressure(np.array([0.0, h_design]))
    assert damping[0] / damping[1] == pytest.approx(count[0] / count[1], rel=1e-12)
    zeta = -np.log(0.6) / np.hypot(np.pi, np.log(0.6))
    assert damping[1] == pytest.approx(2.0 * zeta * 50e6, rel=1e-9)


def test_a_given_restitution_replaces_that_of_the_paper(table_1_pair: SurfacePair) -> None:
    given = RSDC(table_1_pair, restitution=0.5)
    np.testing.assert_array_equal(given.meant_restitution(H_STAR), 0.5)
    own = RSDC(table_1_pair)
    ratio = (1.0 - 0.25) / (1.0 - own.meant_restitution(H_STAR) ** 2)
    np.testing.assert_allclose(
        given.damping_pressure(H_STAR), ratio * own.damping_pressure(H_STAR), rtol=1e-13
    )


@pytest.mark.parametrize(
    ("name", "options", "key"),
    [
        ("gw", {"damping_factor": "newton", "restitution": 0.5}, "contact.damping_factor"),
        ("gw", {"damping_factor": "flores"}, "contact.restitution"),
        ("rsdc", {"restitution": 0.0}, "contact.restitution"),
        ("rsdc", {"restitution": 1.1}, "contact.restitution"),
        ("ke", {"design_pressure": 0.0}, "contact.design_pressure"),
        ("ke", {"separation_from": "below"}, "contact.separation_from"),
        ("linear", {"penalty_stiffness": 0.0}, "contact.penalty_stiffness"),
    ],
)
def test_impossible_options_are_refused_by_key(table_1_pair, name, options, key):
    with pytest.raises(InputError) as caught:
        LAWS[name](table_1_pair, **options)  # type: ignore[arg-type]
    assert caught.value.key == key


def test_a_design_pressure_beyond_the_law_is_refused(table_1_pair: SurfacePair) -> None:
    found = GreenwoodWilliamson(table_1_pair, "kelvin-voigt", restitution=0.6, design_pressure=1e12)
    with pytest.raises(InputError, match=r"at most 1\.94e\+10 Pa"):
        found.damping_pressure(H_STAR)


def test_surfaces_too_smooth_for_a_spread_of_asperities_are_refused(table_1_pair: SurfacePair) -> None:
    import dataclasses

    sparse = dataclasses.replace(table_1_pair, asperity_density=1e9)
    with pytest.raises(InputError, match=r"exceed 0\.0193"):
        GreenwoodWilliamson(sparse, separation_from="surface")


def test_unknown_law_names_the_known_ones(table_1_pair: SurfacePair) -> None:
    with pytest.raises(InputError, match="ke, rsdc") as caught:
        law("hertz", table_1_pair)
    assert caught.value.key == "contact.law"


def test_options_of_no_law_are_refused(table_1_pair: SurfacePair) -> None:
    with pytest.raises(InputError, match="dampng"):
        law("ke", table_1_pair, dampng="flores")


@pytest.mark.parametrize("name", LAWS)
def test_pressure_takes_a_gap_in_metres(table_1_pair: SurfacePair, name: str) -> None:
    found = law(name, table_1_pair)
    gap = np.array([[0.0, 1e-6], [2e-6, 5e-6]])
    expected = found.stiffness_pressure(gap / table_1_pair.roughness_rms)
    np.testing.assert_array_equal(found.pressure(gap), expected)


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("young_modulus", (203e9, 0.0)),
        ("young_modulus", (math.nan, 7e9)),
        ("hardness", -1.0),
        ("hardness", math.inf),
        ("asperity_density", 0.0),
        ("asperity_radius", math.nan),
        ("roughness", (0.0, 0.0)),
        ("roughness", (-1e-6, 2e-6)),
        ("roughness", (1e-6, math.nan)),
        ("poisson_ratio", (0.3, 0.51)),
        ("poisson_ratio", (math.nan, 0.3)),
    ],
)
def test_impossible_surfaces_are_refused_by_key(table_1_pair: SurfacePair, key: str, value: object) -> None:
    with pytest.raises(InputError) as caught:
        dataclasses.replace(table_1_pair, **{key: value})
    assert caught.value.key == key
