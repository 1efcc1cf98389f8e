"""Key results of a run or a sweep as text for the terminal: lines for a run, tables for a sweep."""

from __future__ import annotations

import os
import shutil
import sys
import textwrap
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

from tribodyn.core.quoting import GREY, PLAIN
from tribodyn.views.numbers import columns_of, fitting, interval, rounded, tables_of

if TYPE_CHECKING:
    from tribodyn.results.summary import KeyResult

_SHOWN_IN_FULL: Final = (1e4, 1e9)


def in_words(summary: Mapping[str, object]) -> Iterator[str]:
    """Give one line for each key result, aligned, with its unit; grey where they are doubtful.

    ``summary``: content of ``summary.json``.
    """
    from tribodyn.results.summary import caution

    warning = summary.get("doubtful")
    if warning:
        yield f"  {caution(warning)}"
    yield from (grey(line, warning) for line in _numbers(summary))


def _mark(name: str, summary: Mapping[str, object]) -> bool:
    """Return whether a number is grey by itself: it follows from a material that nobody chose."""
    assumed = summary.get("assumed")
    return not summary.get("doubtful") and isinstance(assumed, list) and name in assumed


def grey(text: str, warning: object) -> str:
    """Return a text that a terminal shows in grey where there is a warning, unless colours are unwanted."""
    wanted = warning and sys.stdout.isatty() and "NO_COLOR" not in os.environ
    return f"{GREY}{text}{PLAIN}" if wanted else text


def _numbers(summary: Mapping[str, object]) -> Iterator[str]:
    """Give a line for each number of the whole, and a table for those of several parts, such as joints."""
    from tribodyn.mechanisms.results import known

    groups = tables_of(known(summary, str(summary.get("kind", ""))))
    for number, (part, group) in enumerate(groups.items()):
        yield from [""] if number else []
        yield from _parts(part, group, summary) if part else _lines(group, summary)


def _lines(key_results: Mapping[str, KeyResult], summary: Mapping[str, object]) -> Iterator[str]:
    labels = {name: key_result.label_in(summary) for name, key_result in key_results.items()}
    width = max(map(len, labels.values()), default=0)
    for name, one in key_results.items():
        unit, factor = fitting(one.unit, [summary[name]])
        value, ends = _number(summary[name], one.digits, factor), interval(summary, name, factor)
        shown = f"{ends:>9} {unit} (nominal {value.strip()})" if ends else f"{value} {unit}"
        yield grey(f"  {labels[name]:<{width}}  {shown}".rstrip(), _mark(name, summary))


def _parts(group: str, key_results: Mapping[str, KeyResult], summary: Mapping[str, object]) -> Iterator[str]:
    """Give a table with a row for each part and a column for each quantity."""
    columns = {f"{one.label} {one.unit}".strip(): one for one in columns_of(key_results, summary)}
    cells = {
        (h.part, heading): grey(
            f"{_of_part(name, h, column.factor, summary):>{_COLUMN}}", _mark(name, summary)
        )
        for heading, column in columns.items()
        for name, h in column.members.items()
    }
    parts = dict.fromkeys(h.part for h in key_results.values())
    width = max(map(len, (group, *parts)))
    most = _room(width + 4)
    even = -(-len(columns) // -(-len(columns) // most))
    for number, shown in enumerate(_pieces(columns, even)):
        yield from [""] if number else []
        yield from (f"  {line}" for line in _heading({group: (group, width)}, {name: name for name in shown}))
        for part in parts:
            row = [cells.get((part, name), _NONE) for name in shown]
            if any(cell != _NONE for cell in row):
                yield f"  {part:<{width}}  {'  '.join(row)}"


def _of_part(name: str, one: KeyResult, factor: float, summary: Mapping[str, object]) -> str:
    """Return a number of a part; of wear its interval."""
    return interval(summary, name, factor) or _number(summary[name], one.digits, factor)


def _room(taken: int) -> int:
    """Return the number of columns that fit into the terminal beside a used width, at least one."""
    return max((shutil.get_terminal_size((120, 40)).columns - taken) // (_COLUMN + 2), 1)


def _pieces(columns: Iterable[str], most: int) -> Iterator[list[str]]:
    """Yield the columns in pieces of at most so many."""
    left = list(columns)
    yield from (left[begin : begin + most] for begin in range(0, len(left), most))


def _number(value: object, digits: int, factor: float = 1.0) -> str:
    """Write a number with the digits that hold, not in powers of ten where it need not be; counts in full."""
    if not isinstance(value, float):
        return f"{value!s:>9}"
    number = rounded(value * factor, digits)
    return f"{number:>9.0f}" if _SHOWN_IN_FULL[0] <= abs(number) < _SHOWN_IN_FULL[1] else f"{number:>9.4g}"


_COLUMN: Final = 13
_NONE: Final = f"{'–':>{_COLUMN}}"
_LONGEST: Final = 22
_MOST_ROWS: Final = 40
_MOST_WARNINGS: Final = 5
LEFT_OUT: Final = ("Trust", "Effort")  #: Groups of key results that say nothing about the machine.


def sweep_in_words(record: Mapping[str, Any], shown: Sequence[str] = ()) -> Iterator[str]:
    """Give the lines of a table.

    ``record``: content of ``sweep.json``; ``shown``: names of the numbers to show; without them all of the
    machine that vary, as many as there is room for.
    """
    given = shown or _varying(record["points"])
    if record["statistics"]:
        yield from _statistics(record["statistics"], _key_results(given, record["kind"], every=bool(shown)))
    else:
        numbers = _key_results(given, record["kind"], every=bool(shown))
        yield from _points(record["points"], numbers, every=bool(shown))
    yield from _cautions(record["points"])
    yield from _limits(record)
    if record["statistics"] or record.get("limits"):
        yield from _scatter(record["points"], _key_results(given, record["kind"], every=bool(shown)))
    yield from _sensitivities(record, shown)


def _cautions(points: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    """Report the points with numbers that should not be used."""
    from tribodyn.results.summary import caution

    doubtful = [point for point in points if point.get("doubtful")]
    for point in doubtful[:_MOST_WARNINGS]:
        at = ", ".join(f"{path} = {value}" for path, value in point["changes"].items())
        yield caution(point["doubtful"], f"the numbers at {at}")
    if len(doubtful) > _MOST_WARNINGS:
        yield f"... nor those of {len(doubtful) - _MOST_WARNINGS} more points"


def _scatter(points: Sequence[Mapping[str, Any]], numbers: Mapping[str, KeyResult]) -> Iterator[str]:
    """Report the intervals of wear and lives, whose statistics are those at the nominal wear rate."""
    for name, one in numbers.items():
        ends = next((p["intervals"][name] for p in points if name in p.get("intervals", ())), None)
        value = next((p[name] for p in points if name in p.get("intervals", ())), 0.0)
        if ends and value:
            low, high = (f"{end / value:.2g}" for end in ends)
            yield f"{one.label}: {low} to {high} times these numbers for equal parts"


def _limits(record: Mapping[str, Any]) -> Iterator[str]:
    """Report the number of points that keep each limit."""
    from tribodyn.mechanisms.results import known

    for entry in record.get("limits", []):
        key_result = known([entry["name"]], record["kind"])[entry["name"]]
        limit = f"{entry['limit']:g} {key_result.unit}".rstrip()
        share = 100.0 * entry["within"] / max(entry["points"], 1)
        between = ""
        if "low" in entry:
            between = f" (with 95 % confidence {100 * entry['low']:.0f} to {100 * entry['high']:.0f} %)"
        yield ""
        yield (
            f"{key_result.label}: at most {limit} at {entry['within']} of {entry['points']} points, "
            f"{share:.0f} %{between}"
        )


def _sensitivities(record: Mapping[str, Any], shown: Sequence[str]) -> Iterator[str]:
    """Report the share of each parameter in the variance of each number, alone and in all."""
    found = record.get("sensitivities", {})
    for name, one in _key_results(shown or list(found), record["kind"], every=bool(shown)).items():
        if name not in found:
            continue
        yield from ("", f"Sobol' indices of: {one.label} {one.unit}".rstrip())
        yield f"  {'':<34}{'alone':>16}{'in all':>16}"
        for path, index in found[name].items():
            alone, total = (
                f"{index[part]:.2f} ± {index.get(f'{part}_error', float('nan')):.2f}"
                for part in ("first", "total")
            )
            yield f"  {path:<34}{alone:>16}{total:>16}"


def _varying(points: Sequence[Mapping[str, Any]]) -> list[str]:
    """Return the names of the numbers that are not the same at all points; all where that says nothing."""
    names = {name: None for point in points for name in point}
    values = {name: {str(point[name]) for point in points if name in point} for name in names}
    alone = sum(not point["failure"] for point in points) < 2
    return [name for name in names if alone or len(values[name]) > 1]


def _key_results(given: Sequence[str], kind: str, *, every: bool) -> dict[str, KeyResult]:
    """Return the numbers that a user wants to see, by name."""
    from tribodyn.mechanisms.results import known

    found = known(given, kind)
    if every:
        return {name: found[name] for name in given if name in found}
    return {name: entry for name, entry in found.items() if entry.group not in LEFT_OUT}


def _points(
    points: Sequence[Mapping[str, Any]], numbers: Mapping[str, KeyResult], *, every: bool
) -> Iterator[str]:
    widths = {name: _width(name, points) for name in points[0]["changes"]}
    headings = {name: (name.replace(".", " "), width) for name, width in widths.items()}
    pieces = list(_pieces(numbers, _room(sum(widths.values()) + 2 * len(widths)))) or [[]]
    for piece in pieces if every else pieces[:1]:
        units = {name: fitting(numbers[name].unit, [point.get(name) for point in points]) for name in piece}
        shown = {name: factor for name, (_, factor) in units.items()}
        labels = {name: f"{numbers[name].label} {unit}".strip() for name, (unit, _) in units.items()}
        yield from _heading(headings, labels)
        for point in points[:_MOST_ROWS]:
            changes = (f"{point['changes'][name]:<{width}.{width}}" for name, width in widths.items())
            yield "  ".join([*changes, *(grey(cell, point.get("doubtful")) for cell in _cells(point, shown))])
    if len(points) > _MOST_ROWS:
        yield f"... {len(points) - _MOST_ROWS} more points"
    if len(pieces) > 1 and not every:
        yield f"... {len(numbers) - len(pieces[0])} more numbers in sweep.json; --show NAMES prints them"


def _width(name: str, points: Sequence[Mapping[str, Any]]) -> int:
    """Return the width of the column of a parameter: its heading is broken at dots, its values are cut."""
    values = [point["changes"][name] for point in points]
    return max(min(max(map(len, values)), _LONGEST), *map(len, name.split(".")))


def _cells(point: Mapping[str, Any], shown: Mapping[str, float]) -> Iterator[str]:
    """Yield the numbers of a point, each times the factor of its unit."""
    if point["failure"]:
        yield f"no result: {point['failure']}"[: (_COLUMN + 2) * len(shown)]
        return
    for name, factor in shown.items():
        ends = interval(point, name, factor)
        yield f"{ends:>{_COLUMN}}" if ends else _cell(point.get(name), factor)


def _heading(varied: Mapping[str, tuple[str, int]], shown: Mapping[str, str]) -> Iterator[str]:
    """Give the headings, broken into lines that fit above their columns."""
    columns = [(textwrap.wrap(text, width), f"<{width}") for text, width in varied.values()]
    columns += [(textwrap.wrap(text, _COLUMN), f">{_COLUMN}") for text in shown.values()]
    for line in range(max(len(words) for words, _ in columns)):
        cells = (f"{words[line] if line < len(words) else '':{place}}" for words, place in columns)
        yield "  ".join(cells).rstrip()


def _statistics(records: Sequence[Mapping[str, Any]], numbers: Mapping[str, KeyResult]) -> Iterator[str]:
    for record in records:
        at = ", ".join(f"{path} = {value}" for path, value in record["at"].items())
        yield from [at] if at else []
        yield from _one_statistic(record["numbers"], numbers)


def _one_statistic(
    record: Mapping[str, Mapping[str, float]], numbers: Mapping[str, KeyResult]
) -> Iterator[str]:
    units = {
        name: fitting(one.unit, record[name].values()) for name, one in numbers.items() if name in record
    }
    labels = {name: f"{numbers[name].label} {unit}".strip() for name, (unit, _) in units.items()}
    names = list(next(iter(record.values()), {}))
    width = max((len(label) for label in labels.values()), default=0)
    yield "  ".join([" " * (width + 2), *(f"{name:>{_COLUMN}}" for name in names)])
    for name, label in labels.items():
        cells = (_cell(record[name].get(statistic), units[name][1]) for statistic in names)
        yield "  ".join([f"  {label:<{width}}", *cells])


def _cell(value: object, factor: float) -> str:
    return f"{value * factor:>{_COLUMN}.4g}" if isinstance(value, (int, float)) else f"{'–':>{_COLUMN}}"
