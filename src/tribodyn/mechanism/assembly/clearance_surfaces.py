"""The surfaces of joints with clearance, from the keys of a case."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any, Final, TypeAlias

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.case import demand, unit
from tribodyn.cases.groups import Surfaces
from tribodyn.cases.joint_keys import CONFORMAL, NOTHING
from tribodyn.cases.temperature import Names, time_followed
from tribodyn.contact import Liner
from tribodyn.contact.bulk import elastic_bodies
from tribodyn.core.errors import below
from tribodyn.core.signals import Signal
from tribodyn.joints import Friction
from tribodyn.joints.clearances import Clearance, contact_table
from tribodyn.joints.shapes import Ball, Cylinder, Guide, Mesh, Shape, Slot, Sphere
from tribodyn.kernels import dense
from tribodyn.lubrication import Film
from tribodyn.mechanism.frames import GROUND, cross, frame
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.model.parts import ClearanceKeys, JointKeys, PairKeys
from tribodyn.mechanism.shapes import SHAPES
from tribodyn.mechanisms.bushing import Bearing

_Sized: TypeAlias = Cylinder | Sphere | Ball | Guide | Slot
_COARSE: Final = (12, 2)  #: A grid, whose surfaces are as large as those of any.
NOT_WORN: Final[Mapping[str, float]] = {}


def bearings(case: MechanismCase) -> dict[str, Bearing]:
    """Return the shafts in bores of a mechanism by the names of their joints, without its equations."""
    return {
        name: _bearing(case, name, joint.real)
        for name, joint in case.joints.items()
        if joint.real is not None and SHAPES[joint.shape].BORE
    }


def _bearing(case: MechanismCase, name: str, keys: ClearanceKeys) -> Bearing:
    pair, shape = material_of(case, name), _hot(case, name, keys, _cold(case, case.joints[name], keys))
    assert isinstance(shape, Cylinder)
    return Bearing(
        contact=pair.contact,
        pair=pair.surface_pair,
        geometry=shape,
        liner=_liner(case, name, keys),
        friction=Friction(keys.friction_coefficient, "traction", keys.slip_velocity),
    )


def material_of(case: MechanismCase, name: str, depth: float = 0.0) -> PairKeys | MechanismCase:
    """Return surfaces, contact law and wear of a joint at the temperature of its bushing.

    A mean wear ``depth`` [m] has run its surfaces in.
    """
    keys = case.joints[name].real
    assert keys is not None
    pair = case.of_pair(keys)
    at = keys.temperature.material(f"joints.{name}.clearance.temperature.")
    ends = {path.rpartition(".")[2]: value for path, value in at.items()}
    of_bushing: dict[str, float] = {key: ends[key] for key in ("young_modulus", "hardness") if key in ends}
    bushing = pair.surfaces.bushing.model_copy(update=of_bushing)
    surfaces = pair.surfaces.model_copy(update={"bushing": bushing})
    rate: dict[str, float] = {key: ends[key] for key in ("specific_wear_rate",) if key in ends}
    update = {
        "surfaces": surfaces.run_in(depth, pair.wear.final_roughness),
        "wear": pair.wear.model_copy(update=rate),
    }
    return pair.model_copy(update=update)


def clearances_of(case: MechanismCase, depths: Mapping[str, float] = NOT_WORN) -> dict[str, Clearance]:
    """Return the clearances of all joints that are not ideal by their names, contact laws tabulated.

    ``depths`` are mean depths that have run surfaces in [m], by joint.
    """
    return {
        name: _clearance(case, name, joint, joint.real, depths.get(name, 0.0))
        for name, joint in case.joints.items()
        if joint.real is not None
    }


def _clearance(
    case: MechanismCase, name: str, joint: JointKeys, keys: ClearanceKeys, depth: float
) -> Clearance:
    pair = material_of(case, name, depth)
    contact, surfaces = pair.contact, pair.surface_pair
    law = contact.law_of(surfaces)
    liner, shape = _liner(case, name, keys), _shape(case, name, joint, keys)
    table = contact_table(
        keys.contact,
        law,
        shape,
        onset=contact.onset_separation,
        smoothing_width=contact.smoothing_width,
        liner=liner,
    )
    bulk = None
    if keys.under == CONFORMAL:
        bulk = elastic_bodies(table, law, max(surface.size for surface in shape.surfaces(_COARSE)))
    return Clearance(
        shape=shape,
        grid=_grid(case, keys, shape.clearance),
        roughness=surfaces.roughness_rms,
        law=law,
        table=table,
        hardness=math.inf if keys.under == NOTHING else surfaces.hardness,
        bulk=bulk,
        friction_coefficient=keys.friction_coefficient,
        slip_velocity=keys.slip_velocity,
        onset=contact.onset_separation,
        minimum_velocity=contact.least_entry_velocity,
        tensile_clip=contact.tensile_clip,
        contact=keys.contact,
        liner=liner,
        slides="position" in joint.kind.COORDINATES,
        film=_film(joint, shape, pair.surfaces),
        openings=_openings(case, name, joint, keys),
    )


def grid_of(case: MechanismCase, name: str, keys: ClearanceKeys) -> tuple[int, int]:
    """Return the nodes of a surface of a joint around and along; wear does not change them."""
    return _grid(case, keys, _shape(case, name, case.joints[name], keys).clearance)


def _grid(case: MechanismCase, keys: ClearanceKeys, clearance: float) -> tuple[int, int]:
    around, along = case.solver.grid.resolved(clearance, case.of_pair(keys).surface_pair.roughness_rms)
    return keys.nodes_around or around, keys.nodes_along or along


def _film(joint: JointKeys, shape: Shape, surfaces: Surfaces) -> Film | None:
    """Return the oil film of a joint at the temperatures of the run."""
    if joint.film is None:
        return None
    assert isinstance(shape, Cylinder)
    return joint.film.film(shape, surfaces)


def _liner(case: MechanismCase, name: str, keys: ClearanceKeys) -> Liner | None:
    soft = material_of(case, name).surfaces.bushing
    return keys.liner.layer(soft, f"joints.{name}.clearance.liner")


def _shape(case: MechanismCase, name: str, joint: JointKeys, keys: ClearanceKeys) -> Shape:
    """Return the shape of a clearance at the temperatures of the run."""
    with below(f"joints.{name}.clearance"):
        cold = _cold(case, joint, keys)
    return cold if isinstance(cold, Mesh) else _hot(case, name, keys, cold)


def _cold(case: MechanismCase, joint: JointKeys, keys: ClearanceKeys) -> Any:
    """Return the shape of a clearance as drawn."""
    axes = frame(*axes_of(case, joint))

    def local(points: FloatArray) -> FloatArray:
        return np.ascontiguousarray(dense.product(points - np.array(joint.point), axes))

    return SHAPES[joint.shape].of(keys, local)


def _hot(case: MechanismCase, name: str, keys: ClearanceKeys, cold: _Sized) -> _Sized:
    """Return the shape of a clearance at the temperatures of the run.

    Of faces at both ends the play between the flanges of the shaft changes, shared as drawn. Against one face
    alone the shaft stands where it is drawn.
    """
    temperature = keys.temperature
    if not temperature.changes:
        return cold
    names, surfaces = _names(name, keys), case.of_pair(keys).surfaces
    geometry = _geometry(cold)
    if isinstance(cold, Guide):
        return cold.grown_by(
            lambda distance: (
                temperature.hot(replace(geometry, radius=distance), surfaces, keys.liner, names).clearance
            )
        )
    warm = temperature.hot(geometry, surfaces, keys.liner, names)
    shape = replace(cold, radius=warm.radius, clearance=warm.clearance)
    if not isinstance(shape, Cylinder):
        return shape
    strain = temperature.strains(surfaces, names)[0]
    sizes: dict[str, Any] = {"length": warm.length}
    if len(shape.faces) == 2:
        play = sum(shape.faces.values())
        left = (geometry.length + play) * (1.0 + strain) - warm.length
        words = f"the joint would seize along its axis: more than {1e6 * (play - left):.3g} um of play"
        demand(left > 0.0, names.temperature.removesuffix("."), f"{words} are needed at assembly")
        gaps = {key: getattr(shape, key) for key in ("axial", "axial_upper", "axial_lower")}
        sizes |= {key: gap * left / play for key, gap in gaps.items() if gap is not None}
    if shape.pin_length is not None:
        sizes["pin_length"] = shape.pin_length * (1.0 + strain)
    return replace(shape, **sizes)


def _names(name: str, keys: ClearanceKeys) -> Names:
    """Return the prefix of a joint's keys, for refusals."""
    joint = f"joints.{name}.clearance."
    pair = "" if keys.pair is None else f"pairs.{keys.pair}."
    return Names(f"{joint}radial", joint, f"{joint}temperature.", pair)


def _geometry(shape: _Sized) -> Cylinder:
    """Return the dimensions that temperatures change: those of the cylinder about a ball, or in a channel."""
    return (
        shape if isinstance(shape, Cylinder) else Cylinder(shape.radius, shape.clearance, 2.0 * shape.radius)
    )


def _openings(
    case: MechanismCase, name: str, joint: JointKeys, keys: ClearanceKeys
) -> tuple[Signal | None, Signal | None]:
    """Return the growth of the radial clearance and of the play along the axis by temperatures over time."""
    temperature = keys.temperature
    if not temperature.tables:
        return None, None
    names, surfaces, cold = _names(name, keys), case.of_pair(keys).surfaces, _cold(case, joint, keys)
    geometry = _geometry(cold)
    followed = time_followed(case)
    temperature.check(geometry, surfaces, keys.liner, followed, names)
    radial, axial = temperature.opening(geometry, surfaces, keys.liner, names), None
    if isinstance(cold, Cylinder) and len(cold.faces) == 2:
        axial = temperature.play_opening(cold.length, sum(cold.faces.values()), surfaces, names)
        hot = _hot(case, name, keys, cold)
        assert isinstance(hot, Cylinder)
        when, least = axial.least(followed) if axial is not None else (0.0, 0.0)
        left = 1e6 * (sum(hot.faces.values()) + least)
        words = (
            f"the joint would seize along its axis: {when:.4g} s after the start {-left:.3g} um are missing"
        )
        demand(left > 0.0, f"{names.temperature}over_time", words)
    return radial, axial


_PARALLEL: Final = 1e-3  #: Sine of an angle below which two directions are taken for one.


def axes_of(case: MechanismCase, joint: JointKeys) -> FloatArray:
    """Return the two unit vectors of a joint, shape (2, 3); the second is across the first if not given."""
    if not joint.kind.AXIS and joint.clearance is not None and joint.axis is None:
        first, second = _race_axes(case, joint)
    else:
        first, second = np.array(unit(joint.axis or (0.0, 0.0, 1.0), "axis")), None
    if joint.second_axis is not None:
        second = np.array(unit(joint.second_axis, "second_axis"))
    if second is not None:
        return np.array([first, second])
    across = np.eye(3)[int(np.argmin(np.abs(first)))]
    second = across - first * dense.product(first, across)
    return np.array([first, second / dense.norm(second)])


def _race_axes(case: MechanismCase, joint: JointKeys) -> FloatArray:
    """Return axis and direction of angle zero of a joint that has no axis of its own, unit vectors (2, 3).

    The axis is normal to the plane of the joint and the mass centres of its two bodies, so that forces along
    the bodies meet the middle of the race. Where these lie on one line, or one body is the ground, other
    joints of the two bodies take their place, then the rest of the mechanism. Angle zero points to the first
    of these places.
    """
    point = np.array(joint.point)
    first: FloatArray | None = None
    for place in _places(case, joint):
        way = np.array(place) - point
        length = float(dense.norm(way))
        if length == 0.0:
            continue
        if first is None:
            first = way / length
            continue
        normal = cross(first, way / length)
        if dense.norm(normal) > _PARALLEL:
            return np.array([normal / dense.norm(normal), first])
    if first is None:
        return np.eye(3)[[2, 0]]
    across = cross(first, np.eye(3)[int(np.argmin(np.abs(first)))])
    return np.array([across / dense.norm(across), first])


def _places(case: MechanismCase, joint: JointKeys) -> Iterator[tuple[float, float, float]]:
    """Yield the places that the axis may follow from, the nearest relations first."""
    for body in joint.between:
        if body != GROUND:
            yield case.bodies[body].centre
    for other in case.joints.values():
        if (set(other.between) & set(joint.between)) - {GROUND}:
            yield other.point
    yield from (body.centre for body in case.bodies.values())
    yield from (other.point for other in case.joints.values())
