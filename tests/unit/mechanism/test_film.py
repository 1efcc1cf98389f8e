"""Oil films of joints: what is refused, what results hold, what a state without an answer leaves behind."""

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.kernels.mechanism import functions
from tribodyn.mechanism.system import MechanismSystem
from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.mechanisms.results import summarise
from tribodyn.results import VARIABLES

OILED = "slider-crank-oil"
SHORT = {"run.cycles": 0.02}


@pytest.fixture(scope="module")
def oiled() -> xr.Dataset:
    return td.simulate(td.load_case(OILED).replace(SHORT))


def bearing(kind: str = "revolute", *, film: dict[str, object] | None = None, **keys: object) -> td.Mechanism:
    """Return a journal in a bearing with an oil film."""
    made = td.Mechanism("Journal", run={"duration": "1 ms"})
    made.body("journal", mass="0.2 kg", centre="0, 0, 0 mm", inertia=["1e-4 kg m^2"] * 3)
    made.joint("main", kind, "ground", "journal", point="0, 0, 0 mm", axis=[0, 0, 1])
    made.clearance("main", radius="6 mm", radial="20 um", length="20 mm", **keys)
    return made.film("main", **({"viscosity": "0.01 Pa s"} if film is None else film))


@pytest.mark.parametrize(
    ("made", "words"),
    [
        (bearing("cylindrical"), "that of a revolute joint"),
        (bearing("spherical"), "in the bore of a pin"),
        (bearing(pin_length="15 mm"), "as long as its bore"),
        (bearing(form={"crown": "2 um"}), "between round surfaces"),
        (bearing(film={"grid": {"z": 15}}), r"joints\.main\.film\.grid\.z.*even number"),
        (bearing(film={"cavitation": "jfo"}), "half-sommerfeld"),
    ],
)
def test_what_can_be_no_film_is_refused(made: td.Mechanism, words: str) -> None:
    with pytest.raises(InputError, match=words):
        made.case()


def test_a_film_without_clearance_is_refused() -> None:
    made = td.Mechanism("Journal", run={"duration": "1 ms"})
    with pytest.raises(InputError, match="write the joint first, then its film"):
        made.film("main", viscosity="0.01 Pa s")
    made.body("journal", mass="0.2 kg", centre="0, 0, 0 mm", inertia=["1e-4 kg m^2"] * 3)
    made.revolute("main", "ground", "journal", point="0, 0, 0 mm", axis=[0, 0, 1]).film("main")
    with pytest.raises(InputError, match="a clearance with radius"):
        made.case()


def test_results_hold_films_only_where_there_are_some(oiled: xr.Dataset) -> None:
    dry = td.simulate(td.load_case("slider-crank").replace({"run.cycles": 0.001}))
    assert not [name for name in dry.variables if "film" in str(name)]
    assert set(oiled.variables) <= set(VARIABLES) | set(MECHANISMS["mechanism"].variables)
    big_end, others = oiled.sel(joint="big-end"), oiled.drop_sel(joint="big-end")
    for name in (
        name for name in map(str, oiled.data_vars) if "film" in name and "joint" in oiled[name].dims
    ):
        assert np.isfinite(big_end[name]).all(), name
        assert np.isnan(others[name]).all(), name
    assert big_end["film_pressure_peak"] >= big_end["film_pressure_max"].max() > 1e5
    assert 0.0 < big_end["film_thickness_least"] <= big_end["film_thickness_min"].min()
    assert float(oiled["energy_film"][-1]) == pytest.approx(float(big_end["joint_film"][-1]))
    assert oiled.attrs["energy_residual"] < 1e-3
    summary = summarise(oiled)
    assert {"film_pressure_max_MPa", "film_thickness_min_um_big_end", "film_power_mean_W"} <= set(summary)


def test_the_whole_joint_force_is_that_of_film_and_contact(oiled: xr.Dataset) -> None:
    big_end = oiled.sel(joint="big-end")
    rest = big_end["reaction_force"] + big_end["film_force"]  # the shaft is on the first body
    assert float(abs(big_end["film_force"][..., :2]).max()) > 10.0
    assert np.abs(rest + big_end["contact_force"]).max() < 0.2 * float(abs(big_end["film_force"]).max())


def test_a_state_without_an_answer_leaves_nothing_behind() -> None:
    """Rates are those of the state, whatever was evaluated before: here a film whose gap has closed."""
    problem = MechanismSystem(td.load_case(OILED)).problem(1e-3)
    data, memory, y = problem.data, problem.memory, problem.y0.copy()
    functions.enter(0.0, y, data, memory)
    before, f, beyond = np.empty(y.size), np.empty(y.size), y.copy()
    functions.rhs(0.0, y, data, memory, before)
    beyond[0] += 1e-3
    functions.rhs(0.0, beyond, data, memory, f)
    assert np.isnan(f).any()
    functions.rhs(0.0, y, data, memory, f)
    assert f == pytest.approx(before, rel=1e-12, abs=1e-9)


def test_a_worn_bore_has_a_film_of_its_shape() -> None:
    """Wear at all nodes by one depth is a larger clearance."""
    system = MechanismSystem(bearing().case())
    depth = np.full(system.maps.n_nodes, 3e-6)
    wider = MechanismSystem(bearing().case().replace({"joints.main.clearance.radial": "23 um"}))
    worn, made = (model._assembled(wear).data.films for model, wear in ((system, depth), (wider, None)))
    gap = worn.constants["clearance"][0] + worn.wear_node[0]
    assert gap == pytest.approx(np.full(gap.shape, made.constants["clearance"][0]), rel=1e-12)


@pytest.mark.parametrize("theta", [24, 27])
def test_a_film_is_worn_where_its_bore_is(theta: int) -> None:
    """The angle of a node of a film is that of the force on the shaft: the node is opposite to it."""
    grid = {"joints.main.film.grid.theta": theta, "joints.main.clearance.nodes_around": 96}
    system = MechanismSystem(bearing().case().replace(grid))
    places = [place for place in system.maps.places if place.surface.name == "barrel"]
    depth = np.zeros(system.maps.n_nodes)
    axes = places[0].surface.axes
    depth[places[0].nodes] = (1e-6 * (1.0 + np.cos(axes["theta"] - 1.0)) * (1.0 + axes["z"][:, None])).ravel()
    film = system._assembled(depth).data.films
    angles, z = 2.0 * np.pi * np.arange(theta) / theta, film.z_node[0]
    wanted = 1e-6 * (1.0 + np.cos(angles[:, None] + np.pi - 1.0)) * (1.0 + z)
    assert film.wear_node[0] == pytest.approx(wanted, abs=1e-9)
