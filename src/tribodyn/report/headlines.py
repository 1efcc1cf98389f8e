"""The headline numbers and facts of a run, as the page shows them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import groupby
from typing import Any

import xarray as xr

from tribodyn.cases import keys_of
from tribodyn.cases.keys import ASSUMED
from tribodyn.mechanisms.results import known, mechanism_of
from tribodyn.results import Headline
from tribodyn.views.numbers import in_words

Number = dict[str, str]
"""A headline number with ``label``, ``value``, ``unit`` and ``meaning``."""


def number(headline: Headline, summary: Mapping[str, Any], name: str) -> Number:
    """Return a headline number of a summary in words."""
    return {
        "label": headline.label_in(summary),
        "value": in_words(summary[name], headline.digits),
        "unit": headline.unit,
        "meaning": headline.meaning,
    }


def chosen(summary: Mapping[str, Any], names: Iterable[str]) -> list[Number]:
    """Return those of the named numbers that a summary holds."""
    found = known(summary, str(summary["kind"]))
    return [number(found[name], summary, name) for name in names if name in found]


def grouped(summary: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return all headline numbers of a summary in their groups."""
    numbers = known(summary, str(summary["kind"])).items()
    return [
        {"name": group, "numbers": [number(headline, summary, name) for name, headline in members]}
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
        shown["friction coefficient"] = in_words(attributes["friction_coefficient"]) + _ours(dataset)
    return shown


def _ours(dataset: xr.Dataset) -> str:
    """Say of a friction coefficient that it is our default; a reader must not take it for a measured one."""
    key = keys_of(mechanism_of(dataset).case)["joint.friction_coefficient"]
    assumed = key.source == ASSUMED and dataset.attrs["friction_coefficient"] == key.default
    return " (the default, assumed)" if assumed else ""


def versions(dataset: xr.Dataset) -> dict[str, str]:
    """Return the versions of what made the result."""
    ending = "_version"
    return {
        name.removesuffix(ending): str(value)
        for name, value in dataset.attrs.items()
        if isinstance(name, str) and name.endswith(ending)
    }
