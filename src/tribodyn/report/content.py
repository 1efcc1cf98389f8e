"""Chapters of a page as its template takes them, and the data of its scripts."""

import base64
import io
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

import xarray as xr
from PIL import Image

from tribodyn.core.files import read_regular
from tribodyn.figures.chart import Family
from tribodyn.views.section import Chapter, Section

Shown = dict[str, Any]

_LARGEST_PICTURE: Final = 100_000_000
_COLOURS: Final = 256  #: Colours of a picture, those of smoothed edges among them.


def chapters(
    dataset: xr.Dataset,
    planned: Iterable[Chapter],
    stills: Sequence[Path] = (),
    families: Mapping[str, Family] = MappingProxyType({}),
) -> tuple[list[Shown], dict[str, Any]]:
    """Return the chapters that a result has data for, and what their scripts read.

    ``planned``: chapters of its kind. ``stills``: PNG files. One that no section stands for gets a place at
    the end: no figure is lost. ``families``: what is known of figures, by the names of the files. Returns
    chapters for the template; data by name of the section.
    """
    pictures = {path.stem: path for path in stills}
    shown: list[Shown] = []
    payloads: dict[str, Any] = {}
    for plan in planned:
        found = {section: section.payload(dataset) for section in plan.sections}
        drawn = {section: payload for section, payload in found.items() if payload is not None}
        payloads |= {section.name: payload for section, payload in drawn.items()}
        still = [section for section in found if section in drawn or section.still in pictures]
        sections = [_section(section, section in drawn, pictures, families) for section in still]
        if sections:
            shown.append(_chapter(plan, sections))
    used = {section.still for chapter in planned for section in chapter.sections}
    others = [_still(path, families.get(name)) for name, path in pictures.items() if name not in used]
    if others:
        lead = "Also in the folder figures."
        shown.append(
            {"name": "figures", "title": "Figures", "lead": lead, "playback": False, "sections": others}
        )
    return shown, payloads


def _chapter(chapter: Chapter, sections: list[Shown]) -> Shown:
    return {
        "name": chapter.name,
        "title": chapter.title,
        "lead": chapter.lead,
        "playback": chapter.playback and any(section["widget"] for section in sections),
        "sections": sections,
    }


def _section(
    section: Section, drawn: bool, pictures: Mapping[str, Path], families: Mapping[str, Family]
) -> Shown:
    """Return a section for the template; one that cannot be drawn is shown as its picture."""
    return {
        "name": section.name,
        "title": section.title,
        "caption": section.caption,
        "widget": section.widget if drawn else "",
        "still": embedded(pictures[section.still]) if section.still in pictures else "",
        "still_caption": families[section.still].caption if section.still in families else "",
        "needs": section.needs,
        "code": reading(section.needs),
    }


def _still(path: Path, family: Family | None) -> Shown:
    """Return a figure that is a picture only."""
    return {
        "name": f"figure-{path.stem}",
        "title": family.title if family else path.stem,
        "caption": family.caption if family else "",
        "widget": "",
        "still": embedded(path),
        "still_caption": "",
        "needs": family.needs if family else (),
        "code": reading(family.needs if family else ()),
    }


def embedded(path: Path) -> str:
    """Return a picture for paper as a data address, in a fraction of the bytes of its PNG file.

    Its colours are rounded by an octree: faster than a median cut, which also loses colours of thin lines.

    Raises OSError if the file is missing, or no picture.
    """
    drawn = Image.open(io.BytesIO(read_regular(path, _LARGEST_PICTURE))).convert("RGB")
    few = drawn.quantize(_COLOURS, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    target = io.BytesIO()
    few.convert("RGB").save(target, "WEBP", method=2, lossless=True)
    return "data:image/webp;base64," + base64.b64encode(target.getvalue()).decode("ascii")


def reading(names: Iterable[str], file: str = "result.nc") -> str:
    """Return the lines of Python that read variables from a file."""
    listed = ", ".join(f'"{name}"' for name in names)
    lines = [
        "import xarray as xr",
        f'result = xr.open_dataset("{file}", engine="netcdf4", decode_timedelta=False)',
    ]
    return "\n".join([*lines, f"result[[{listed}]]"] if listed else lines)


def variables(dataset: xr.Dataset) -> list[dict[str, str]]:
    """Return name, unit, dimensions and meaning of every variable of a result."""
    return [
        {
            "name": str(name),
            "unit": str(variable.attrs.get("units", "")),
            "dims": ", ".join(map(str, variable.dims)) or "—",
            "meaning": str(variable.attrs.get("long_name", "")),
        }
        for name, variable in dataset.variables.items()
    ]
