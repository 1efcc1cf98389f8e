"""Measures of the contacts of a run's joints, and of the same attitudes on a finer grid."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.core.errors import Stopped
from tribodyn.core.problem import skip
from tribodyn.core.quantities import Record
from tribodyn.joints.clearances import Clearance, Place, SurfaceLaw, assemble, places, pose_at
from tribodyn.joints.point_contact import SURFACE, Touch
from tribodyn.joints.shapes import Ball, Cylinder, Sphere
from tribodyn.kernels.joints.surface.data import GAP, NORMAL, PLASTIC, POSITION, SurfaceData
from tribodyn.kernels.joints.surface.joint import report
from tribodyn.kernels.joints.surface.memory import SurfaceMemory, new_memory
from tribodyn.kernels.joints.surface.tilt import LINE, WHOLE
from tribodyn.mechanism.frames import frame
from tribodyn.mechanisms.bushing import loading
from tribodyn.mechanisms.self_checks import (
    instant,
    named,
    of_contact,
    of_damping_pressure,
    of_load,
    of_plastic,
)
from tribodyn.wear import between_edges, resampled

_NOTED: Final = 4  #: Surfaces of which the same is noted.
_SAMPLES: Final = 24
_FINER: Final = 4
_WRENCH: Final = ("F_cx", "F_cy", "F_cz", "M_cx", "M_cy", "M_cz")
_ALL: Final = slice(None)
#: Values that decide about the grid of a joint and the forces on it at rest, beside its wear.
_DECIDING: Final = (*(field.name for field in fields(SurfaceLaw)), "shape", "grid")


@dataclass(frozen=True)
class Contacts:
    """The contacts of all joints with clearance."""

    clearances: tuple[Clearance, ...]  #: Of the joints.
    numbers: tuple[int, ...]  #: Of these joints among all.
    names: tuple[str, ...]  #: Of the surfaces, shape (n_surfaces,).
    places: tuple[Place, ...]  #: Where they lie among all nodes.

    @property
    def touches(self) -> list[Touch]:
        """Both sides of each surface."""
        return [_touch(self.clearances[place.joint], place) for place in self.places]

    def numbers_of(
        self,
        data: SurfaceData,
        rows: Mapping[str, FloatArray],
        peaks: Mapping[str, FloatArray],
        openings: FloatArray,
    ) -> dict[str, FloatArray]:
        """Return the load measures of the surfaces and their grid errors, shape (n_surfaces,) each.

        ``data``: what the kernels of the run read, with its wear; ``rows``: observed of all couplings, shape
        (n_t, n_couplings) or (n_t, n_couplings, size) each; ``peaks``: what was largest or least of each
        surface; ``openings``: what temperatures have added to radial clearances and plays [m], shape (n_t,
        n_joints, 2), of the joints with clearance.
        """
        loads = [
            loading(self.clearances[place.joint].law, touch, pressure, separation)
            for place, touch, pressure, separation in zip(
                self.places, self.touches, peaks["pressure_peak"], peaks["separation_least"], strict=True
            )
        ]
        error, at_rest = self._on_finer_grid(data, rows, openings)
        return {
            "roughness": np.array(data.surfaces["roughness"]),
            "hardness_share": np.array([load["hardness_share"] for load in loads]),
            "real_area_share": np.array([load["real_area_share"] for load in loads]),
            "grid_force_error": error,
            "pressure_at_rest": at_rest,
        }

    def warnings(
        self, peaks: Mapping[str, FloatArray], found: Mapping[str, FloatArray], t_end: float
    ) -> list[str]:
        """Return remarks on each surface; ``found`` is from :meth:`numbers_of`."""
        messages = []
        for s, (name, touch) in enumerate(zip(self.names, self.touches, strict=True)):
            load = {key: float(found[key][s]) for key in ("hardness_share", "real_area_share")}
            of_surface = of_contact(
                touch,
                separation=float(peaks["separation_least"][s]),
                clipped=float(peaks["tensile_clip_time"][s]) / t_end if t_end > 0.0 else 0.0,
                grid_error=float(found["grid_force_error"][s]),
                grid=self.clearances[self.places[s].joint].grid,
                keys=f"joints.{name.partition(':')[0]}.clearance.nodes_around and nodes_along",
            )
            when = instant(float(peaks["pressure_peak_time"][s]))
            plastic = of_plastic(float(peaks[PLASTIC.name][s]) if PLASTIC.name in peaks else 0.0, when)
            messages += named(name, [*of_surface, *(plastic or of_load(load, when))])
        return messages

    def notes(self, peaks: Mapping[str, FloatArray], found: Mapping[str, FloatArray]) -> list[str]:
        """Return a remark on pressures with damping, of many surfaces that with the largest share.

        Of a joint the surface with the largest pressure counts: at that attitude others carry less.
        """
        pressure, at_rest = peaks["pressure_peak"], found["pressure_at_rest"]
        hardest = {self.places[s].joint: s for s in np.argsort(np.nan_to_num(pressure)).tolist()}
        messages = {
            s: text
            for s in hardest.values()
            for text in named(self.names[s], [of_damping_pressure(float(pressure[s]), float(at_rest[s]))])
        }
        most = sorted(messages, key=lambda s: float(at_rest[s] - pressure[s]))[:_NOTED]
        left_out = len(messages) - len(most)
        more = [f"The same of {left_out} more surfaces, where damping carries less."] if left_out else []
        return [messages[s] for s in sorted(most)] + more

    def _on_finer_grid(
        self, data: SurfaceData, rows: Mapping[str, FloatArray], openings: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the error of the contact force, and the pressure of surfaces at rest, of each surface.

        The error is the largest at some attitudes of the run, over the largest sum of the forces on the
        surfaces of the joint: those on opposite walls cancel each other. The pressure is that of the attitude
        in which that of the run was largest, 0 if not known. Both are NaN from where the caller stopped it.
        """
        n_rows, n_surfaces = rows["tilt_x"].shape[0], len(self.places)
        error, at_rest = np.full(n_surfaces, np.nan), np.zeros(n_surfaces)
        if not n_rows:
            return error, at_rest
        some = np.unique(np.linspace(0, n_rows - 1, _SAMPLES).astype(int)).tolist()
        chosen, memory = _Finer(self.places, data), new_memory(data)
        # Equal joints one after the other: their grid is made once, and the memory holds one at a time.
        joints = sorted(enumerate(self.clearances), key=lambda pair: chosen.key(*pair))
        for j, clearance in joints:
            if clearance.contact != SURFACE:
                continue
            own, number = slice(int(data.joints[j]), int(data.joints[j + 1])), self.numbers[j]
            tilt = float(data.surfaces["tilt"][own].max())
            poses = [_pose(rows, number, row, openings[row, j], tilt) for row in some]
            try:
                fine = chosen.grid(j, clearance)
                pairs = [
                    (_carried(data, memory, j, pose, own), _carried(*fine, 0, pose, _ALL))
                    for pose in poses
                    if not skip()
                ]
            except Stopped:
                skip()
                pairs = []
            if len(pairs) < len(poses):
                at_rest[own] = np.nan
                continue
            found, exact = np.moveaxis(np.array(pairs), 1, 0)
            arm = float(np.max(np.linalg.norm(fine[0].nodes[POSITION:NORMAL], axis=0)))
            largest = float(np.max(_size(exact, arm).sum(axis=1)))
            off = np.max(np.linalg.norm((found - exact)[..., :3], axis=-1), axis=0)
            error[own] = off / largest if largest > 0.0 else 0.0
            hardest = int(np.argmax(rows["pressure_max"][:, number]))
            pose = _pose(rows, number, hardest, openings[hardest, j], tilt)
            at_rest[own] = _reported(*fine, 0, pose)["p_max"]
        return error, at_rest


class _Finer:
    """Joints with their wear on grids finer in both directions, each alone; equal ones share theirs."""

    def __init__(self, places: Sequence[Place], data: SurfaceData) -> None:
        self._places, self._data = places, data
        self._last: tuple[bytes, tuple[SurfaceData, SurfaceMemory]] | None = None

    def key(self, j: int, clearance: Clearance) -> bytes:
        """Return the values from which the grid of a joint follows."""
        facts = tuple(getattr(clearance, name) for name in _DECIDING)
        return _content((facts, tuple(self._depths(j))))

    def grid(self, j: int, clearance: Clearance) -> tuple[SurfaceData, SurfaceMemory]:
        """Return the finer grid of a joint and a memory for it.

        Raises Stopped if the caller wants to stop.
        """
        key = self.key(j, clearance)
        if self._last is None or self._last[0] != key:
            self._last = None
            finer = [replace(clearance, grid=(_FINER * clearance.grid[0], _FINER * clearance.grid[1]))]
            own = [place for place in self._places if place.joint == j]
            there = places(finer)
            pairs = zip(self._depths(j), own, there, strict=True)
            fine = assemble(finer, np.concatenate([_resampled(*pair) for pair in pairs]), there)
            self._last = key, (fine, new_memory(fine))
        return self._last[1]

    def _depths(self, j: int) -> list[FloatArray]:
        """Return the wear depths of the surfaces of a joint [m]."""
        own = [place for place in self._places if place.joint == j]
        return [self._data.nodes[GAP, place.nodes] - place.surface.gap for place in own]


def _content(value: object) -> bytes:
    """Return bytes that are equal where the content of two values is."""
    if isinstance(value, np.ndarray):
        return repr(value.shape).encode() + value.tobytes()
    if isinstance(value, tuple):
        return b"(%s)" % b",".join(map(_content, value))
    if is_dataclass(value):
        return type(value).__name__.encode() + _content(tuple(getattr(value, f.name) for f in fields(value)))
    return repr(value).encode()


def _touch(clearance: Clearance, place: Place) -> Touch:
    """Return both sides of a surface; faces do not curve round each other, nor does a mesh."""
    shape, radial, bore = clearance.shape, np.nan, np.nan
    if isinstance(shape, (Cylinder, Sphere, Ball)) and not place.surface.name.endswith("face"):
        radial, bore = shape.clearance, shape.radius + shape.clearance
    of_law = clearance.roughness, clearance.table, clearance.contact, clearance.liner
    return Touch(*of_law, radial, bore, clearance.bulk, place.surface.size)


def _resampled(depth: FloatArray, place: Place, there: Place) -> FloatArray:
    """Return a wear depth at the nodes of a finer grid; nodes in no order are the same there."""
    if there.surface.area.size == depth.size:
        return depth
    if not np.any(np.abs(depth) > np.spacing(place.surface.gap)):
        return np.zeros(there.surface.area.size)
    (rows, angles), (fine_rows, fine_angles) = (tuple(one.surface.axes.values()) for one in (place, there))
    field = depth.reshape(place.surface.field_shape)
    if place.surface.tilt in (WHOLE, LINE):
        return between_edges(between_edges(field, rows, fine_rows), angles, fine_angles, axis=1).ravel()
    return resampled(field, rows, fine_rows, fine_angles.size).ravel()


def _pose(rows: Mapping[str, FloatArray], number: int, row: int, opening: FloatArray, tilt: float) -> Record:
    """Return the attitude of the shaft of a joint, at rest, as its surfaces with their tilt see it."""
    tilt_x, tilt_y = rows["tilt_x"][row, number], rows["tilt_y"][row, number]
    if tilt == LINE:
        tilt_x = tilt_y = 0.0
    twist = rows["joint_angle"][row, number] if tilt in (WHOLE, LINE) else 0.0
    across = np.array([portable.cos(twist), portable.sin(twist), 0.0])
    axes = frame(np.array([tilt_y, -tilt_x, 1.0]), across)
    pose = pose_at(rows["displacement"][row, number], axes)
    pose.opening[:] = opening
    return pose


def _reported(data: SurfaceData, memory: SurfaceMemory, j: int, pose: Record) -> Record:
    """Return the reports of all surfaces, those of joint ``j`` filled; shafts at rest leave no memory."""
    report(data, memory, j, pose)
    return memory.reports


def _carried(data: SurfaceData, memory: SurfaceMemory, j: int, pose: Record, own: slice) -> FloatArray:
    """Return contact force [N] and moment [N m] on the surfaces of a joint, shape (n, 6)."""
    reports = _reported(data, memory, j, pose)
    return np.stack([reports[name][own] for name in _WRENCH], axis=-1)


def _size(wrench: FloatArray, arm: float) -> FloatArray:
    """Return the larger of force and moment over ``arm`` [N]: the forces of a couple cancel each other."""
    force, moment = np.split(wrench, 2, axis=-1)
    return np.asarray(np.maximum(np.linalg.norm(force, axis=-1), np.linalg.norm(moment, axis=-1) / arm))
