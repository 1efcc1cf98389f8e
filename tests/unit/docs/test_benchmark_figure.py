"""The figure of the page on performance is made from stored measurements."""

import json
from pathlib import Path

from benchmarks.__main__ import TARGET
from benchmarks.figure import bars, draw


def test_the_figure_shows_every_peer(tmp_path: Path) -> None:
    found = json.loads(TARGET.read_text(encoding="utf-8"))
    draw(found, tmp_path / "figure.svg")
    drawn = (tmp_path / "figure.svg").read_text(encoding="utf-8")
    for name, _, _ in bars(found):
        assert name in drawn
