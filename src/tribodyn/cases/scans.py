"""Files of a case, scans of surfaces and triangles of STL files: from a key that names one to its numbers.

A scan is read when the case is built, and its numbers take its place: what is simulated, stored and
shown never depends on the file again. Of the equivalent rough surface only the sum of both counts, so
``asperities.surface`` names the scan of that sum, or of the one surface that is rough, and makes the
trunnion smooth; with a scan of each surface their spectral moments add up.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from tribodyn.cases.expressions import is_unit
from tribodyn.cases.fields import Entry, read_entry
from tribodyn.cases.keys import Key, shown, toml_string
from tribodyn.cases.units import from_si, to_si
from tribodyn.core.errors import InputError
from tribodyn.core.files import read_regular

if TYPE_CHECKING:
    from tribodyn.surfaces import MeasuredSurface, Treatment


COMBINED: Final = "asperities.surface"
EACH: Final = ("surfaces.trunnion.surface", "surfaces.bushing.surface")
_ROUGHNESS: Final = ("surfaces.trunnion.roughness", "surfaces.bushing.roughness")
_OPTIONS: Final = ("level", "filter", "short_cutoff", "long_cutoff")
_OPTION_PATHS: Final = tuple(f"asperities.{name}" for name in _OPTIONS)
ORIGIN: Final = "asperities.origin"
#: Keys that a scan gives values to.
FOLLOWING: Final = (*_ROUGHNESS, "asperities.density", "asperities.radius")

#: Pairs of keys of which only one may be given.
ALTERNATIVES: Final = (
    *((COMBINED, path) for path in (*EACH, *FOLLOWING, ORIGIN)),
    *((scan, path) for scan in EACH for path in (*FOLLOWING, ORIGIN)),
)

#: Reads a length with its unit as metres, for :func:`tribodyn.surfaces.read_scan`.
length: Final = partial(to_si, like="m")
_LONGEST_ORIGIN: Final = 200


@dataclass(frozen=True)
class Equivalent:
    """Roughness and asperities of one rough surface or two, with their origin."""

    roughness: tuple[float, float]  #: σ of trunnion and bushing [m].
    #: Asperities of the equivalent rough surface [1/m², m].
    density: float
    radius: float
    origin: str  #: Files and treatment, on one line.

    def values(self) -> dict[str, str]:
        """Return the values of keys as a case file writes them; they read back to the bit."""
        trunnion, bushing = (from_si(sigma, "um") for sigma in self.roughness)
        numbers = (trunnion, bushing, from_si(self.density, "1/um^2"), from_si(self.radius, "um"))
        return {**dict(zip(FOLLOWING, numbers, strict=True)), ORIGIN: self.origin}

    def block(self) -> str:
        """Return the values as tables of a case file."""
        tables: dict[str, list[str]] = {}
        for path, value in self.values().items():
            table, _, name = path.rpartition(".")
            tables.setdefault(table, []).append(f"{name} = {toml_string(value)}")
        return "\n".join("\n".join([f"[{table}]", *lines, ""]) for table, lines in tables.items())


def equivalent(*surfaces: MeasuredSurface) -> Equivalent:
    """Return the equivalent rough surface of one that is rough against a smooth trunnion, or of two."""
    from tribodyn.surfaces import asperities

    both = surfaces[0].moments if len(surfaces) == 1 else surfaces[0].moments + surfaces[1].moments
    found = asperities(both)
    sigmas = [surface.sigma for surface in surfaces]
    names = " and ".join(Path(surface.surface.source).name for surface in surfaces)
    origin = f"{names}: {_in_words(surfaces[0].treatment)}"
    return Equivalent(
        (0.0, sigmas[0]) if len(sigmas) == 1 else (sigmas[0], sigmas[1]),
        found.density,
        found.radius,
        "".join(c for c in origin if c.isprintable())[-_LONGEST_ORIGIN:],
    )


def with_scans_read(entries: Mapping[str, Entry], keys: Mapping[str, Key]) -> dict[str, Entry]:
    """Return the given values with the numbers of scans in the place of their files.

    ``entries``: what was given, by dotted path; ``keys``: the keys of the case; sets of surfaces may stand in
    several tables.
    """
    read = dict(entries)
    for table in tables_of_surfaces(keys):
        if not any(f"{table}{path}" in read for path in (COMBINED, *EACH, *_OPTION_PATHS)):
            continue
        own = {path.removeprefix(table): entry for path, entry in read.items() if path.startswith(table)}
        there = {path.removeprefix(table): key for path, key in keys.items() if path.startswith(table)}
        try:
            found = _with_scans_read(own, there)
        except InputError as error:
            raise InputError(error.reason, key=f"{table}{error.key}", source=error.source) from None
        read = {path: entry for path, entry in read.items() if not path.startswith(table)}
        read |= {f"{table}{path}": entry for path, entry in found.items()}
    return read


def tables_of_surfaces(keys: Iterable[str]) -> list[str]:
    """Return the prefix of the paths of sets of surfaces: nothing, or a table and its dot."""
    return [path.removesuffix(COMBINED) for path in keys if path.endswith(COMBINED)]


def _with_scans_read(entries: Mapping[str, Entry], keys: Mapping[str, Key]) -> dict[str, Entry]:
    """Return the entries of one set of surfaces with the numbers of its scans, of which it names one."""
    given = [path for path in (COMBINED, *EACH) if path in entries]
    options = [path for path in _OPTION_PATHS if path in entries]
    if not given:
        where = entries[options[0]].source
        raise InputError(f"this belongs to a scan; {COMBINED} is not given", key=options[0], source=where)
    for path in EACH:
        if given != [COMBINED] and path not in given:
            entry = entries[given[0]]
            hint = f"{path} is needed too; a scan of the one rough surface is given as {COMBINED}"
            raise InputError(hint, key=given[0], source=entry.source)
    treatment = _treatment({path: read_entry(keys[path], entries[path]) for path in options}, entries)
    found = equivalent(*(_measured(path, keys[path], entries[path], treatment) for path in given))
    kept = {path: entry for path, entry in entries.items() if path not in (*given, *options)}
    first = entries[given[0]]
    return kept | {
        path: replace(first, value=value) for path, value in found.values().items() if path in keys
    }


def scan_entries(entries: Mapping[str, Entry]) -> dict[str, Entry]:
    """Return those entries that name scans and how they are treated."""
    return {path: entry for path, entry in entries.items() if path in (COMBINED, *EACH, *_OPTION_PATHS)}


def entries_kept(
    given: Mapping[str, Entry], scans: Mapping[str, Entry], new: Mapping[str, Entry]
) -> dict[str, Entry]:
    """Return the entries of a case to which new ones are added.

    ``given``: entries of the case, with the numbers of its scans. ``scans``: entries that named these scans.
    ``new``: what changes. Another treatment brings the scans back; other numbers leave their origin behind.
    """
    again = bool(scan_entries(new)) and bool(scans)
    dropped = (*FOLLOWING, ORIGIN) if again else (ORIGIN,) if any(path in new for path in FOLLOWING) else ()
    kept = {path: entry for path, entry in given.items() if path not in dropped}
    return kept | dict(scans) if again else kept


def _measured(path: str, key: Key, entry: Entry, treatment: Treatment) -> MeasuredSurface:
    """Return the surface in the file that a key names, relative to the case file."""
    from tribodyn.surfaces import analyse, read_scan

    name = str(read_entry(key, entry))
    file = (entry.folder or Path()) / name
    try:
        return analyse(read_scan(file, length), treatment)
    except InputError as error:
        if error.key in _OPTIONS:
            raise InputError(error.reason, key=f"asperities.{error.key}", source=entry.source) from None
        hint = "; a case needs a file that says it itself" if error.key in ("unit", "spacing") else ""
        reason = f"{error.key}: {error.reason}" if error.key else error.reason
        raise InputError(f"given {shown(name)}: {reason}{hint}", key=path, source=entry.source) from None


def _treatment(values: dict[str, Any], entries: Mapping[str, Entry]) -> Treatment:
    from tribodyn.surfaces import Treatment

    try:
        return Treatment(**{path.rpartition(".")[2]: value for path, value in values.items()})
    except InputError as error:
        path = f"asperities.{error.key}"
        raise InputError(error.reason, key=path, source=entries[path].source) from None


def _in_words(treatment: Treatment) -> str:
    """Return the treatment of a scan, which is half of the meaning of its numbers."""
    ends = (("from", treatment.short_cutoff), ("to", treatment.long_cutoff))
    waves = [f"{word} {from_si(cutoff, 'um')}" for word, cutoff in ends if cutoff is not None]
    kept = f"{treatment.filter} filter, wavelengths {' '.join(waves)}" if waves else "all wavelengths"
    return f"{treatment.level} level, {kept}"


MESH: Final = "mesh"  #: Name of a key that names a file; beside it stand those below.
UNIT: Final = "mesh_unit"
FACETS: Final = "facets"
#: Triangles that a case holds, at most: its text is read whole. Their longest edge makes finer nodes.
MOST: Final = 4000
LARGEST: Final = 5_000_000


def with_meshes_read(entries: Mapping[str, Entry], keys: Mapping[str, Key]) -> dict[str, Entry]:
    """Return the given values with corners of triangles in the place of files' names.

    ``entries``: what was given, by dotted path; ``keys``: the keys of the case.
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
    from tribodyn.joints.shapes.mesh import read_stl

    try:
        facets = read_stl(read_regular(file, LARGEST))
    except OSError as error:
        reason = "there is no such file" if isinstance(error, FileNotFoundError) else error.strerror
        raise InputError(f"{reason}; its name is relative to the case file") from None
    if len(facets) > MOST:
        raise InputError(f"has {len(facets)} triangles; at most {MOST} are allowed here: export it coarser")
    return ", ".join(f"{unit * number:.9g}" for number in facets.ravel().tolist()) + " m"
