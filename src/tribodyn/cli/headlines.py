"""The end of a run in words: the headline numbers and where to look."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Mapping
from typing import Final

from tribodyn.views.numbers import rounded

_SHOWN_IN_FULL: Final = (1e4, 1e9)
_GREY: Final = "\x1b[2m"
_PLAIN: Final = "\x1b[0m"


def in_words(summary: Mapping[str, object]) -> Iterator[str]:
    """Give one line for each headline number, aligned, with its unit; grey where they are doubtful.

    Parameters
    ----------
    summary
        Content of ``summary.json``.
    """
    from tribodyn.results.summary import caution

    doubt = summary.get("doubtful")
    if doubt:
        yield f"  {caution(doubt)}"
    yield from (grey(line, doubt) for line in _numbers(summary))


def grey(text: str, doubt: object) -> str:
    """Return a text that a terminal shows in grey where there is a doubt, unless colours are unwanted."""
    wanted = doubt and sys.stdout.isatty() and "NO_COLOR" not in os.environ
    return f"{_GREY}{text}{_PLAIN}" if wanted else text


def _numbers(summary: Mapping[str, object]) -> Iterator[str]:
    from tribodyn.mechanisms.results import known

    headlines = known(summary, str(summary.get("kind", "")))
    labels = {name: headline.label_in(summary) for name, headline in headlines.items()}
    width = max(map(len, labels.values()), default=0)
    for name, headline in headlines.items():
        yield f"  {labels[name]:<{width}}  {_number(summary[name], headline.digits)} {headline.unit}".rstrip()


def _number(value: object, digits: int) -> str:
    """Write a number with the digits that hold, not in powers of ten where it need not be; counts in full."""
    if not isinstance(value, float):
        return f"{value!s:>9}"
    number = rounded(value, digits)
    return f"{number:>9.0f}" if _SHOWN_IN_FULL[0] <= abs(number) < _SHOWN_IN_FULL[1] else f"{number:>9.4g}"
