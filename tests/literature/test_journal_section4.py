"""Section 4 of the source paper: the journal under 200 N and 100 N, dry and in oil.

Numbers marked (model, 9) were computed independently of this project.
"""

import numpy as np
import pytest
import xarray as xr
from numpy.typing import NDArray

import tribodyn as td
from mebdf.arrays import FloatArray
from tribodyn.mechanism.analyses.shaft_in_bore import equilibrium, journal_of

FINAL = (14.563e-6, 7.281e-6)  #: Where statics put the centre [m] (model, 9).
PEAK = 18.376e-6  #: Eccentricity at which the undamped journal turns back [m] (model, 9).
LAWS = ("rsdc", "ke")


def run(name: str, **changes: object) -> xr.Dataset:
    result = td.simulate(td.load_case(name).replace(changes))
    assert not result.attrs["failure"]
    return result


@pytest.fixture(scope="module")
def dry() -> dict[str, xr.Dataset]:
    return {law: run("journal-dry", **{"run.output_interval": "1 us", "contact.law": law}) for law in LAWS}


@pytest.fixture(scope="module")
def oil() -> dict[str, xr.Dataset]:
    return {law: run("journal-oil", **{"contact.law": law}) for law in LAWS}


def centre(result: xr.Dataset) -> FloatArray:
    """Return the path of the centre [m], shape (2, n_t)."""
    return result["displacement"].values[:, 0, :2].T


def size(result: xr.Dataset, name: str) -> xr.DataArray:
    """Return the size of a force of the bearing [N]."""
    return np.sqrt((result[name].isel(joint=0) ** 2).sum("axis"))


def from_rest(result: xr.Dataset) -> FloatArray:
    """Return the distance from where statics put the centre [m], shape (n_t,)."""
    return np.hypot(*(centre(result) - np.array(FINAL)[:, None]))


def touching(result: xr.Dataset) -> NDArray[np.bool_]:
    """Return at which times any point is within the separation where asperities meet, 4 σ."""
    return np.asarray(result["gap_min"].values[:, 0] < 4.0 * float(result["roughness"][0]))


def rebounds(result: xr.Dataset) -> int:
    """Return how often the journal left contact altogether."""
    return np.count_nonzero(touching(result)[:-1] & ~touching(result)[1:])


def peaks(eccentricity: FloatArray) -> FloatArray:
    """Return the largest eccentricity of each stay in contact, from a parabola through three samples."""
    e = eccentricity
    top = 1 + np.flatnonzero((e[1:-1] > e[:-2]) & (e[1:-1] >= e[2:]) & (e[1:-1] > 17e-6))
    left, middle, right = e[top - 1], e[top], e[top + 1]
    return np.asarray(middle - (left - right) ** 2 / (8.0 * (left - 2.0 * middle + right)))


@pytest.mark.parametrize("law", LAWS)
def test_statics_are_the_same_for_both_laws(law: str) -> None:
    found = equilibrium(journal_of(td.load_case("journal-dry").replace({"contact.law": law})))
    assert found.centre == pytest.approx(FINAL, abs=1e-9)  # (model, 9), given to a nanometre


def test_dry_rsdc_settles_within_a_few_milliseconds(dry: dict[str, xr.Dataset]) -> None:
    late = dry["rsdc"]["time"].values > 3e-3
    assert from_rest(dry["rsdc"])[late].max() < 0.01 * 20e-6
    # It still slides along the wall, where nothing but the shallow slope of the gap brings it back.
    assert centre(dry["rsdc"])[:, -1] == pytest.approx(FINAL, abs=0.01e-6)


def test_dry_ke_never_settles(dry: dict[str, xr.Dataset]) -> None:
    assert from_rest(dry["ke"])[-100:].max() > 0.01 * 20e-6
    assert rebounds(dry["ke"]) >= 20
    assert rebounds(dry["rsdc"]) <= 2


@pytest.mark.parametrize("solver", ["mebdf", "radau"])
def test_dry_ke_keeps_its_energy_at_default_tolerance(solver: str) -> None:
    changes = {"solver.name": solver, "contact.law": "ke"}
    alone = run("journal-dry", **changes, **{"run.output_interval": "1 us"})
    turns = peaks(np.hypot(*centre(alone)))[:11]
    # Eleven peaks are ten rebounds, along the load: later the path leaves that line, which is unstable.
    assert turns.size == 11
    assert turns == pytest.approx(PEAK, rel=1e-3)  # (model, 9)
    assert np.ptp(turns) < 1e-3 * PEAK
    assert alone.attrs["energy_residual"] < 1e-3


@pytest.mark.parametrize("law", LAWS)
def test_in_oil_both_laws_come_to_the_same_place(oil: dict[str, xr.Dataset], law: str) -> None:
    off, late = from_rest(oil[law]), oil[law]["time"].values >= 30e-3
    # (model, 9): reached by about 30 ms; the film is squeezed out ever more slowly.
    assert off[late].max() < 0.02e-6
    assert rebounds(oil[law]) == 0


@pytest.mark.parametrize("law", LAWS)
def test_in_oil_contact_starts_near_8_ms(oil: dict[str, xr.Dataset], law: str) -> None:
    begun = int(np.argmax(touching(oil[law])))
    assert oil[law]["time"].values[begun] == pytest.approx(8.0e-3, abs=0.3e-3)  # (model, 9): near


def test_in_oil_the_paths_almost_coincide_and_rsdc_pushes_earlier(oil: dict[str, xr.Dataset]) -> None:
    apart = np.hypot(*(centre(oil["rsdc"]) - centre(oil["ke"])))
    assert apart.max() < 0.15e-6
    damped, undamped = (size(oil[law], "contact_force") for law in LAWS)
    early = (damped["time"] > 9e-3) & (damped["time"] < 13e-3)
    assert bool((damped > undamped)[early].all())


@pytest.mark.parametrize("law", LAWS)
def test_in_oil_the_film_hands_the_load_to_the_asperities(oil: dict[str, xr.Dataset], law: str) -> None:
    result = oil[law]
    film, contact = size(result, "film_force"), size(result, "contact_force")
    load = np.hypot(200.0, 100.0)
    at = {"method": "nearest"}
    assert film.sel(time=5e-3, **at).values == pytest.approx(load, rel=5e-3)
    assert contact.sel(time=50e-3, **at).values == pytest.approx(load, rel=1e-3)
    assert film.sel(time=50e-3, **at).max() < 1e-3 * load


@pytest.mark.parametrize("law", LAWS)
def test_the_energy_balance_closes(dry: dict[str, xr.Dataset], oil: dict[str, xr.Dataset], law: str) -> None:
    for results in (dry, oil):
        assert results[law].attrs["energy_residual"] < 1e-3
