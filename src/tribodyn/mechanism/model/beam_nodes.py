"""Elastic bodies as nodes with mass and pieces without: joints of the type ``beam``.

Pieces without mass bend under forces at their ends as a whole beam does, whatever their number. Masses stand
at their ends, where Lobatto's rule has its places, and are those of the beam times its weights: so the rule
sums the kinetic energy, exactly that of a rigid beam. The nodes of body ``lever`` are ``lever:0``,
``lever:1`` and so on from its first point; the piece that ends at a node has its name. Whatever acts at a
point of the body has a node there, anything else is at the node in the middle.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.case import demand, group_at
from tribodyn.cases.keys import Value
from tribodyn.core.splines import gauss_lobatto
from tribodyn.kernels import dense
from tribodyn.mechanism.frames import frame
from tribodyn.mechanism.model.beam import SAME, BeamBodyKeys

_ELASTIC: Final = ("bodies.", ".elastic")
#: Of a cantilever: over the root of bending rigidity over mass per length, times the length squared.
_FIRST_FREQUENCY: Final = 1.8751040687119611**2
#: Keys of the points at which the first and the second body of a joint, spring or element are.
_ENDS: Final = (("first_point", "point"), ("second_point", "other_point", "point"))
#: The same of bodies that other tables name.
_SINGLE: Final = {"body": ("point",), "reference": ("reference_point", "point")}


@dataclass(frozen=True)
class Node:
    """A place of a beam [m] with its share of the mass [kg] and of the inertia [kg m²], shape (3, 3)."""

    place: FloatArray
    mass: float
    inertia: FloatArray


# Cases of a sweep have the same beams.
@lru_cache(maxsize=128)
def _divided(keys: BeamBodyKeys, cuts: tuple[float, ...]) -> tuple[list[Node], list[FloatArray]]:
    """Return nodes from end to end, and axes of the pieces between them as columns, the last along."""
    line, (area, moments, *_) = keys.line, keys.properties
    steps = np.diff(line, axis=0)
    corners = np.concatenate([[0.0], np.cumsum(np.linalg.norm(steps, axis=1))])
    total, nodes, axes = float(corners[-1]), [Node(line[0], 0.0, np.zeros((3, 3)))], list[FloatArray]()
    for begin, end, start, step in zip(corners[:-1], corners[1:], line, steps, strict=False):
        across = frame(step, np.array(keys.height_axis or (0.0, 0.0, 0.0)))
        marks = [begin]
        for cut in sorted(cuts):
            if marks[-1] + SAME * total < cut < end - SAME * total:
                marks.append(cut)
        for first, last in zip(marks, [*marks[1:], end], strict=True):
            places, weights = gauss_lobatto(max(2, round(keys.segments * (last - first) / total)) + 1)
            lengths = (keys.density or 0.0) * (last - first) * weights
            turned = dense.product(across * [moments[1], moments[0], np.sum(moments)], across.T)
            nodes[-1] = Node(
                nodes[-1].place, nodes[-1].mass + lengths[0] * area, nodes[-1].inertia + lengths[0] * turned
            )
            for place, length in zip(places[1:], lengths[1:], strict=True):
                way = (first - begin + place * (last - first)) / (end - begin)
                nodes.append(Node(start + way * step, length * area, length * turned))
                axes.append(across)
    return nodes, axes


def _body(mass: float, centre: FloatArray, inertia: FloatArray) -> dict[str, Value]:
    """Return the keys of a rigid body."""
    moments, axes = dense.eigh(inertia)
    found = {"centre": centre, "inertia": moments, "first_axis": axes[:, 0], "second_axis": axes[:, 1]}
    return {"mass": float(mass), **{key: tuple(values.tolist()) for key, values in found.items()}}


def _middle(nodes: Sequence[Node]) -> tuple[float, FloatArray]:
    """Return the mass of nodes [kg] and their mass centre [m]."""
    mass = math.fsum(node.mass for node in nodes)
    return mass, np.asarray(sum(node.mass * node.place for node in nodes) / mass)


def of_rigid(values: Mapping[str, Value]) -> dict[str, Value]:
    """Return mass, centre, inertia and axes of the bodies that are beams but not elastic, by dotted path."""
    found: dict[str, Value] = {}
    beams = (path.split(".")[1] for path in values if path.startswith("bodies.") and ".beam." in path)
    for name in dict.fromkeys(beams):
        nodes, _ = _divided(group_at(BeamBodyKeys, f"bodies.{name}.beam", values), ())
        mass, centre = _middle(nodes)
        inertia = np.zeros((3, 3))
        for node in nodes:
            arm = node.place - centre
            inertia += node.inertia + node.mass * (np.sum(arm * arm) * np.eye(3) - np.outer(arm, arm))
        found |= {f"bodies.{name}.{key}": value for key, value in _body(mass, centre, inertia).items()}
    return found


def with_nodes(values: dict[str, Value]) -> dict[str, Value]:
    """Return the values of a case in which nodes and pieces have taken the place of elastic bodies.

    ``values``: by dotted path [SI]. Raises InputError if something is beyond the ends of the beam that it
    names, or a body has keys of a rigid one.
    """
    found = values
    for name in elastic_keys(values).values():
        found = _with_nodes_of(found, name)
    return found


def elastic_keys(values: Mapping[str, object]) -> dict[str, str]:
    """Return the names of elastic bodies by the paths of the keys that let them bend."""
    before, after = _ELASTIC
    paths = (path for path in values if path.startswith(before) and path.endswith(after))
    return {path: path[len(before) : -len(after)] for path in paths}


def _with_nodes_of(values: Mapping[str, Value], name: str) -> dict[str, Value]:
    """Return the values with one elastic body in nodes."""
    prefix = f"bodies.{name}."
    others = [key for path in values if path.startswith(prefix) and (key := path[len(prefix) :]) != "elastic"]
    rigid = [key for key in others if not key.startswith("beam.")]
    words = "an elastic body has its line, section and density in its table beam: leave this out"
    demand(not rigid, prefix + "".join(rigid[:1]), words)
    demand(
        bool(others),
        f"{prefix}beam.points",
        "an elastic body needs its table beam, with the points of its line",
    )
    keys, acting = group_at(BeamBodyKeys, f"bodies.{name}.beam", values), dict(_acting(values, name))
    cuts = [
        _along(keys.line, point, name, path)
        for (path, _), (path, point) in acting.items()
        if point is not None
    ]
    nodes, axes = _divided(keys, tuple(cuts))
    places, middle = np.array([node.place for node in nodes]), _middle(nodes)[1]
    at = {
        key: f"{name}:{np.argmin(np.linalg.norm(places - (middle if point is None else point), axis=1))}"
        for key, (_, point) in acting.items()
    }
    found: dict[str, Value] = {}
    for path, value in values.items():
        if not path.startswith(prefix):
            found[path] = _renamed(path, value, at, name)
        elif f"{prefix}elastic" == path:
            for number, node in enumerate(nodes):
                for key, own in _body(node.mass, node.place, node.inertia).items():
                    found.setdefault(f"bodies.{name}:{number}.{key}", own)
    # What was given of a node or a piece by its own name goes before.
    return {**found, **_pieces(keys, name, nodes, axes), **found}


def _acting(values: Mapping[str, Value], name: str) -> Iterator[tuple[tuple[str, int], tuple[str, Any]]]:
    """Yield path and place of what names a body, with path and value of the point at which it acts."""
    for path, value in values.items():
        table, _, key = path.rpartition(".")
        if key == "between" and isinstance(value, tuple) and name in value:
            side = value.index(name)
            yield (path, side), _first(values, table, _ENDS[side])
        elif key in _SINGLE and value == name:
            yield (path, 0), _first(values, table, _SINGLE[key])


def _first(values: Mapping[str, Value], table: str, keys: Sequence[str]) -> tuple[str, Any]:
    """Return path and value of the first of some keys of a table that is given; no value without any."""
    paths = [f"{table}.{key}" for key in keys]
    path = next((path for path in paths if path in values), paths[-1])
    return path, values.get(path)


def _renamed(path: str, value: Value, at: Mapping[tuple[str, int], str], name: str) -> Value:
    """Return a value in which the node at the right place stands for the body."""
    if path.endswith(".clearance.socket") and value == name:
        joint = path.removesuffix("clearance.socket") + "between"
        return next((node for (other, _), node in at.items() if other == joint), value)
    if isinstance(value, tuple):
        return tuple(at.get((path, side), part) for side, part in enumerate(value))  # type: ignore[return-value]
    return at.get((path, 0), value)


def _along(line: FloatArray, point: Sequence[float], name: str, path: str) -> float:
    """Return the way along a line to a point [m]; refuse one beyond its ends."""
    steps = np.diff(line, axis=0)
    lengths = np.linalg.norm(steps, axis=1)
    begins = np.concatenate([[0.0], np.cumsum(lengths)])
    found = []
    for start, step, length, begin in zip(line, steps, lengths, begins, strict=False):
        way = float(np.sum((np.array(point) - start) * step) / length)
        inside = min(max(way, 0.0), float(length))
        distance = float(np.linalg.norm(start + inside / length * step - point))
        found.append((distance, float(begin) + inside, abs(way - inside)))
    _, place, over = min(found)
    beyond = over > SAME * begins[-1] and place in (0.0, float(begins[-1]))
    words = (
        f"this is {over * 1e3:.4g} mm beyond the end of the elastic body {name}: let its points reach there"
    )
    demand(not beyond, path, words)
    return place


def _pieces(
    keys: BeamBodyKeys, name: str, nodes: Sequence[Node], axes: Sequence[FloatArray]
) -> dict[str, Value]:
    """Return the joints between nodes."""
    (young, shear, _), (area, moments, torsion, factor, section) = keys.moduli, keys.properties
    total = float(np.sum(np.linalg.norm(np.diff(keys.line, axis=0), axis=1)))
    frequency = _FIRST_FREQUENCY * math.sqrt(young * min(moments) / ((keys.density or 0.0) * area)) / total**2
    same: dict[str, Value] = {
        "type": "beam",
        "axial_rigidity": young * area,
        "torsional_rigidity": shear * torsion,
        "bending_rigidity": tuple(young * moment for moment in moments),
        "damping_time": 2.0 * keys.damping_ratio / frequency,
        "section_area": area,
        **({"shear_rigidity": (shear * factor * area,) * 2} if factor else {}),
        **({"section_moduli": section} if section else {}),
    }
    found: dict[str, Value] = {}
    for number, (before, node, across) in enumerate(zip(nodes[:-1], nodes[1:], axes, strict=True), 1):
        own: dict[str, Value] = {
            "between": (f"{name}:{number - 1}", f"{name}:{number}"),
            "point": tuple(node.place.tolist()),
            "axis": tuple((node.place - before.place).tolist()),
            "second_axis": tuple(across[:, 0].tolist()),
            "beam_length": float(np.linalg.norm(node.place - before.place)),
        }
        found |= {f"joints.{name}:{number}.{key}": value for key, value in (same | own).items()}
    return found
