"""The end of a run in words: the headline numbers and where to look."""

from __future__ import annotations

from collections.abc import Iterator, Mapping


def in_words(summary: Mapping[str, object]) -> Iterator[str]:
    """Give one line for each headline number, aligned, with its unit.

    Parameters
    ----------
    summary
        Content of ``summary.json``.
    """
    from tribodyn.mechanisms.results import known

    headlines = known(summary, str(summary.get("kind", "")))
    width = max((len(headline.label) for headline in headlines.values()), default=0)
    for name, headline in headlines.items():
        yield f"  {headline.label:<{width}}  {_number(summary[name])} {headline.unit}".rstrip()


def _number(value: object) -> str:
    """Write a number with four digits that mean something; counts in full."""
    return f"{value:>9.4g}" if isinstance(value, float) else f"{value!s:>9}"
