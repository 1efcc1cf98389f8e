"""Simulate the mechanisms of the gallery: a figure each, and the page with questions, answers and files.

python docs/plots/mechanism_gallery.py OUTPUT_DIRECTORY
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Final

import matplotlib.pyplot as plt

import tribodyn as td
from tribodyn.mechanism.descriptor import GALLERY, Template
from tribodyn.mechanisms.results import known, summarise
from tribodyn.views.numbers import fitting, in_words, interval

FENCE: Final = "```"
SOURCE: Final = Path(__file__).parents[2] / "src" / "tribodyn" / "mechanism"


def section(name: str, template: Template, answers: dict[str, str]) -> Iterator[str]:
    """Give the lines of a mechanism."""
    yield from (
        f"## {template.title}",
        "",
        f"![{template.title} at several times of its cycle]({name}.png)",
        "",
    )
    yield from (template.description, "", f"**Question:** {template.question}", "")
    yield from (f"    tribodyn new {name}", f"    tribodyn run {name}.toml", "")
    yield from ("| key result | value |", "|---|---|")
    yield from (f"| {label} | {value} |" for label, value in answers.items())
    folder = next(one for one in ("templates", "built_in") if (SOURCE / one / f"{name}.toml").exists())
    file = f"../../src/tribodyn/mechanism/{folder}/{name}.toml"
    shown = f"{FENCE}{{literalinclude}} {file}", ":language: toml", FENCE
    yield from ("", f":::{{dropdown}} {name}.toml", *shown, ":::", "")


def answered(name: str, template: Template, target: Path) -> list[str]:
    """Simulate a mechanism, save its figure, and return its lines."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"{name}.toml"
        path.write_text(template.text, encoding="utf-8")
        result = td.simulate(path)
    result.tribodyn.plot.mechanism().savefig(target / f"{name}.png", dpi=110)
    plt.close("all")
    summary = summarise(result)
    found = known(template.results, "mechanism")
    answers = {}
    for key in template.results:
        unit, factor = fitting(found[key].unit, [summary[key]])
        answers[found[key].label_in(summary)] = (
            f"{interval(summary, key, factor) or in_words(summary[key] * factor, found[key].digits)} {unit}"
        )
    return list(section(name, template, answers))


def main() -> None:
    """Write everything into the given directory."""
    plt.switch_backend("agg")
    target = Path(sys.argv[1]) / "mechanisms"
    target.mkdir(parents=True, exist_ok=True)
    lines = [line for name, template in GALLERY.items() for line in answered(name, template, target)]
    (target / "gallery.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
