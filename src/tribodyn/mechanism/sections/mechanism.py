"""The mechanism in space: every body drawn from its joints, at the frames."""

from typing import Any, Final

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.mechanism.assembly.skeleton import MM, Mark, Skeleton, case_of, outline_at, skeleton, view
from tribodyn.mechanism.model.body import BodyKeys, body_solid
from tribodyn.mechanism.results.copies import worst_copies
from tribodyn.mechanism.sections.scene import clearances, forces, magnified
from tribodyn.views.charts import LOOKS
from tribodyn.views.encode import packed
from tribodyn.views.playback import playback_times
from tribodyn.views.section import Payload, Section


def at_frames(dataset: xr.Dataset) -> tuple[FloatArray, FloatArray] | None:
    """Return positions [m] and unit quaternions at the frames, (n_frames, n_bodies, 3) and (…, 4).

    None where there is no motion to draw: a single row, or a body that is nowhere.
    """
    return at_times(dataset, playback_times(dataset))


def at_times(dataset: xr.Dataset, frames: FloatArray) -> tuple[FloatArray, FloatArray] | None:
    """Return the same at other times [s], shape (n_frames,)."""
    time = dataset["time"].values
    if min(time.size, frames.size) < 2:
        return None
    position, orientation = (
        _between(frames, time, dataset[name].values) for name in ("position", "orientation")
    )
    length = np.linalg.norm(orientation, axis=-1, keepdims=True)
    if not (np.isfinite(position).all() and np.all(length > 0.0)):
        return None
    return position, orientation / length


def _between(frames: FloatArray, time: FloatArray, values: FloatArray) -> FloatArray:
    """Return values at frames by straight lines between rows."""
    k = np.clip(np.searchsorted(time, frames, side="right") - 1, 0, time.size - 2)
    share = ((frames - time[k]) / (time[k + 1] - time[k]))[:, None, None]
    return np.asarray((1.0 - share) * values[k] + share * values[k + 1])


def data(dataset: xr.Dataset) -> Payload | None:
    """Return the points of bodies and joints at the frames [mm], and from where to look."""
    case, motion = case_of(dataset), at_frames(dataset)
    if case is None or motion is None:
        return None
    drawn, (position, orientation) = skeleton(case), motion
    bodies = [drawn.lines(b, position[:, b], orientation[:, b]) for b in range(len(drawn.bodies))]
    real = clearances(dataset, case, drawn, orientation)
    solids = [_solid(drawn, b, body, position, orientation) for b, body in enumerate(case.bodies.values())]
    marks = [_mark(drawn, mark, position, orientation) for mark in drawn.marks]
    outlines = [outline_at(drawn, outline, position, orientation) for outline in drawn.outlines]
    shown = (*bodies, *(mark[:, 0] for mark in marks), *outlines)
    everywhere = np.concatenate([part.reshape(-1, 3) for part in shown])
    low, high = everywhere.min(axis=0), everywhere.max(axis=0)
    eye, up = view(everywhere)
    marked = tuple(worst_copies(dataset)) if "output_error" in dataset else ()
    return {
        "size": float(np.linalg.norm(high - low)),
        "eye": eye.tolist(),
        "up": up.tolist(),
        "bodies": [
            _body(name, k, points) | {"solid": solid} | _marked(name, marked)
            for k, (name, points, solid) in enumerate(zip(drawn.bodies, bodies, solids, strict=True))
        ],
        "joints": [
            {
                "name": mark.name,
                "real": mark.real,
                "grounded": mark.grounded,
                "points": packed(points),
                "clearance": real.get(mark.name),
            }
            for mark, points in zip(drawn.marks, marks, strict=True)
        ],
        "magnification": magnified(real.values()),
        "forces": forces(dataset, case, drawn, position, orientation),
        "springs": [packed(outline_at(drawn, line, position, orientation)) for line in drawn.springs],
        "outlines": [
            {"colour": _colour(outline[0][0]), "n": points.shape[1], "points": packed(points)}
            for outline, points in zip(drawn.outlines, outlines, strict=True)
        ],
    }


def _body(name: str, number: int, points: FloatArray) -> dict[str, Any]:
    """Return a body as the script reads it: lines from the first point, or from the middle, to the others."""
    hub = points.mean(axis=1, keepdims=True)
    spread = points if points.shape[1] == 2 else np.concatenate([hub, points], axis=1)
    return {"name": name, "colour": _colour(number), "n": spread.shape[1], "points": packed(spread)}


def _marked(name: str, copies: tuple[str, ...]) -> dict[str, str]:
    """Return the colour of a body of the copy furthest from the mean; nothing for others, which are grey."""
    if not copies:
        return {}
    return {"colour": "vermilion" if name.partition(":")[0].endswith(copies) else "grey"}


def _solid(
    drawn: Skeleton, number: int, body: BodyKeys, position: FloatArray, orientation: FloatArray
) -> dict[str, Any] | None:
    """Return the solid of a body as the script reads it [mm]; None where its keys give none."""
    found = body_solid(body)
    if found is None:
        return None
    points = drawn.moved(found.points, number, position[:, number], orientation[:, number])
    triangles = None if found.triangles is None else packed(found.triangles)
    sizes = {"radius": MM * found.radius, "inner": MM * found.inner, "triangles": triangles}
    return {"n": points.shape[1], "points": packed(points)} | sizes


def _colour(body: int) -> str:
    """Return the colour of a body; the ground has one too."""
    return str(LOOKS[(body + 1) % len(LOOKS)][0])


def _mark(drawn: Skeleton, mark: Mark, position: FloatArray, orientation: FloatArray) -> FloatArray:
    """Return a joint at the frames and a point one metre along its axis [mm]; twice the same for a ball."""
    tip = mark.point if mark.axis is None else mark.point + mark.axis
    points = np.array([mark.point, tip])
    return drawn.moved(points, mark.body, position[:, mark.body], orientation[:, mark.body])


SECTION: Final = Section(
    name="mechanism",
    title="The mechanism",
    caption=(
        "Bodies with a shape in their sizes, others as rods between their joints. Pins and balls in bores "
        "move magnified. Of copies the one furthest from the mean is in vermilion. "
        "Springs show as coils, other elements as thin lines. "
        "Arrows are forces and moments of joints on their second bodies, and of loads where they act. "
        "Drag to turn it, or use the arrow keys."
    ),
    needs=("position", "orientation", "body", "joint"),
    widget="linkage",
    data=data,
    still="mechanism",
)
