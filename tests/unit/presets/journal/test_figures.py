"""Figures of the journal draw whole, short, empty and broken results."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.presets.journal.figures import FIGURES
from tribodyn.report import draw_all
from tribodyn.results import build


def made_up(n: int = 200, *, film: bool = True, failure: str = "") -> xr.Dataset:
    """Return a result of the shape of a journal's, not the output of any simulation."""
    t = np.linspace(0.0, 0.05, 200)[:n]
    sinking = 16e-6 * (1.0 - np.exp(-t / 0.006))
    shapes = {
        "e_x": 0.9 * sinking,
        "e_y": 0.4 * sinking,
        "F_cx": -200.0 * sinking / 16e-6,
        "F_cy": -100.0 * sinking / 16e-6,
        "p_max": 1e7 * sinking,
        "energy_loads": 220.0 * sinking,
        "energy_kinetic": 1e-3 * np.exp(-t / 0.01),
        "energy_contact": 20.0 * sinking,
        "energy_damping": 150.0 * sinking,
        "energy_residual": 1e-8 * sinking,
    }
    if film:
        shapes |= {
            "F_ox": -200.0 + 1e7 * sinking,
            "F_oy": -100.0 + 5e6 * sinking,
            "energy_film": 50.0 * sinking,
        }
    facts = {"kind": "journal", "title": "Journal", "clearance": 20e-6, "energy_residual": 2e-4}
    return build(
        coordinates={"time": t},
        columns=shapes,
        fields={"e_x_balance": 14.56e-6, "e_y_balance": 7.28e-6},
        attributes={**facts, "failure": failure},
        variables=MECHANISMS["journal"].variables,
    )


def _broken() -> xr.Dataset:
    result = made_up(failure="stopped")
    result["e_x"].values[50:] = np.nan
    result["F_cx"].values[:] = np.nan
    result["e_x_balance"] = np.nan
    return result


RESULTS: dict[str, Callable[[], xr.Dataset]] = {
    "whole": made_up,
    "dry": lambda: made_up(film=False),
    "one sample": lambda: made_up(1, failure="interrupted"),
    "empty": lambda: made_up(0, failure="interrupted"),
    "nan": _broken,
}


@pytest.mark.parametrize("result", RESULTS.values(), ids=RESULTS)
@pytest.mark.parametrize("name", FIGURES)
def test_every_figure_draws_every_result(name: str, result: Callable[[], xr.Dataset]) -> None:
    dataset = result()
    assert FIGURES[name].drawable(dataset)
    figure = FIGURES[name].draw(dataset)
    figure.savefig(io.BytesIO(), format="png", dpi=30)
    texts = [text.get_text() for text in figure.texts]
    assert FIGURES[name].title in texts
    assert any("partial run" in text for text in texts) == bool(dataset.attrs["failure"])


@pytest.mark.parametrize("name", FIGURES)
def test_axes_are_labelled_with_units(name: str) -> None:
    figure = FIGURES[name].draw(made_up())
    labels = [label for axes in figure.axes for label in (axes.get_xlabel(), axes.get_ylabel()) if label]
    assert labels
    assert all("[" in label for label in labels)


def test_the_film_has_a_row_only_with_oil() -> None:
    draw = FIGURES["forces"].draw
    assert len(draw(made_up()).axes) == 3
    assert len(draw(made_up(film=False)).axes) == 2


def test_a_journal_gets_its_own_figures(tmp_path: Path) -> None:
    assert [path.stem for path in draw_all(made_up(), tmp_path)] == list(FIGURES)


def test_captions_and_names_are_complete() -> None:
    for name, family in FIGURES.items():
        assert family.name == name
        assert family.caption.endswith(".")
