"""The register of predictions: complete, and equal to what the package computes from the same inputs."""

from __future__ import annotations

import datetime

import pytest

from tribodyn.validation.catalogue import load
from tribodyn.validation.predictions import computed, fingerprint, register

ENTERED = datetime.date(2026, 11, 23)
"""Day of the first entries; later models add later ones."""


def test_every_entry_has_an_interval_and_its_origin() -> None:
    entries = register()
    assert len({(entry["name"], entry["date"]) for entry in entries}) == len(entries)
    for entry in entries:
        assert entry["low"] <= entry["value"] <= entry["high"]
        assert len(entry["hash"]) == 64
        assert isinstance(entry["date"], datetime.date)
        assert entry["unit"]


def test_held_back_points_of_every_kind_are_entered() -> None:
    entered = " ".join(entry["name"] for entry in register())
    for kind in ("450 N", "coupled", "preloaded", "rebound angle", "spin", "start torque", "stop torque"):
        assert kind in entered


def test_first_entries_follow_from_their_inputs() -> None:
    """An entry that was changed afterwards, or inputs that were, are found here."""
    first = {entry["name"]: entry for entry in register() if entry["date"] == ENTERED}
    found = {prediction.name: prediction for prediction in computed()}
    assert set(first) == set(found)
    for name, entry in first.items():
        assert entry["hash"] == fingerprint(load(entry["set"])), name
        for key in ("value", "low", "high"):
            assert getattr(found[name], key) == pytest.approx(entry[key], rel=2e-3, abs=2e-3), name
