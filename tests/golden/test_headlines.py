"""Built-in cases give the headline numbers that are stored beside this file.

``make golden`` writes them anew. Do that when a change of the physics is meant, look at the difference, and
say in the commit why.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Final

import pytest

import tribodyn as td
from tribodyn.mechanisms.catalogue import built_in
from tribodyn.mechanisms.results import known, summarise

STORED: Final = Path(__file__).with_name("headlines.json")
OF_THE_MACHINE: Final = ("Trust", "Ledger", "Effort")
"""Groups of numbers that rounding and processors move; other tests bound them."""
CLOSE: Final = 2e-3
"""Means, angles and wear: neighbouring tolerances of the vane mechanism stay within 0.11 % of a force."""
PEAKS: Final = 3e-2
"""What an impact decides: where steps fall moves it, from tolerance to tolerance as between processors."""
FREE: Final = {"four-bar": (1e-2, 0.25)}
"""The same of a case with free impacts: over six tolerances lie 1 % of its power, 21 % of its moment."""
OF_IMPACTS: Final = ("_max_", "peak_", "rebounds", "settling", "speed_error")


def numbers(name: str) -> dict[str, float]:
    """Return the headline numbers of a built-in case that the physics decides, not the machine."""
    result = td.simulate(td.load_case(name))
    summary = summarise(result)
    groups = {key: headline.group for key, headline in known(summary, result.attrs["kind"]).items()}
    return {
        key: float(f"{value:.6g}")
        for key, value in summary.items()
        if not isinstance(value, str | list) and groups[key] not in OF_THE_MACHINE
    }


@pytest.mark.parametrize("name", built_in())
def test_headline_numbers_are_those_stored(name: str) -> None:
    stored = json.loads(STORED.read_text(encoding="utf-8"))[name]
    found = numbers(name)
    assert found.keys() == stored.keys()
    close, peaks = FREE.get(name, (CLOSE, PEAKS))
    for key, value in stored.items():
        allowed = peaks if any(part in key for part in OF_IMPACTS) else close
        assert found[key] == pytest.approx(value, rel=allowed), key


if __name__ == "__main__":
    STORED.write_text(json.dumps({name: numbers(name) for name in built_in()}, indent=2) + "\n", "utf-8")
