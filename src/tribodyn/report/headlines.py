"""The headline numbers and facts of a run, as the page shows them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import groupby
from typing import Any

import xarray as xr

from tribodyn.mechanisms.results import known
from tribodyn.results import Headline
from tribodyn.views.numbers import in_words

Number = dict[str, str]
"""A headline number with ``label``, ``value``, ``unit`` and ``meaning``."""


def number(headline: Headline, value: object) -> Number:
    """Return a headline number in words."""
    return {
        "label": headline.label,
        "value": in_words(value),
        "unit": headline.unit,
        "meaning": headline.meaning,
    }


def chosen(summary: Mapping[str, Any], names: Iterable[str]) -> list[Number]:
    """Return those of the named numbers that a summary holds."""
    found = known(summary, str(summary["kind"]))
    return [number(found[name], summary[name]) for name in names if name in found]


def grouped(summary: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return all headline numbers of a summary in their groups."""
    numbers = known(summary, str(summary["kind"])).items()
    return [
        {"name": group, "numbers": [number(headline, summary[name]) for name, headline in members]}
        for group, members in groupby(numbers, key=lambda entry: entry[1].group)
    ]


def facts(dataset: xr.Dataset) -> dict[str, str]:
    """Return what kind of run it was, in a few words."""
    attributes, shown = dataset.attrs, {}
    if "clearance" in attributes:
        shown["clearance"] = f"{in_words(attributes['clearance'] * 1e6)} µm"
    if "contact_law" in attributes:
        shown["contact law"] = str(attributes["contact_law"])
    if "formulation" in attributes:
        shown["formulation"] = str(attributes["formulation"])
    if "friction_coefficient" in attributes:
        # The source paper gives no value; a reader must not take the number for a measured one.
        shown["friction coefficient"] = f"{in_words(attributes['friction_coefficient'])} (assumed)"
    return shown


def versions(dataset: xr.Dataset) -> dict[str, str]:
    """Return the versions of what made the result."""
    ending = "_version"
    return {
        name.removesuffix(ending): str(value)
        for name, value in dataset.attrs.items()
        if isinstance(name, str) and name.endswith(ending)
    }
