"""Builds drawn from copies: against full draws of a known population, and around made-up runs."""

from pathlib import Path
from typing import Any, Final

import numpy as np
import pytest
import xarray as xr
from scipy.stats import norm

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.mechanism.descriptor import TEMPLATES
from tribodyn.mechanisms.catalogue import parse_case
from tribodyn.simulation import simulate
from tribodyn.studies import builds
from tribodyn.studies.builds import LEVELS, BuildRuns, Copies, draw, numbers_of_builds
from tribodyn.studies.sampling import SAMPLERS
from tribodyn.studies.sweep import SILENT, Means

N: Final = 40
TEXT: Final = TEMPLATES["vsv-ring"].text.replace('elastic = "beam"\n', "")
RING: Final = '[outputs.ring]\nbody = "ring"\n'
SCATTER: Final = TEXT[TEXT.index("[scatter.play]") : TEXT.index("[bodies.ring]")]


def errors_of(inputs: FloatArray) -> FloatArray:
    """Return errors of copies at six instants, of two inputs, shape (n, 6)."""
    play, rough = inputs.T
    phase = np.linspace(0.0, 3.0, 6)
    return np.outer(1.0 + 0.2 * play + 0.03 * play**2 + 0.002 * play**3, np.cos(phase)) + np.outer(
        0.05 * rough, np.sin(phase)
    )


def test_quantiles_lie_in_the_intervals_of_full_draws() -> None:
    """10,000 builds of fresh copies against builds of 4,000 copies that are drawn again and again."""
    random = np.random.default_rng(0)
    inputs = norm.ppf(SAMPLERS["lhs"](4000, 2, 0))
    laws = 2 * [lambda random, size: random.standard_normal(size)]
    drawn = draw(Copies(laws, inputs, errors_of(inputs)), N, 100_000, random)
    fresh = errors_of(random.standard_normal((10_000 * N, 2))).reshape(10_000, N, 6)
    full = np.sort(numbers_of_builds(fresh), axis=0)
    # Of order statistics, the binomial interval of 95 %.
    level = LEVELS[-1]
    width = 1.96 * np.sqrt(level * (1.0 - level) * len(full))
    low, high = (full[round(level * len(full) + side * width)] for side in (-1.0, 1.0))
    found = np.quantile(drawn, level, axis=0)
    assert np.all((low <= found) & (found <= high))


def test_numbers_of_a_build_are_those_of_its_copies() -> None:
    found = numbers_of_builds(np.array([[[1.0, -3.0], [2.0, 0.0]], [[0.0, 0.0], [0.0, 0.0]]]))
    assert found[0] == pytest.approx([3.0, np.sqrt((0.25 + 2.25) / 2.0), 3.0])
    assert found[1].tolist() == [0.0, 0.0, 0.0]


def test_draws_are_numbers_of_polynomials_with_what_these_miss() -> None:
    """Each build has its own copies, in whatever order their errors are found."""
    inputs = np.random.default_rng(1).standard_normal((200, 2))
    shares = [lambda random, size: random.standard_normal(size)] * 2
    copies = Copies(shares, inputs, errors_of(inputs))
    found = copies.drawn(np.random.default_rng(2), 3, N)
    random = np.random.default_rng(2)
    fresh = np.column_stack([law(random, 3 * N) for law in shares])
    # The errors are a polynomial, so that it misses nothing.
    assert found == pytest.approx(errors_of(fresh).reshape(3, N, 6), abs=1e-5)


@pytest.mark.parametrize(
    ("change", "copies", "limits", "refusal"),
    [
        (("", ""), 2, {}, "given 2; 1 builds"),
        ((SCATTER, ""), 9, {}, "nothing differs from copy to copy"),
        (("", ""), 9, {"copies_spread_max_um": 1.0}, "allowed: copies_spread_max_deg"),
        (
            ("[outputs.vane]", '[outputs.other]\nbody = "vane"\n[outputs.vane]'),
            9,
            {},
            "the errors of one repeated output are compared, not of 2",
        ),
    ],
)
def test_what_cannot_be_drawn_is_refused(change, copies, limits, refusal):
    with pytest.raises(InputError, match=refusal):
        builds(
            parse_case((TEXT).replace(*change), "test"), copies=copies, draws=100, limits=limits, workers=0
        )


def test_a_case_without_copies_is_refused() -> None:
    with pytest.raises(InputError, match="the case repeats nothing"):
        builds("slider-crank", copies=10, draws=100)


def test_a_carrier_that_nothing_guides_is_refused() -> None:
    case: Any = parse_case(TEXT.replace('type = "cylindrical"', 'type = "planar"'), "test")
    with pytest.raises(InputError, match="the motion of ring is prescribed"):
        case.one_copy(xr.Dataset(), [0.1])


def test_a_case_written_with_its_copies_is_refused() -> None:
    written: Any = parse_case(parse_case(TEXT, "test").to_toml(), "test")
    assert not written.scattered
    with pytest.raises(InputError, match="give the case file before it"):
        written.one_copy(xr.Dataset(), [0.1])


def test_what_scatters_is_refused_where_copies_have_their_values() -> None:
    written = parse_case(TEXT, "test").to_toml()
    with pytest.raises(InputError, match="what scatters stands in the file before it"):
        parse_case(written + SCATTER, "test")


def test_copies_alone_are_those_of_the_ring_that_holds_them(tmp_path: Path) -> None:
    """The template with rigid levers: alone and together copies differ by what the ring gives way."""
    case = parse_case(TEXT.replace("[outputs.vane]", f"{RING}[outputs.vane]"), "test").replace(
        {"run.duration": "0.5 s", "run.output_interval": "20 ms", "pattern.vanes.count": 3}
    )
    found = builds(case, copies=12, draws=500, coupled=2, directory=tmp_path, workers=0)
    assert (tmp_path / "alone" / "points.jsonl").read_text(encoding="utf-8").count("\n") == 12
    assert found.contributions["play"] > 0.9
    for one in found.numbers:
        assert np.all(np.diff(one.quantiles) >= 0.0)
        assert one.together == pytest.approx(one.same, rel=0.2)
    again = builds(case, copies=12, draws=500, coupled=2, directory=tmp_path, workers=0)
    assert again.numbers[0].quantiles.tolist() == found.numbers[0].quantiles.tolist()


def test_ways_of_builds_turn_with_their_copies(tmp_path: Path) -> None:
    """A build as a whole is the case whose copies scatter by the values of its copies."""
    law = 'distribution = "normal"\narguments = ["20 um", "4 um"]'
    hole = TEXT.replace(".clearance.radial", ".deviation.x").replace(law, 'values = ["1 um", "9 um", "4 um"]')
    given = {"run.duration": "0.1 s", "run.output_interval": "20 ms", "pattern.vanes.count": 3}
    runs = BuildRuns(parse_case(hole, "test").replace(given), 3, 1, 0, tmp_path)
    [together] = runs.together(Means(0, keep_results=False), SILENT)
    [values] = runs._columns.values()
    assert sorted(values) == [1e-6, 4e-6, 9e-6]
    listed = ", ".join(f'"{1e6 * value:.0f} um"' for value in values)
    whole = parse_case(hole.replace('"1 um", "9 um", "4 um"', listed), "test").replace(given)
    error = simulate(whole)["output_error"]
    at = error.interp(time=runs._instants).values.T
    assert together == pytest.approx(np.degrees(numbers_of_builds(at[None])[0]), rel=1e-2)
