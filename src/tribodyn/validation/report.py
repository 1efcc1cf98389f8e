"""Results of validation sets as text, JSON and Markdown pages."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final

from tribodyn.validation.base import Band, Comparison, Outcome, Verdict
from tribodyn.validation.catalogue import ValidationSet

_COLUMNS: Final = ("measured", "computed", "E", "null model")


@dataclass(frozen=True)
class Judged:
    """A set with what it returned."""

    set: ValidationSet
    outcome: Outcome

    @property
    def counts(self) -> Counter[str]:
        """Number of compared numbers by verdict."""
        return Counter(row.verdict.value for row in self.outcome.comparisons)

    def explanation(self, row: Comparison) -> str:
        """Return why a number misses its band; empty for any other verdict."""
        return self.set.explanation(row.name) if row.verdict is Verdict.OUTSIDE else ""


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
    """Return the counts of all sets, one line each, and their sum."""
    total: Counter[str] = Counter()
    lines = []
    for one in all_judged:
        total += one.counts
        lines.append(f"  {one.set.name:<24}{_counted(one.counts)}")
    return "\n".join([*lines, f"  {'all sets':<24}{_counted(total)}"])


def as_json(judged: Judged) -> dict[str, Any]:
    """Return a set as JSON values: infinite limits and missing values as null."""
    rows = [
        {
            "name": row.name,
            "unit": row.unit,
            "measured": row.measured,
            "u_measured": row.u_measured,
            "computed": _finite(row.computed),
            "u_computed": _finite(row.u_computed),
            "range": None if row.spread is None else [_finite(end) for end in row.spread],
            "E": row.error,
            "null": row.null,
            "band": None if row.band is None else row.band.name,
            "accepted": allowed(row.band, row.measured),
            "verdict": row.verdict.value,
            "explanation": judged.explanation(row),
            "not_judged": row.not_judged,
            "note": row.note,
        }
        for row in judged.outcome.comparisons
    ]
    return {"set": judged.set.name, "title": judged.set.title, "counts": dict(judged.counts), "numbers": rows}


def as_page(judged: Judged) -> str:
    """Return the page of a set for the manual."""
    one = judged.set
    parts = [f"# {one.title}", str(one.table["compared"]), f"**{_counted(judged.counts)}.**"]
    if judged.outcome.plot is not None:
        parts.append(f"![Measured and computed values: {one.title}]({one.name}.png)")
    parts.append("## Measured and computed\n\n" + "\n".join(_table(judged.outcome.comparisons)))
    parts.append(
        "Intervals are half widths; E is the difference over the root of the sum of their squares. "
        "The null model is a hand formula or an interpolation."
    )
    misses = [(row, text) for row in judged.outcome.comparisons if (text := judged.explanation(row))]
    if misses:
        parts.append("## Misses\n\n" + "\n".join(f"- *{row.name}*: {text}" for row, text in misses))
    notes = [
        (row.name, text) for row in judged.outcome.comparisons for text in (row.not_judged, row.note) if text
    ]
    if notes:
        parts.append("## Remarks\n\n" + "\n".join(f"- *{name}*: {text}" for name, text in notes))
    if one.bands:
        parts.append("## Acceptance bands\n\n" + "\n".join(_bands(one.bands.values())))
    if one.inputs:
        parts.append("## Inputs\n\n" + "\n".join(_inputs(one)))
    parts.append("## The data\n\n" + _demoted(one.readme()))
    return "\n\n".join(parts) + "\n"


def sets_table(all_judged: Iterable[Judged]) -> Iterator[str]:
    """Give the table of all sets with their counts, links to their pages included."""
    yield f"| set | measured | {' | '.join(verdict.value for verdict in Verdict)} |"
    yield "|---|---|" + "---|" * len(Verdict)
    total: Counter[str] = Counter()
    for one in all_judged:
        total += one.counts
        counts = " | ".join(str(one.counts[verdict.value]) for verdict in Verdict)
        yield f"| [`{one.set.name}`](sets/{one.set.name}.md) | {one.set.title} | {counts} |"
    yield f"| all | | {' | '.join(str(total[verdict.value]) for verdict in Verdict)} |"


def predictions_table(entries: Iterable[Mapping[str, Any]]) -> Iterator[str]:
    """Give the register of predictions as a table."""
    yield "| set | quantity | value | interval | unit | entered | hash of inputs and data |"
    yield "|---|---|---|---|---|---|---|"
    for entry in entries:
        low, high = number(entry["low"]), number(entry["high"])
        cells = (
            f"`{entry['set']}`",
            entry["name"],
            number(entry["value"]),
            f"{low} to {high}",
            entry["unit"],
        )
        yield f"| {' | '.join(cells)} | {entry['date']} | `{entry['hash'][:12]}` |"


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


def with_width(value: float | None, half_width: float) -> str:
    """Return a value with its half width; a dash where there is no value."""
    if value is None:
        return "-"
    return f"{number(value)} ± {half_width:.2g}" if half_width else number(value)


def _named(row: Comparison) -> str:
    return f"{row.name} [{row.unit}]" if row.unit else row.name


def _cells(row: Comparison) -> tuple[str, str, str, str]:
    computed = with_width(row.computed, row.u_computed)
    error = "-" if row.error is None else f"{row.error:.2f}"
    null = "-" if row.null is None else number(row.null)
    return with_width(row.measured, row.u_measured), computed, error, null


def _counted(counts: Counter[str]) -> str:
    return ", ".join(f"{counts[verdict.value]} {verdict.value}" for verdict in Verdict)


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _table(rows: Iterable[Comparison]) -> Iterator[str]:
    yield "| quantity | measured | computed | range judged | E | null model | accepted | verdict |"
    yield "|---|---|---|---|---|---|---|---|"
    for row in rows:
        measured, computed, error, null = _cells(row)
        spread = "" if row.spread is None else f"{number(row.spread[0])} to {number(row.spread[1])}"
        cells = (_named(row), measured, computed, spread, error, null, allowed(row.band, row.measured))
        yield f"| {' | '.join(cells)} | {row.verdict.value} |"


def _bands(bands: Iterable[Band]) -> Iterator[str]:
    yield "| band | given by |"
    yield "|---|---|"
    for band in bands:
        yield f"| {band.name.replace('_', ' ')} | {band.source.replace('|', '/')} |"


def _inputs(one: ValidationSet) -> Iterator[str]:
    yield "| input | value | band | from |"
    yield "|---|---|---|---|"
    for given in one.inputs.values():
        source = f"“{given.source}”" if given.source else ""
        origin = "; ".join(text for text in (source, given.assumed and f"assumed: {given.assumed}") if text)
        yield f"| {given.name.replace('_', ' ')} | {given.text} | {given.band_text} | {origin} |"


def _demoted(readme: str) -> str:
    """Return a README without its heading, for a page that has its own."""
    return "\n".join(line for line in readme.splitlines() if not line.startswith("# ")).strip()
