"""The mechanism of the source paper, made from its tables, and runs of it that several tests read."""

from __future__ import annotations

import gc
import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from mebdf import solver
from mebdf.arrays import FloatArray
from mebdf.kernels import state
from tribodyn.contact import SurfacePair, law, tabulate
from tribodyn.core.remembered import ContactTable
from tribodyn.integrate import integrate
from tribodyn.integrate.driver import IntegrationTask, Stepwise
from tribodyn.joints import BushingJoint, EntryMemory, Friction, Grid
from tribodyn.joints.clearances import Clearance
from tribodyn.joints.shapes import SHAPES, Cylinder
from tribodyn.kernels.vsv.quantities import OBSERVED
from tribodyn.mechanism.shapes.guide import DovetailGuide, SquareGuide
from tribodyn.papers.cheng_2022.reduced.parameters import AirLoads, CrankMotion, Inertias, Lengths, Vsv
from tribodyn.papers.cheng_2022.reduced.problem import vsv_problem

LENGTHS = Lengths(0.0477, 0.1424, 0.4, 0.05, 0.16, 0.5, math.radians(20.0), math.radians(55.0))
INERTIAS = Inertias(0.82, 0.1232, 0.6744, 0.253, 6.22e-4, 8.33e-4, 7.20e-2, 2.16e-3, 2.16e-3)
DRIVE = CrankMotion(math.radians(-16.0), math.radians(20.0), 1.0)
TABLE_3 = AirLoads(0.4, 1.2, 0.84, math.radians(90.0), 0.01)
#: Absolute tolerances of e [m], φ [rad], ė [m/s], φ̇ [rad/s], a twentieth of the default ones.
ATOL = (1e-11, 1e-9, 1e-7, 1e-5)

Columns = dict[str, FloatArray]
OTHER_ROUNDINGS = range(10)  #: Values of ``--tolerance-factor``.

# Searches for unreachable objects would take a third of collecting and a tenth of all tests.
gc.set_threshold(100_000)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--tolerance-factor",
        type=int,
        default=0,
        choices=OTHER_ROUNDINGS,
        metavar="K",
        help="multiply relative tolerances by 1 + K·1e-9, so that every integration takes other roundings",
    )

    parser.addoption(
        "--part",
        metavar="K/N",
        help="of the tests that -m selects, run part K of N that take about the same time",
    )


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    # After -m has selected: a plug-in's hook that comes first would count the tests that are left out.
    if config.getoption("part"):
        part, parts = map(int, config.getoption("part").split("/"))
        shares = divided(items, parts)
        items[:] = shares.pop(part)
        config.hook.pytest_deselected(items=[item for share in shares for item in share])


def divided(items: list[pytest.Item], parts: int) -> list[list[pytest.Item]]:
    """Return the items in parts that take about the same time, in each part what takes longest first."""
    shares: list[list[pytest.Item]] = [[] for _ in range(parts)]
    loads = [0.0] * parts
    for item in sorted(items, key=_minutes, reverse=True):
        least = loads.index(min(loads))
        shares[least].append(item)
        loads[least] += _minutes(item)
    return shares


def _minutes(item: pytest.Item) -> float:
    """Return what a long test says of how long it takes, roughly; those that take seconds say nothing."""
    mark = item.get_closest_marker("long")
    return float(mark.kwargs.get("minutes", 0.1)) if mark else 0.005


def pytest_collection_finish() -> None:
    gc.freeze()


def pytest_report_header(config: pytest.Config) -> list[str]:
    return [f"part of the tests: {config.getoption('part')}"] if config.getoption("part") else []


def pytest_configure(config: pytest.Config) -> None:
    if number := config.getoption("tolerance_factor"):
        scale_tolerances(1.0 + 1e-9 * number)


def scale_tolerances(factor: float) -> None:
    """Multiply every relative tolerance by a factor, for the rest of this process.

    All integrations by MEBDF, compiled or called by SciPy, begin with ``new_state``; those by other methods
    go through :class:`Stepwise`. Processes that tests start are not changed.
    """
    new_state, integrated = state.new_state, Stepwise.__call__

    def scaled_state(t: float, y: FloatArray, t_end: float, rtol: Any, *others: Any, **options: Any) -> Any:
        return new_state(t, y, t_end, factor * np.asarray(rtol), *others, **options)

    def scaled_call(self: Stepwise, task: IntegrationTask) -> Any:
        return integrated(self, replace(task, rtol=factor * task.rtol))

    state.new_state = solver.new_state = scaled_state
    Stepwise.__call__ = scaled_call  # type: ignore[method-assign]


@pytest.fixture(scope="session")
def table_1_pair() -> SurfacePair:
    """The surfaces of Table 1 of the source paper."""
    return SurfacePair(
        young_modulus=(203e9, 7.17e9),
        poisson_ratio=(0.27, 0.34),
        roughness=(0.392e-6, 1.586e-6),
        hardness=492e6,
        asperity_density=0.038e12,
        asperity_radius=8.17e-6,
    )


@pytest.fixture(scope="session")
def contact_table(table_1_pair: SurfacePair) -> ContactTable:
    """The default contact law of the default surfaces."""
    return tabulate(law("rsdc", table_1_pair))


@pytest.fixture(scope="session")
def make_joint(contact_table: ContactTable, table_1_pair: SurfacePair) -> Callable[..., BushingJoint]:
    """Return a maker of bushing joints; what is not said is the paper's or the default."""

    def make(
        clearance: float = 20e-6,
        *,
        friction: str = "traction",
        coefficient: float = 0.1,
        slip_velocity: float = 1e-5,
        grid: tuple[int, int] = (96, 16),
        minimum_velocity: float = 1e-3,
        clip: bool = True,
        table: ContactTable = contact_table,
    ) -> BushingJoint:
        return BushingJoint(
            Cylinder(6e-3, clearance, 20e-3),
            Friction(coefficient, friction, slip_velocity),
            EntryMemory(4.0, minimum_velocity, clip),
            Grid(*grid),
            table_1_pair.roughness_rms,
            table,
        )

    return make


SIZES = {
    "cylinder": {"radius": 6e-3, "clearance": 20e-6, "length": 20e-3},
    "wide": {"radius": 200e-3, "clearance": 20e-6, "length": 20e-3},
    "piston": {"radius": 200e-3, "clearance": 20e-6, "length": 40e-3, "pin_length": 20e-3},
    "flanged": {"radius": 6e-3, "clearance": 20e-6, "length": 20e-3, "axial": 15e-6, "flange": 9e-3},
    "annulus": {"inner": 6e-3, "outer": 9e-3, "clearance": 20e-6, "height": 10e-3},
    "sphere": {"radius": 8e-3, "clearance": 20e-6, "band": 0.8},
    "ball": {"radius": 8e-3, "clearance": 20e-6, "band": 0.1},
    "mesh": {"clearance": 20e-6, "edge": 4e-3},
    "guide": {"clearance": 20e-6, "length": 20e-3, "through": True},
    "block": {"clearance": 20e-6, "length": 20e-3},
    "dovetail": {"clearance": 20e-6, "length": 20e-3},
    "slot": {"radius": 6e-3, "clearance": 20e-6, "length": 20e-3},
    "pads": {"radius": 6e-3, "clearance": 20e-6, "length": 20e-3, "width": 4e-3, "count": 5},
}
"""Sizes of a clearance joint of each shape [m].

``wide`` and ``piston`` have ten times the radius of their length, ``flanged`` has end faces, ``guide`` is a
rail through a carriage.
"""
VARIANTS = {
    "wide": "cylinder",
    "piston": "cylinder",
    "flanged": "cylinder",
    "block": "guide",
    "dovetail": "guide",
}


def square_tube(half: float) -> FloatArray:
    """Return the inner walls of a tube along z as triangles that face the axis [m], shape (8, 3, 3)."""
    corners = np.array([[half, -half, -half], [half, half, -half], [half, half, half], [half, -half, half]])
    wall = corners[[[0, 2, 1], [0, 3, 2]]]
    turns = [np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    return np.concatenate([wall @ turn.T for turn in turns])


SQUARE = SimpleNamespace(width=16e-3, height=12e-3)
DOVETAIL = SimpleNamespace(width=16e-3, height=6e-3, flank_angle=math.radians(55.0))
FACETS: dict[str, dict[str, object]] = {
    "mesh": {"facets": square_tube(8e-3)},
    "guide": {"walls": SquareGuide().walls(SQUARE)},
    "block": {"walls": SquareGuide().walls(SQUARE)},
    "dovetail": {"walls": DovetailGuide().walls(DOVETAIL)},
}


@pytest.fixture(scope="session")
def make_clearance(contact_table: ContactTable, table_1_pair: SurfacePair) -> Callable[..., Clearance]:
    """Return a maker of clearances by shape; what is not said is as in :data:`SIZES`, or the default."""

    def make(
        shape: str,
        *,
        grid: tuple[int, int] = (48, 8),
        coefficient: float = 0.1,
        slip_velocity: float = 1e-5,
        contact: str = "surface",
        table: ContactTable = contact_table,
        clip: bool = True,
        **sizes: float,
    ) -> Clearance:
        return Clearance(
            shape=SHAPES[VARIANTS.get(shape, shape)](**FACETS.get(shape, {}), **(SIZES[shape] | sizes)),
            grid=grid,
            roughness=table_1_pair.roughness_rms,
            law=law("rsdc", table_1_pair),
            table=table,
            friction_coefficient=coefficient,
            slip_velocity=slip_velocity,
            onset=4.0,
            minimum_velocity=1e-3,
            tensile_clip=clip,
            contact=contact,
        )

    return make


@pytest.fixture(scope="session")
def make_vsv(make_joint: Callable[..., BushingJoint]) -> Callable[..., Vsv]:
    """Return a maker of mechanisms; friction is a moment in ``paper`` and a traction in ``exact``."""

    def make(
        formulation: str = "exact",
        clearance: float = 20e-6,
        *,
        friction: str | None = None,
        gravity: float = 9.81,
        **joint: object,
    ) -> Vsv:
        model = friction or ("traction" if formulation == "exact" else "moment")
        bushing = make_joint(clearance, friction=model, **joint)
        return Vsv(formulation, LENGTHS, INERTIAS, DRIVE, TABLE_3, gravity, 0.012, bushing)

    return make


@pytest.fixture(scope="session")
def vsv_run(make_vsv: Callable[..., Vsv]) -> Callable[..., Columns]:
    """Return a runner that gives observed columns over ``t`` every 5 ms; equal runs are made once."""

    @cache
    def run(
        formulation: str = "exact",
        clearance: float = 20e-6,
        *,
        duration: float = 2.0 * math.pi,
        solver: str = "mebdf",
        rtol: float = 1e-4,
        atol_scale: float = 1.0,
        **options: object,
    ) -> Columns:
        start = "equilibrium" if formulation == "exact" else "centred"
        atol = tuple(atol_scale * value for value in ATOL)
        problem = vsv_problem(
            make_vsv(formulation, clearance, **options), duration=duration, start=start, atol=atol
        )
        times = np.append(np.arange(0.0, duration - 1e-9, 5e-3), duration)
        solution = integrate(problem, solver=solver, rtol=rtol, output_times=times)
        assert solution.complete, solution.failure
        columns = {name: solution.rows[:, k] for k, name in enumerate(OBSERVED)}
        return {"t": solution.t, **columns}

    return run
