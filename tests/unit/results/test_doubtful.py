"""Numbers of a run whose energy balance misses too much are marked wherever they are shown."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
import xarray as xr

from tribodyn.cli.headlines import in_words
from tribodyn.mechanisms.results import summarise, write_run
from tribodyn.report.page import render
from tribodyn.results.summary import DOUBTFUL
from tribodyn.workbench.picture import shown


@pytest.mark.parametrize(
    ("missed", "doubtful"), [(0.0, False), (DOUBTFUL, False), (1.01 * DOUBTFUL, True), (float("nan"), True)]
)
def test_the_flag_is_set_beyond_five_percent(
    make_result: Callable[..., xr.Dataset], missed: float, doubtful: bool, tmp_path: Path
) -> None:
    result = make_result().assign_attrs(energy_residual=missed)
    summary = summarise(result)
    assert bool(summary["doubtful"]) is doubtful
    assert shown(result)["doubtful"] == summary["doubtful"]
    lines = list(in_words(summary))
    assert ("Do not use these numbers: the energy balance misses" in lines[0]) is doubtful
    write_run(result, tmp_path)
    assert json.loads((tmp_path / "summary.json").read_text())["doubtful"] == summary["doubtful"]
    page = render(result, (), tmp_path)
    assert ('<section id="numbers" class="doubtful">' in page) is doubtful
    assert ("Do not use these numbers: the energy balance misses" in page) is doubtful


def test_a_terminal_shows_doubtful_numbers_grey(
    make_result: Callable[..., xr.Dataset], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sys.stdout.isatty", lambda: True, raising=False)
    monkeypatch.delenv("NO_COLOR", raising=False)
    summary = summarise(make_result().assign_attrs(energy_residual=0.06))
    first, *numbers = in_words(summary)
    assert numbers
    assert "\x1b" not in first
    assert all(line.startswith("\x1b[2m") and line.endswith("\x1b[0m") for line in numbers)
    monkeypatch.setenv("NO_COLOR", "1")
    assert not any("\x1b" in line for line in in_words(summary))
