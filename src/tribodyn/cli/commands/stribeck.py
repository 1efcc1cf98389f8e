"""``tribodyn stribeck``: friction of a shaft in oil over its speed."""

from argparse import ArgumentParser, Namespace
from pathlib import Path

from tribodyn.cli.console import Console, show_json
from tribodyn.cli.options import add_case_arguments, chosen_case, without_quotes
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given

HELP = "print the Stribeck curve of a shaft in oil: friction over the speed, and who carries the load"
EXAMPLE = "tribodyn stribeck journal-oil --set joints.bearing.clearance.friction_coefficient=0.1"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``stribeck``."""
    add_case_arguments(parser)
    parser.add_argument(
        "--viscosity",
        metavar="V1,V2,...",
        help='a curve for each: "10 mPa s, 32 cSt at 870 kg/m^3" (default: that of the case)',
    )
    parser.add_argument(
        "--speed", metavar="A..B", default="1..1000rad/s", help="range of speeds (default: %(default)s)"
    )
    parser.add_argument("--points", metavar="N", type=int, default=10, help="speeds (default: %(default)s)")
    parser.add_argument("--joint", metavar="NAME", default="", help="of several joints in oil, which one")
    words = "across its axis: 200N (default: the constant forces of a case with one body)"
    parser.add_argument("--load", metavar="FORCE", help=words)
    parser.add_argument("-o", "--output", metavar="FILE", help="write the curves as NetCDF, too")


def execute(args: Namespace) -> int:
    """Print a line for each speed."""
    import numpy as np

    case, console = chosen_case(args), Console.of(args)
    speeds = np.geomspace(*_ends(args.speed), max(2, args.points))
    import tribodyn

    viscosity = _listed(args.viscosity)
    curves = tribodyn.stribeck(case, speeds, viscosity=viscosity, joint=args.joint, load=args.load)
    for place, viscosity in enumerate(curves.attrs["viscosity"]):
        console.say(f"viscosity {viscosity}")
        console.say(f"  {'speed [rad/s]':>14}{'friction':>12}{'film':>9}{'asperities':>12}")
        of_one = curves.isel(viscosity=place)
        for point in range(speeds.size):
            friction, film = (float(of_one[name][point]) for name in ("friction_coefficient", "film_share"))
            asperities = max(0.0, 1.0 - film)
            console.say(f"  {speeds[point]:>14.4g}{friction:>12.4g}{film:>9.1%}{asperities:>12.1%}")
    if args.output is not None:
        curves.to_netcdf(Path(args.output))
        console.say(f"written to {args.output}")
    if args.json:
        show_json({name: curves[name].values.tolist() for name in ("viscosity", "speed", *curves.data_vars)})
    return 0


def _listed(text: str | None) -> list[str]:
    """Return the viscosities of a list, of which the last may name the unit of all."""
    from tribodyn.cases.units import with_shared_unit

    return (
        [] if text is None else with_shared_unit([part.strip() for part in without_quotes(text).split(",")])
    )


def _ends(text: str) -> tuple[float, float]:
    """Return both ends of a range of speeds [rad/s]."""
    from tribodyn.cases.units import UnitProblem, to_si, with_shared_unit

    try:
        low, high = (to_si(end, "rad/s") for end in with_shared_unit(without_quotes(text).split("..")))
    except (UnitProblem, ValueError):
        raise InputError(f"{as_given(text)}; allowed: A..B, such as 10..5000rpm", key="--speed") from None
    if not 0.0 < low < high:
        raise InputError(f"{as_given(text)}; allowed: two speeds above zero, the lower first", key="--speed")
    return low, high
