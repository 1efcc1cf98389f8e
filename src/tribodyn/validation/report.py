"""Results of validation sets as text, JSON and Markdown pages, and their files."""

import json
import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from typing import Any, Final

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from tribodyn.figures.style import BLUE, DPI, GREEN, GREY, INK, PURPLE, SMALL, VERMILION
from tribodyn.validation.base import Band, Comparison, Kind, Outcome, Plot, Sides, Verdict
from tribodyn.validation.catalogue import ValidationSet

_COLUMNS: Final = ("measured", "computed", "E", "null model")


@dataclass(frozen=True)
class Judged:
    """A set with what it returned."""

    set: ValidationSet
    outcome: Outcome

    @property
    def counts(self) -> Counter[str]:
        """Number of compared numbers by verdict, those within by what the null model does."""
        return Counter(_count_of(row) for row in self.outcome.comparisons)

    def explanation(self, row: Comparison) -> str:
        """Return why a number misses its band or differs by more than its uncertainties; else empty."""
        return self.set.explanation(row.name) if needs_explanation(row) else ""


def needs_explanation(row: Comparison) -> bool:
    """Return whether a number misses its band, or differs by more than its uncertainties (E > 1)."""
    return row.verdict is Verdict.OUTSIDE or (row.error or 0.0) > 1.0


_WITHIN: Final = {
    False: "within the band, null model outside",
    True: "within the band, as is the null model",
    None: "within the band, no null model",
}
COUNTS: Final = (*_WITHIN.values(), Verdict.OUTSIDE.value, Verdict.REPORTED.value)  #: Names of counts.


def _count_of(row: Comparison) -> str:
    return _WITHIN[row.null_within] if row.verdict is Verdict.WITHIN else row.verdict.value


def by_kind(all_judged: Iterable[Judged]) -> dict[Kind, Counter[str]]:
    """Return the counts of each kind of check."""
    found: dict[Kind, Counter[str]] = {kind: Counter() for kind in Kind if kind is not Kind.OWN}
    for one in all_judged:
        found.setdefault(one.set.kind, Counter()).update(one.counts)
    return found


def as_text(judged: Judged) -> str:
    """Return a set as a table for a terminal, with the explanation of every miss."""
    rows = judged.outcome.comparisons
    width = max(len(_named(row)) for row in rows) + 2
    lines = [f"{judged.set.name}: {judged.set.title}"]
    lines.append(f"  {'':<{width}}" + "".join(f"{name:>20}" for name in _COLUMNS) + "  verdict")
    for row in rows:
        cells = "".join(f"{cell:>20}" for cell in _cells(row))
        lines.append(f"  {_named(row):<{width}}{cells}  {row.verdict.value}")
        for text in filter(None, (judged.explanation(row), row.not_judged, row.note)):
            lines.append(f"      {text}")
    return "\n".join(lines)


def summary(all_judged: Iterable[Judged]) -> str:
    """Return the counts of all sets, then of each kind of check, one line each."""
    known = list(all_judged)
    lines = [f"  {one.set.name:<28}{_counted(one.counts)}" for one in known]
    kinds = [f"  {kind.value:<28}{_counted(counts)}" for kind, counts in by_kind(known).items() if counts]
    return "\n".join([*lines, "", *kinds])


def as_json(judged: Judged) -> dict[str, Any]:
    """Return a set as JSON values: infinite limits and missing values as null."""
    rows = [
        {
            "name": row.name,
            "unit": row.unit,
            "measured": row.measured,
            "u_measured": row.u_measured,
            "computed": _finite(row.computed),
            "u_computed": [_finite(side) for side in row.sides],
            "range": None if row.spread is None else [_finite(end) for end in row.spread],
            "E": None if row.error is None else _finite(row.error),
            "null": row.null,
            "null_within": row.null_within,
            "band": None if row.band is None else row.band.name,
            "accepted": allowed(row.band, row.measured),
            "verdict": row.verdict.value,
            "explanation": judged.explanation(row),
            "not_judged": row.not_judged,
            "note": row.note,
        }
        for row in judged.outcome.comparisons
    ]
    about = {"set": judged.set.name, "title": judged.set.title, "kind": judged.set.kind.value}
    return {**about, "counts": dict(judged.counts), "numbers": rows}


def as_page(judged: Judged) -> str:
    """Return the page of a set for the manual."""
    one = judged.set
    counts = f"**Kind of check: {one.kind.value}. {_counted(judged.counts)}.**"
    parts = [f"# {_plain(one.title)}", str(one.table["compared"]), counts]
    if judged.outcome.plot is not None:
        parts.append(f"![Measured and computed values: {_plain(one.title)}]({one.name}.png)")
    parts.append("## Measured and computed\n\n" + "\n".join(_table(judged.outcome.comparisons)))
    parts.append(
        "Intervals are half widths, of computed values below and above where they differ. E is the "
        "difference over the root of the sum of squares of both, on the side of the measured value. "
        "The null model is a hand formula or an interpolation."
    )
    misses = [(row, text) for row in judged.outcome.comparisons if (text := judged.explanation(row))]
    if misses:
        parts.append(
            "## Misses, and numbers with E > 1\n\n"
            + "\n".join(f"- *{_plain(row.name)}*: {_plain(text)}" for row, text in misses)
        )
    notes = [
        (row.name, text) for row in judged.outcome.comparisons for text in (row.not_judged, row.note) if text
    ]
    if notes:
        parts.append(
            "## Remarks\n\n" + "\n".join(f"- *{_plain(name)}*: {_plain(text)}" for name, text in notes)
        )
    if one.bands:
        parts.append("## Acceptance bands\n\n" + "\n".join(_bands(one.bands.values())))
    if one.inputs:
        parts.append("## Inputs\n\n" + "\n".join(_inputs(one)))
    parts.append("## The data\n\n" + _demoted(one.readme()))
    return "\n\n".join(parts) + "\n"


def sets_table(all_judged: Iterable[Judged]) -> Iterator[str]:
    """Give the table of all sets with their counts by kind, links to their pages included."""
    known = list(all_judged)
    yield f"| kind of check, set | measured | {' | '.join(COUNTS)} |"
    yield "|---|---|" + "---|" * len(COUNTS)
    for kind, total in by_kind(known).items():
        yield f"| **{kind.value}** | | {_row(total)} |"
        for one in (one for one in known if one.set.kind is kind):
            yield f"| [`{one.set.name}`](sets/{one.set.name}.md) | {one.set.title} | {_row(one.counts)} |"


def _row(counts: Counter[str]) -> str:
    return " | ".join(str(counts[name]) for name in COUNTS)


def allowed(band: Band | None, measured: float | None) -> str:
    """Return the accepted values in words; empty without a band."""
    if band is None:
        return ""
    if band.covers is not None:
        return f"contains {number(band.covers[0])} to {number(band.covers[1])}"
    if band.must_exceed is not None:
        return f"must miss by more than {number(band.must_exceed)}"
    limits = band.limits(measured)
    assert limits is not None
    low, high = limits
    if math.isinf(low):
        return f"at most {number(high)}"
    if math.isinf(high):
        return f"at least {number(low)}"
    return f"{number(low)} to {number(high)}"


def number(value: float) -> str:
    """Return a number with four significant digits."""
    return f"{value:.4g}"


def with_width(value: float | None, sides: Sides) -> str:
    """Return a value with the widths of its interval; a dash where there is no value."""
    if value is None:
        return "-"
    below, above = (f"{side:.2g}" for side in sides)
    if below == above:
        return f"{number(value)} ± {below}" if any(sides) else number(value)
    return f"{number(value)} −{below} +{above}"


def _named(row: Comparison) -> str:
    return f"{row.name} [{row.unit}]" if row.unit else row.name


def _cells(row: Comparison) -> tuple[str, str, str, str]:
    computed = with_width(row.computed, row.sides)
    error = "-" if row.error is None else f"{row.error:.2f}"
    null = "-" if row.null is None else number(row.null)
    return with_width(row.measured, (row.u_measured, row.u_measured)), computed, error, null


def _counted(counts: Counter[str]) -> str:
    return "; ".join(f"{counts[name]} {name}" for name in COUNTS if counts[name])


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _table(rows: Iterable[Comparison]) -> Iterator[str]:
    yield "| quantity | measured | computed | range judged | E | null model | accepted | verdict |"
    yield "|---|---|---|---|---|---|---|---|"
    for row in rows:
        measured, computed, error, null = _cells(row)
        spread = "" if row.spread is None else f"{number(row.spread[0])} to {number(row.spread[1])}"
        cells = (
            _plain(_named(row)),
            measured,
            computed,
            spread,
            error,
            null,
            allowed(row.band, row.measured),
        )
        yield f"| {' | '.join(cells)} | {row.verdict.value} |"


def _bands(bands: Iterable[Band]) -> Iterator[str]:
    yield "| band | given by |"
    yield "|---|---|"
    for band in bands:
        yield f"| {_plain(band.name.replace('_', ' '))} | {_plain(band.source)} |"


def _inputs(one: ValidationSet) -> Iterator[str]:
    yield "| input | value | band | from |"
    yield "|---|---|---|---|"
    for given in one.inputs.values():
        source = f"“{given.source}”" if given.source else ""
        origin = "; ".join(text for text in (source, given.assumed and f"assumed: {given.assumed}") if text)
        yield f"| {given.name.replace('_', ' ')} | {given.text} | {given.band_text} | {_plain(origin)} |"


def _demoted(readme: str) -> str:
    """Return a README without its heading, for a page that has its own, and without HTML."""
    lines = (line for line in readme.splitlines() if not line.startswith("# "))
    return "\n".join(lines).strip().replace("<", "&lt;")


def _plain(text: str) -> str:
    """Return a text for one cell or line of Markdown: no HTML, no end of the cell."""
    return " ".join(text.replace("&", "&amp;").replace("<", "&lt;").replace("|", "/").split())


_COLOURS: Final = {"measured": (INK, GREY), "computed": (BLUE, VERMILION, GREEN, PURPLE), "null": (GREY, INK)}
_MARKERS: Final = "os^Dv"


def _save_plot(plot: Plot, title: str, path: Path) -> None:
    """Write measured values with their intervals, computed values and null model as PNG."""
    figure = Figure(figsize=(7.6, 3.8), dpi=DPI, layout="constrained", facecolor="white")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    seen = {kind: count() for kind in _COLOURS}
    for curve in plot.curves:
        place = next(seen[curve.kind])
        colour = _COLOURS[curve.kind][place % len(_COLOURS[curve.kind])]
        look: dict[str, Any] = {"color": colour, "label": curve.label}
        if curve.kind == "measured":
            marker = _MARKERS[place % len(_MARKERS)]
            axes.errorbar(curve.x, curve.y, curve.half_width, fmt=marker, markersize=4, capsize=2, **look)
        else:
            axes.plot(curve.x, curve.y, linestyle="--" if curve.kind == "null" else "-", marker=".", **look)
    axes.set(xlabel=plot.x_label, ylabel=plot.y_label)
    axes.set_title(title, fontsize=SMALL, loc="left")
    axes.grid(alpha=0.3)
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False, fontsize=SMALL)
    figure.savefig(path)


def save(all_judged: Sequence[Judged], folder: Path) -> None:
    """Write ``NAME.md`` and ``NAME.png`` of each set, and ``validation.json`` with all numbers."""
    for one in all_judged:
        (folder / f"{one.set.name}.md").write_text(as_page(one), encoding="utf-8")
        if one.outcome.plot is not None:
            _save_plot(one.outcome.plot, one.set.title, folder / f"{one.set.name}.png")
    document = json.dumps([as_json(one) for one in all_judged], indent=2, ensure_ascii=False)
    (folder / "validation.json").write_text(document + "\n", encoding="utf-8")
