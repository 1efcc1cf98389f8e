"""An elastic lever beside the geometrically exact beam of Exudyn, where that is installed."""

from itertools import pairwise

import numpy as np
import pytest

import tribodyn as td
from tribodyn.mechanisms.catalogue import parse_case

LENGTH, WIDTH, HEIGHT = 50e-3, 10e-3, 3e-3
MODULUS, DENSITY, POISSON = 114e9, 4430.0, 0.34
PIECES, FINE = 8, 32  #: Of ours, and of Exudyn's, whose straight pieces converge from below.
LEVER = """
case = "mechanism"
run.analysis = "static"
run.duration = "10 ms"
[bodies.lever]
elastic = "beam"
[bodies.lever.beam]
points = "0, 0, 0, 50, 0, 0 mm"
width = "10 mm"
height = "3 mm"
height_axis = [0, 0, 1]
young_modulus = "114 GPa"
poisson_ratio = 0.34
density = "4430 kg/m^3"
segments = 8
[joints.clamp]
type = "fixed"
between = ["ground", "lever"]
point = "0, 0, 0 mm"
[loads.pin]
body = "lever"
point = "50, 0, 0 mm"
direction = [0, 0, 1]
force = "{} N"
"""


def tip_by_exudyn(force: float) -> np.ndarray:
    """Return the place of the tip along and across, and its turn [m, rad]."""
    exudyn = pytest.importorskip("exudyn")
    from exudyn import itemInterface as items

    system = exudyn.SystemContainer().AddSystem()
    area, bending = WIDTH * HEIGHT, MODULUS * WIDTH * HEIGHT**3 / 12.0
    shear = 5.0 / 6.0 * area * MODULUS / (2.0 * (1.0 + POISSON))
    places = np.linspace(0.0, LENGTH, FINE + 1)
    nodes = [system.AddNode(items.NodeRigidBody2D(referenceCoordinates=[x, 0.0, 0.0])) for x in places]
    for pair in pairwise(nodes):
        beam = items.ObjectBeamGeometricallyExact2D(
            nodeNumbers=list(pair),
            length=LENGTH / FINE,
            massPerLength=DENSITY * area,
            crossSectionInertia=DENSITY * WIDTH * HEIGHT**3 / 12.0,
            bendingStiffness=bending,
            axialStiffness=MODULUS * area,
            shearStiffness=shear,
        )
        system.AddObject(beam)
    ground = system.AddNode(items.NodePointGround())
    fixed = system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
    for coordinate in range(3):
        held = system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=nodes[0], coordinate=coordinate))
        system.AddObject(items.CoordinateConstraint(markerNumbers=[fixed, held]))
    tip = system.AddMarker(items.MarkerNodePosition(nodeNumber=nodes[-1]))
    system.AddLoad(items.Force(markerNumber=tip, loadVector=[0.0, force, 0.0]))
    system.Assemble()
    settings = exudyn.SimulationSettings()
    settings.staticSolver.numberOfLoadSteps = 10
    settings.staticSolver.verboseMode = 0
    settings.staticSolver.newton.relativeTolerance = 1e-6
    settings.solution.file.write = False
    system.SolveStatic(settings)
    moved = np.array(system.GetNodeOutput(nodes[-1], exudyn.OutputVariableType.Coordinates))
    return np.array([LENGTH, 0.0, 0.0]) + moved


@pytest.mark.parametrize("force", [17.0, 3000.0])
def test_a_levers_tip_is_where_exudyn_has_it(force: float) -> None:
    known = tip_by_exudyn(force)
    found = td.simulate(parse_case(LEVER.replace("{}", str(force)), "test")).isel(time=-1)
    place = found["position"].sel(body=f"lever:{PIECES}").values
    w, _, y, _ = found["orientation"].sel(body=f"lever:{PIECES}").values
    # The turn is about −y where the tip rises along z.
    assert [place[0], place[2], -2.0 * np.arctan2(y, w)] == pytest.approx(known, rel=1e-2)
