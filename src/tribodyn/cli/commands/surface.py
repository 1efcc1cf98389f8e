"""``tribodyn surface``: roughness and asperities from a measured profile or map."""

from __future__ import annotations

import json
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from tribodyn.cli.console import Console, complain, show_json
from tribodyn.cli.interrupt import last_words
from tribodyn.cli.options import FIGURES, OutputDirectory
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.figure import Figure

    from tribodyn.surfaces import MeasuredSurface, Scan, Treatment

HELP = "roughness, asperities and their dependence on the cut-offs from a measured profile or map"
EXAMPLE = "tribodyn surface scan.csv --unit um --spacing '0.5 um'"
_DOCUMENT, _BLOCK, _FIGURE = "surface.json", "asperities.toml", "surface.png"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``surface``."""
    parser.add_argument("file", metavar="FILE", help="plain CSV, or any format of SurfaceTopography")
    parser.add_argument("-o", "--output", metavar="DIR", help="save numbers, figure and case block there")
    parser.add_argument("--level", metavar="NAME", default="plane", help="mean, plane (default) or quadratic")
    parser.add_argument("--filter", metavar="NAME", default="gaussian", help="gaussian (default) or spectral")
    parser.add_argument("--short-cutoff", metavar="LENGTH", help='shortest wavelength kept: "2.5 um"')
    parser.add_argument("--long-cutoff", metavar="LENGTH", help='longest wavelength kept: "0.8 mm"')
    parser.add_argument("--unit", metavar="UNIT", help="unit of the heights, if the file does not say it")
    parser.add_argument(
        "--spacing", metavar="LENGTH", help='distance of the points, if the file does not say it: "0.5 um"'
    )
    parser.add_argument("--format", metavar="NAME", help="format of the file (default: from its content)")
    parser.add_argument("--channel", metavar="N", default="1", help="which channel of heights (default: 1)")
    parser.add_argument(
        "--modulus", metavar="E", help='composite modulus of both bodies, for the plasticity index: "7.8 GPa"'
    )
    parser.add_argument("--hardness", metavar="H", help='of the softer body, for the same: "492 MPa"')


def execute(args: Namespace) -> int:
    """Measure the surface and say what came out."""
    console = Console.of(args)
    try:
        _measure(args, console)
    except InputError as error:
        # Options are spelled otherwise than the names of what they set.
        option = error.key and f"--{error.key.removeprefix('--').replace('_', '-')}"
        raise InputError(error.reason, key=option, source=error.source) from None
    return 0


def _measure(args: Namespace, console: Console) -> None:
    from tribodyn.cases.scans import equivalent
    from tribodyn.surfaces import analyse, dependence
    from tribodyn.surfaces.parameters import document

    material, treatment = _material(args), _treatment(args)
    scan = _scan(args)
    surface = analyse(scan, treatment)
    console.note("measuring with other cut-offs")
    others = dependence(surface, scan)
    outcome = document(surface, others)
    if material is not None:
        outcome["plasticity_index"] = surface.asperities.plasticity_index(*material)
    block = equivalent(surface).block()
    if args.output is not None:
        console.note("drawing the figure")
        figure = _drawn(surface, others)
        directory = OutputDirectory(args.output)
        with directory.reserved():
            last_words(f"interrupted while saving; what stands in {args.output} is whole")
            _save(directory.path, outcome, block, figure)
    _tell(outcome, block, args.output, console)


def _material(args: Namespace) -> tuple[float, float] | None:
    """Return composite modulus and hardness [Pa], if they were given."""
    if args.modulus is None and args.hardness is None:
        return None
    for key in ("modulus", "hardness"):
        if getattr(args, key) is None:
            raise InputError("the plasticity index needs this too", key=key)
    return _quantity(args.modulus, "Pa", "modulus"), _quantity(args.hardness, "Pa", "hardness")


def _treatment(args: Namespace) -> Treatment:
    from tribodyn.surfaces import Treatment

    cutoffs = {"short_cutoff": args.short_cutoff, "long_cutoff": args.long_cutoff}
    short, long = (None if text is None else _quantity(text, "m", key) for key, text in cutoffs.items())
    return Treatment(args.level, args.filter, short, long)


def _scan(args: Namespace) -> Scan:
    from tribodyn.cases.scans import length
    from tribodyn.surfaces import Scale, read_scan

    if not (args.channel.isascii() and args.channel.isdigit() and len(args.channel) < 10):
        raise InputError(f"{as_given(args.channel)}; allowed: a whole number from 1", key="channel")
    scale = Scale(args.unit, args.spacing)
    return read_scan(args.file, length, scale, file_format=args.format, channel=int(args.channel))


def _quantity(text: str, unit: str, key: str) -> float:
    """Return a positive quantity in SI units."""
    from tribodyn.cases.units import UnitProblem, dimension, to_si

    try:
        value = to_si(text, unit)
    except UnitProblem as problem:
        raise InputError(f"{as_given(text)}: {problem}; allowed: a {dimension(unit)}", key=key) from None
    if not value > 0.0:
        raise InputError(f"{as_given(text)}; allowed: a {dimension(unit)} above zero", key=key)
    return value


def _drawn(surface: MeasuredSurface, others: list[MeasuredSurface]) -> Figure:
    from tribodyn.figures.surface import draw

    return draw(surface, others)


def _save(folder: Path, outcome: dict[str, Any], block: str, figure: Figure) -> None:
    """Write numbers, block and figure."""
    from tribodyn.figures.chart import save_png
    from tribodyn.results.store import write_text

    (folder / FIGURES).mkdir(exist_ok=True)
    save_png(figure, folder / FIGURES / _FIGURE)
    write_text(folder / _DOCUMENT, json.dumps(outcome, indent=2, allow_nan=False) + "\n")
    write_text(folder / _BLOCK, block)


def _tell(outcome: dict[str, Any], block: str, output: str | None, console: Console) -> None:
    """Print the numbers, the warnings, and the block or where to look."""
    console.say(f"{outcome['kind']} {outcome['file']}")
    for line in _in_words(outcome):
        console.say(line)
    for warning in outcome["warnings"]:
        complain(f"warning: {warning}")
    console.say(f"\n{block}" if output is None else f"\nlook at {output}; everything is in it")
    if console.json:
        show_json(outcome)


def _in_words(outcome: dict[str, Any]) -> Iterator[str]:
    """Give one line for each number, aligned, and a short table of those at other cut-offs."""
    from tribodyn.surfaces.parameters import PARAMETERS

    labels = {name: (parameter.label, parameter.unit) for name, parameter in PARAMETERS.items()}
    labels["plasticity_index"] = ("plasticity index", "")
    width = max(len(label) for label, _ in labels.values())
    for name, (label, unit) in labels.items():
        if name in outcome:
            yield f"  {label:<{width}}  {outcome[name]:>10.4g} {unit}".rstrip()
    if outcome["cutoffs"]:
        yield ""
        yield "  they depend on the wavelengths kept [um]:"
        yield "    from       to          sigma [um]  beta [um]   xi [1/um^2]"
    for other in outcome["cutoffs"][::3]:
        ends = (_end(other["short_cutoff_um"]), _end(other["long_cutoff_um"]))
        names = ("sigma_um", "asperity_radius_um", "asperity_density_per_um2")
        yield (
            "    "
            + f"{ends[0]:<11}{ends[1]:<12}"
            + "".join(f"{other[name]:<12.4g}" for name in names).rstrip()
        )


def _end(cutoff: float | None) -> str:
    return "all" if cutoff is None else f"{cutoff:.4g}"
