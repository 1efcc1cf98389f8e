"""From a case to the description that assembly and equations begin with."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tribodyn.cases.beyond import lasts_a_cycle
from tribodyn.cases.case import demand
from tribodyn.cases.fields import Vector
from tribodyn.cases.temperature import Names
from tribodyn.contact import Liner
from tribodyn.core.arrays import FloatArray
from tribodyn.core.signals import Signal, constant, for_each_cycle, scaled
from tribodyn.joints import BushingGeometry, Friction
from tribodyn.joints.clearances import table_of
from tribodyn.joints.shapes import SHAPES
from tribodyn.mechanisms.bushing import Bearing
from tribodyn.mechanisms.general.actions import GIVEN, DriveKeys, LoadKeys
from tribodyn.mechanisms.general.case import MechanismCase
from tribodyn.mechanisms.general.description import (
    GROUND,
    Body,
    Clearance,
    Description,
    Drive,
    Element,
    Joint,
    Load,
    Spring,
)
from tribodyn.mechanisms.general.joints import frame
from tribodyn.mechanisms.general.kinds import KINDS
from tribodyn.mechanisms.general.parts import FLANGE, BodyKeys, ClearanceKeys, JointKeys, SpringKeys, unit
from tribodyn.mechanisms.general.races import race_axes

SIZES: Mapping[str, tuple[str, ...]] = {
    "cylinder": ("radius", "radial", "length", "pin_length", "axial", "axial_upper", "axial_lower", "flange"),
    "sphere": ("radius", "radial", "band"),
    "ball": ("radius", "radial"),
    "mesh": ("gap",),
}
"""Which keys of a clearance are dimensions of its shape."""


def bearings(case: MechanismCase) -> dict[str, Bearing]:
    """Return the shafts in bores of a mechanism by the names of their joints, without its equations."""
    return {
        name: _bearing(case, name, joint.real)
        for name, joint in case.joints.items()
        if joint.real is not None and joint.shape == "cylinder"
    }


def _bearing(case: MechanismCase, name: str, clearance: ClearanceKeys) -> Bearing:
    pair = case.of_pair(clearance)
    sizes = _hot(case, name, clearance, _sizes("cylinder", clearance))
    return Bearing(
        contact=pair.contact,
        pair=pair.surface_pair,
        geometry=BushingGeometry(sizes["radial"], sizes["radius"], sizes["length"]),
        liner=_liner(case, name, clearance),
        friction=Friction(clearance.friction_coefficient, "traction", clearance.slip_velocity),
        nodes=clearance.nodes_around or case.solver.grid.theta,
    )


def describe(case: MechanismCase) -> Description:
    """Return the mechanism of a case, with its contact laws tabulated."""
    bodies = {name: number for number, name in enumerate(case.bodies)}
    joints = {name: number for number, name in enumerate(case.joints)}
    return Description(
        bodies=tuple(_body(name, body) for name, body in case.bodies.items()),
        joints=tuple(_joint(case, name, joint, bodies) for name, joint in case.joints.items()),
        drives=tuple(_drive(name, drive, joints) for name, drive in case.drives.items()),
        loads=tuple(_load(case, name, load, bodies, joints) for name, load in case.loads.items()),
        springs=tuple(_spring(name, spring, bodies) for name, spring in case.springs.items()),
        gravity=np.array(case.gravity),
        speeds=tuple(_speeds(case)),
        elements=tuple(
            Element(name, type(keys), keys.legs(case.joints)) for _, name, keys in case.elements()
        ),
    )


def _body(name: str, body: BodyKeys) -> Body:
    first, second = (
        np.array(unit(body.first_axis, "first_axis")),
        np.array(unit(body.second_axis, "second_axis")),
    )
    axes = np.column_stack([first, second, np.cross(first, second)])
    inertia = axes @ np.diag(body.inertia) @ axes.T
    return Body(name, body.mass, np.array(body.centre), 0.5 * (inertia + inertia.T))


def _joint(case: MechanismCase, name: str, joint: JointKeys, bodies: Mapping[str, int]) -> Joint:
    clearance = joint.real
    return Joint(
        name=name,
        kind=joint.type,
        bodies=_two(joint.between, bodies),
        points=np.array([joint.point, joint.other_point or joint.point]),
        axes=_axes(case, joint),
        clearance=None if clearance is None else _clearance(case, name, joint, clearance),
        stiffness=_six(joint, joint.stiffness, joint.angular_stiffness),
        damping=_six(joint, joint.damping, joint.angular_damping),
        socket=int(clearance is not None and clearance.socket == joint.between[1]),
    )


def _two(names: tuple[str, str], bodies: Mapping[str, int]) -> tuple[int, int]:
    return bodies.get(names[0], GROUND), bodies.get(names[1], GROUND)


def _axes(case: MechanismCase, joint: JointKeys) -> FloatArray:
    """Return the two unit vectors of a joint, shape (2, 3); the second is across the first if not given."""
    if joint.type == "spherical" and joint.clearance is not None and joint.axis is None:
        first, second = race_axes(case, joint)
    else:
        first, second = np.array(unit(joint.axis or (0.0, 0.0, 1.0), "axis")), None
    if joint.second_axis is not None:
        second = np.array(unit(joint.second_axis, "second_axis"))
    if second is not None:
        return np.array([first, second])
    across = np.eye(3)[int(np.argmin(np.abs(first)))]
    second = across - first * (first @ across)
    return np.array([first, second / np.linalg.norm(second)])


def _six(joint: JointKeys, along: Vector | None, about: Vector | None) -> FloatArray:
    if joint.type != "spring-damper":
        return np.empty(0)
    return np.array([*(along or (0.0,) * 3), *(about or (0.0,) * 3)])


def _clearance(case: MechanismCase, name: str, joint: JointKeys, clearance: ClearanceKeys) -> Clearance:
    pair = case.of_pair(clearance)
    contact, surfaces = pair.contact, pair.surface_pair
    sizes = _sizes(joint.shape, clearance)
    if clearance.has_faces and clearance.flange is None:
        sizes["flange"] = FLANGE * sizes["radius"]
    facets = _facets(case, joint, clearance)
    if facets.size:
        sizes["edge"] = clearance.mesh_edge or float(np.ptp(facets.reshape(-1, 3), axis=0).max())
    sizes = _hot(case, name, clearance, sizes)
    grid, law = case.solver.grid, contact.law_of(surfaces)
    liner = _liner(case, name, clearance)
    return Clearance(
        shape=joint.shape,
        sizes=sizes,
        grid=(clearance.nodes_around or grid.theta, clearance.nodes_along or grid.z),
        roughness=surfaces.roughness_rms,
        law=law,
        table=table_of(
            clearance.contact,
            law,
            SHAPES[joint.shape](**sizes, **({"facets": facets} if facets.size else {})),
            onset=contact.onset_separation,
            smoothing_width=contact.smoothing_width,
            liner=liner,
        ),
        friction_coefficient=clearance.friction_coefficient,
        slip_velocity=clearance.slip_velocity,
        onset=contact.onset_separation,
        minimum_velocity=contact.least_entry_velocity,
        tensile_clip=contact.tensile_clip,
        contact=clearance.contact,
        facets=facets,
        form=clearance.form.form(),
        liner=liner,
        slides="position" in KINDS[joint.type].coordinates,
    )


def _sizes(shape: str, clearance: ClearanceKeys) -> dict[str, float]:
    """Return the dimensions that a case gives of a clearance [m]."""
    given = {key: getattr(clearance, key) for key in SIZES[shape]}
    return {key: float(size) for key, size in given.items() if size is not None}


def _liner(case: MechanismCase, name: str, clearance: ClearanceKeys) -> Liner | None:
    soft = case.of_pair(clearance).surfaces.bushing
    return clearance.liner.layer(soft, f"joints.{name}.clearance.liner")


def _hot(
    case: MechanismCase, name: str, clearance: ClearanceKeys, cold: dict[str, float]
) -> dict[str, float]:
    """Return the sizes of a clearance at the temperatures of the run [m].

    Of faces at both ends the play between the flanges of the shaft changes, shared as drawn. Against one face
    alone the shaft stands where it is drawn.
    """
    temperature = clearance.temperature
    if not temperature.changes:
        return cold
    joint = f"joints.{name}.clearance."
    pair = "" if clearance.pair is None else f"pairs.{clearance.pair}."
    keys = Names(f"{joint}radial", joint, f"{joint}temperature.", pair)
    surfaces = case.of_pair(clearance).surfaces
    geometry = BushingGeometry(cold["radial"], cold["radius"], cold.get("length", 0.0))
    warm = temperature.hot(geometry, surfaces, clearance.liner, keys)
    sizes = {"radius": warm.radius, "radial": warm.clearance, "length": warm.length}
    gaps = [cold.get(f"axial_{end}", cold.get("axial")) for end in ("upper", "lower")]
    if None not in gaps:
        play = sum(filter(None, gaps))
        left = (geometry.length + play) * (1.0 + temperature.strains(surfaces, keys)[0]) - warm.length
        words = f"the joint would seize along its axis: more than {1e6 * (play - left):.3g} um of play"
        demand(left > 0.0, f"{joint}temperature", f"{words} are needed at assembly")
        sizes |= {face: cold[face] * left / play for face in cold if face.startswith("axial")}
    if "pin_length" in cold:
        sizes["pin_length"] = cold["pin_length"] * (1.0 + temperature.strains(surfaces, keys)[0])
    return cold | {size: value for size, value in sizes.items() if size in cold}


def _facets(case: MechanismCase, joint: JointKeys, clearance: ClearanceKeys) -> FloatArray:
    """Return the triangles of a mesh in the axes of the joint, shape (n, 3, 3); none of other shapes."""
    corners = np.array(clearance.facets if joint.shape == "mesh" else ()).reshape(-1, 3, 3)
    return np.ascontiguousarray((corners - np.array(joint.point)) @ frame(*_axes(case, joint)))


def _drive(name: str, drive: DriveKeys, joints: Mapping[str, int]) -> Drive:
    coordinate, level = GIVEN[drive.gives]
    return Drive(name, joints[drive.joint], coordinate, level, drive.signal.signal())


def _load(
    case: MechanismCase, name: str, load: LoadKeys, bodies: Mapping[str, int], joints: Mapping[str, int]
) -> Load:
    return Load(
        name=name,
        body=bodies[load.body],
        point=np.array(load.point or case.bodies[load.body].centre),
        frame="line" if load.frame == "motion" and load.direction is not None else load.frame,
        signals=_components(case, load),
        joint=-1 if load.along is None else joints[load.along],
        slip_velocity=load.slip_rate
        if load.moment is not None and load.frame == "motion"
        else load.slip_velocity,
    )


def _components(case: MechanismCase, load: LoadKeys) -> tuple[Signal, ...]:
    """Return the six components of a load, which all follow its one force and its one moment."""
    direction = (1.0, 0.0, 0.0) if load.direction is None else unit(load.direction, "direction")
    found: list[Signal] = []
    for keys in (load.force, load.moment):
        signal = constant(0.0) if keys is None else keys.signal()
        if keys is not None and lasts_a_cycle(keys.times or (), case.period):
            signal = for_each_cycle(signal, case.period or 0.0, case.duration)
        found += [scaled(signal, share) if share else constant(0.0) for share in direction]
    return tuple(found)


def _spring(name: str, spring: SpringKeys, bodies: Mapping[str, int]) -> Spring:
    return Spring(
        name=name,
        bodies=_two(spring.between, bodies),
        points=np.array([spring.first_point, spring.second_point]),
        stiffness=spring.stiffness,
        damping=spring.damping,
        length=spring.drawn_length if spring.length is None else spring.length,
    )


def _speeds(case: MechanismCase) -> list[tuple[int, str, float]]:
    return [
        (number, coordinate, speed)
        for number, joint in enumerate(case.joints.values())
        for coordinate, speed in (("angle", joint.start_speed), ("position", joint.start_velocity))
        if speed is not None
    ]
