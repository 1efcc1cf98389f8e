"""The Stribeck curve: its limits, its minimum, and who carries the load."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.joints import BushingJoint
from tribodyn.lubrication import Film, FilmGrid, Roughness
from tribodyn.mechanism.analyses.shaft_in_bore import Journal, equilibria, equilibrium

FRICTION = 0.1
SPEEDS = np.geomspace(0.1, 3e4, 45)


Curve = dict[str, FloatArray]


def curve_of(journal: Journal, speeds: FloatArray) -> Curve:
    """Return properties of the equilibria at some speeds by name, each of shape (n,)."""
    points = equilibria(journal, speeds)
    names = ("friction_coefficient", "film_share", "contact_share", "eccentricity")
    return {name: np.array([getattr(point, name) for point in points]) for name in names}


@pytest.fixture(scope="module")
def journal(make_joint: Callable[..., BushingJoint]) -> Journal:
    film = Film(0.01, 20e-6, 6e-3, 20e-3, Roughness((0.392e-6, 1.586e-6)), grid=FilmGrid(96, 16))
    return Journal(make_joint(coefficient=FRICTION), (200.0, 100.0), film)


@pytest.fixture(scope="module")
def curve(journal: Journal) -> Curve:
    return curve_of(journal, SPEEDS)


def test_shares_change_hands_monotonically_and_add_up(curve: Curve) -> None:
    # Up to rounding of forces that balance to 1e-9 N or so.
    assert np.diff(curve["film_share"]).min() > -1e-9
    assert np.diff(curve["contact_share"]).max() < 1e-9
    assert curve["film_share"] + curve["contact_share"] == pytest.approx(1.0, abs=1e-9)
    assert curve["film_share"][0] < 0.01
    assert curve["film_share"][-1] == pytest.approx(1.0, abs=1e-9)


def test_friction_is_least_in_mixed_lubrication(curve: Curve) -> None:
    least = int(np.argmin(curve["friction_coefficient"]))
    assert 0 < least < SPEEDS.size - 1
    assert 0.5 < curve["film_share"][least] < 1.0
    assert np.all(np.diff(curve["friction_coefficient"][: least + 1]) < 0.0)
    assert np.all(np.diff(curve["friction_coefficient"][least:]) > 0.0)
    assert curve["friction_coefficient"][least] < 0.1 * curve["friction_coefficient"][0]


def test_slow_friction_is_that_of_the_asperities(curve: Curve) -> None:
    # Pressure around an arc presses more than its resultant, and traction tilts it: some per cent above μ_f.
    assert FRICTION < curve["friction_coefficient"][0] < 1.03 * FRICTION


def test_fast_friction_is_petroffs(curve: Curve, journal: Journal) -> None:
    assert journal.film is not None
    size, load = journal.joint.geometry, journal.force
    moment = (
        2.0 * math.pi * journal.film.viscosity * SPEEDS[-1] * size.radius**3 * size.length / size.clearance
    )
    # The centre is a hundredth of the clearance off the axis; at 12 σ of gap flow factors are near 1.
    assert curve["friction_coefficient"][-1] == pytest.approx(moment / (size.radius * load), rel=0.01)
    assert curve["eccentricity"][-1] < 0.03 * size.clearance


def test_the_wedge_shifts_the_journal_along_its_rotation(journal: Journal) -> None:
    # Pressure builds up where oil is dragged into the narrowing gap, and pushes the centre on.
    x, y = equilibrium(journal, speed=400.0).centre
    assert 200.0 * y - 100.0 * x > 0.0


def test_a_mass_conserving_film_has_an_equilibrium(journal: Journal) -> None:
    assert journal.film is not None
    film = replace(journal.film, cavitation="jfo", boundary="groove", grid=FilmGrid(64, 8))
    point = equilibrium(replace(journal, film=film), speed=400.0)
    assert point.film_share + point.contact_share == pytest.approx(1.0, abs=1e-6)


def test_the_curve_does_not_depend_on_where_it_starts(curve: Curve, journal: Journal) -> None:
    back = curve_of(journal, SPEEDS[::-11])
    picked = curve["friction_coefficient"][::-11]
    assert back["friction_coefficient"] == pytest.approx(picked, rel=1e-8)


def test_turning_the_other_way_mirrors_the_attitude(journal: Journal) -> None:
    forth, back = equilibrium(journal, speed=100.0), equilibrium(journal, speed=-100.0)
    along = np.array([200.0, 100.0]) / math.hypot(200.0, 100.0)
    across = np.array([-along[1], along[0]])
    # The grid has no mirror axis along the load: the difference is that of the quadrature.
    assert back.centre @ along == pytest.approx(forth.centre @ along, rel=1e-4)
    assert back.centre @ across == pytest.approx(-forth.centre @ across, rel=1e-4)
    assert back.film[4] == pytest.approx(-forth.film[4], rel=1e-4)


def test_no_load_no_curve(journal: Journal) -> None:
    with pytest.raises(InputError, match="needs a load"):
        equilibria(replace(journal, load=(0.0, 0.0)), [1.0])
