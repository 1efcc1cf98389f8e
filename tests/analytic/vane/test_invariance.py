"""What must not matter to a run: how often it is done, how often it is looked at, how lengths are spelled."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from tests.journals import BORE, journal, loads

from mebdf.arrays import FloatArray
from tribodyn.joints import BushingJoint
from tribodyn.joints.bushing import joint_wrench
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.mechanisms.results import write_run
from tribodyn.simulation import simulate

#: The start and what follows it: contact, friction and memory are at work.
BRIEF = {"run.duration": "0.2 s", "run.output_interval": "5 ms"}
ATTITUDE = ("e_x", "e_y", "phi_x", "phi_y", "e_x_dot", "e_y_dot", "phi_x_dot", "phi_y_dot")


def run(**changes):
    dotted = {path.replace("__", "."): value for path, value in changes.items()}
    return simulate(load_case("vsv").replace(BRIEF | dotted))


@pytest.fixture(scope="module")
def base():
    return run()


def test_the_case_beside_a_result_gives_it_again_to_the_bit(base, tmp_path):
    write_run(base, tmp_path)
    again = simulate(load_case(tmp_path / "case.toml"))
    assert again.attrs["case"] == base.attrs["case"]
    for name in base.variables:
        np.testing.assert_array_equal(base[name].values, again[name].values, err_msg=name)


def test_the_output_interval_does_not_change_the_solution(base):
    often = run(run__output_interval="1 ms").sel(time=base["time"], method="nearest")
    for name in (*ATTITUDE, "F_cx", "F_cy", "p_max"):
        # Rows are read from the steps, which know nothing of them; times of rows differ by rounding.
        np.testing.assert_allclose(often[name].values, base[name].values, rtol=1e-9, atol=0.0, err_msg=name)


def test_units_do_not_matter(base, tmp_path):
    changes = BRIEF | {
        "joint.clearance": "0.02 mm",
        "mechanism.lever_length": "5 cm",
        "drive.start_angle": f"{float(np.radians(-16.0))} rad",
        "surfaces.bushing.young_modulus": "7170 N/mm^2",
        "loads.air_moment": "84 N cm",
    }
    lines = ['case = "vsv"', *(f'{key} = "{value}"' for key, value in changes.items())]
    (tmp_path / "case.toml").write_text("\n".join(lines), encoding="utf-8")
    spelled = simulate(load_case(tmp_path / "case.toml"))
    quiet = base["time"].values > 0.1
    for name in ("e_x", "e_y", "phi_x", "phi_y", "F_cx", "theta_v"):
        scale = np.abs(base[name].values).max()
        # Parameters differ in their last bits, and steps may fall otherwise: within the tolerance of the run.
        difference = np.abs(spelled[name].values - base[name].values)[quiet].max()
        assert difference < 1e-4 * scale, name


WHOLE_NODES = 2.0 * math.pi * 7 / 96  #: Seven nodes of the contact's grid.
TURNING = {"drives.motor.speed": "30 rad/s", f"{BORE}.friction_coefficient": 0.1, "run.duration": "10 ms"}


def turned(kind: str, angle: float) -> dict[str, FloatArray]:
    """Return vectors of a tilting, turning journal, across its bore, with loads turned by an angle [rad]."""
    rotation = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    force, moment = (rotation @ (200.0, 100.0)).tolist(), (rotation @ (0.2, 0.1)).tolist()
    run = simulate(journal(kind, TURNING | loads(force, moment), tilts=True)).isel(joint=0)
    names = ("displacement", "relative_velocity", "contact_force")
    found = {name: run[name].values[:, :2] for name in names}
    film = run.get("film_force", 0.0)
    found["friction"] = (run["reaction_force"] - run["contact_force"] - film).values[:, :2]
    found["tilt"] = np.stack([run["tilt_x"].values, run["tilt_y"].values], axis=1)
    return {**found, "moment": run["reaction_moment"].values[:, 2]}


@pytest.mark.parametrize(
    ("kind", "angle", "agree"),
    [
        # The same sums in another order: to the tolerance of the run, 1e-5.
        ("journal-oil", WHOLE_NODES, 1e-4),
        # The error of the grid: 0.1 % in a force at worst.
        ("journal-oil", 0.5, 1e-3),
        # The memory of contact changes at accepted steps, and those fall otherwise: thousandths of an impact.
        ("journal-dry", WHOLE_NODES, 0.03),
    ],
)
def test_a_journal_follows_a_load_that_is_turned(kind: str, angle: float, agree: float) -> None:
    """All directions around the bushing are alike, and so are the names of its nodes."""
    here, there = (turned(kind, turn) for turn in (0.0, angle))
    moment, wanted = there.pop("moment"), here.pop("moment")
    assert np.abs(moment - wanted).max() <= agree * np.abs(wanted).max()
    rotation = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    for name, vectors in here.items():
        off = np.linalg.norm(there[name] - vectors @ rotation.T, axis=1)
        assert off.max() <= agree * np.linalg.norm(vectors, axis=1).max(), name


def test_the_path_integrals_do_not_depend_on_the_rows(base):
    often = run(run__output_interval="1 ms")
    for name in ("energy_damping", "energy_friction", "energy_drive"):
        assert often[name].values[-1] == pytest.approx(base[name].values[-1], rel=1e-5)


def test_the_names_of_the_nodes_do_not_matter(make_joint: Callable[..., BushingJoint]) -> None:
    """A worn bushing and its memory of contact, with the trunnion in it, all turned by whole nodes."""
    joint, nodes = make_joint(), 7
    random = np.random.default_rng(8)
    wear = 2e-6 * random.random(joint.field_shape)
    entry = random.choice([0.0, 1e-3, 4e-3], size=joint.field_shape)
    angle = 2.0 * math.pi * nodes / joint.grid.theta
    rotation = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    lean = np.array([6e-4, -3e-4])
    here = np.concatenate([(13e-6, -9e-6), np.arctan(lean)[::-1], np.zeros(4)])
    there = np.concatenate([rotation @ here[:2], np.arctan(rotation @ lean)[::-1], np.zeros(4)])
    before = joint_wrench(joint.data(wear), here, omega=0.3, entry_velocity=entry)
    worn = joint.data(np.roll(wear, nodes, axis=1))
    after = joint_wrench(worn, there, omega=0.3, entry_velocity=np.roll(entry, nodes, axis=1))
    turned = np.concatenate([rotation @ before[:2], (rotation @ before[[3, 2]])[::-1], before[4:]])
    # Cosines of the nodes' angles are rounded; pressure is that rounding over a third of a micrometre.
    np.testing.assert_allclose(after, turned, rtol=1e-9)
    moved = joint_wrench(joint.data(wear), there, omega=0.3, entry_velocity=entry)
    assert np.abs(moved / turned - 1.0).max() > 1e-3
