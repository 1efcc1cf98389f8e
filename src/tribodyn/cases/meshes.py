"""Triangles of STL files in a case: from the file that a key ``mesh`` names to the numbers in its place."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Final

from tribodyn.cases.entry import Entry, read_entry
from tribodyn.cases.expressions import is_unit
from tribodyn.cases.keys import Key, shown
from tribodyn.core.errors import InputError
from tribodyn.core.files import read_regular

MESH: Final = "mesh"
"""Name of a key that names a file; beside it stand those below."""
UNIT: Final = "mesh_unit"
FACETS: Final = "facets"
MOST: Final = 4000
"""Triangles that a case holds, at most: its text is read whole. Their longest edge makes finer nodes."""
LARGEST: Final = 5_000_000


def with_meshes_read(entries: Mapping[str, Entry], keys: Mapping[str, Key]) -> dict[str, Entry]:
    """Return the given values with corners of triangles in the place of files' names.

    Parameters
    ----------
    entries
        What was given, by dotted path.
    keys
        The keys of the case.
    """
    read = dict(entries)
    for path, entry in entries.items():
        table = path.removesuffix(MESH)
        if path == table or f"{table}{FACETS}" not in keys:
            continue
        key = keys[f"{table}{UNIT}"]
        given = _of_one(read.pop(f"{table}{UNIT}", None))
        unit = key.default if given is None else read_entry(key, given)
        assert isinstance(unit, float)
        name = str(read_entry(keys[path], read.pop(path)))
        try:
            corners = _corners((entry.folder or Path()) / name, unit)
        except InputError as error:
            raise InputError(f"given {shown(name)}: {error.reason}", key=path, source=entry.source) from None
        read[f"{table}{FACETS}"] = replace(entry, value=corners)
    return read


def _of_one(unit: Entry | None) -> Entry | None:
    """Return a unit as a quantity: ``mm`` is ``1 mm``."""
    if unit is None or not isinstance(unit.value, str) or not is_unit(unit.value.strip()):
        return unit
    return replace(unit, value=f"1 {unit.value}")


def _corners(file: Path, unit: float) -> str:
    """Return all coordinates of the corners as a case writes them."""
    # Imported here: few cases have a mesh.
    from tribodyn.joints.shapes.stl import read_stl

    try:
        facets = read_stl(read_regular(file, LARGEST))
    except OSError as error:
        reason = "there is no such file" if isinstance(error, FileNotFoundError) else error.strerror
        raise InputError(f"{reason}; its name is relative to the case file") from None
    if len(facets) > MOST:
        raise InputError(f"has {len(facets)} triangles; at most {MOST} are allowed here: export it coarser")
    return ", ".join(f"{unit * number:.9g}" for number in facets.ravel().tolist()) + " m"
