"""The register of predictions: complete, and equal to what the package computes from the same inputs."""

import datetime
import hashlib
from importlib.resources import files

import pytest

from tribodyn.validation.catalogue import load
from tribodyn.validation.predictions import FILE, computed, fingerprint, register

ENTERED = datetime.date(2026, 11, 23)  #: Day of the first entries; later models add later ones.
#: Kinds that need runs.
RUN = ("plateau", "with a joint", "July, 1 Hz", "earthquakes", "28 mm head", "45 % PTFE", "0 % PTFE, 98 N")
#: Hash of the register with the first entries only.
FIRST = "d924c267203c27f2094fd0376500c2b4e6978beffb7e9dccd655eeaa55d63ad6"


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
    for kind in (
        "450 N",
        "coupled",
        "preloaded",
        "rebound angle",
        "spin",
        "start torque",
        "stop torque",
        *RUN,
    ):
        assert kind in entered


def test_first_entries_are_as_they_were_entered() -> None:
    text = (files("tribodyn.validation") / FILE).read_text(encoding="utf-8")
    first = text[: text.index("date = 2026-11-26")].rpartition("[[prediction]]")[0].rstrip() + "\n"
    assert hashlib.sha256(first.encode()).hexdigest() == FIRST
    assert sum(entry["date"] == ENTERED for entry in register()) == first.count("[[prediction]]")


@pytest.mark.long
def test_newest_entries_follow_from_their_inputs_and_say_what_refutes_them() -> None:
    """An entry that was changed afterwards, or inputs that were, are found here."""
    newest = {entry["name"]: entry for entry in register() if entry["date"] > ENTERED}
    old = {entry["name"]: entry for entry in register() if entry["date"] == ENTERED}
    found = {prediction.name: prediction for prediction in computed()}
    assert set(newest) == set(found)
    for name, entry in newest.items():
        assert entry["hash"] == fingerprint(load(entry["set"])), name
        for key in ("value", "low", "high", "null", "null_low", "null_high", "half_width"):
            assert getattr(found[name], key) == pytest.approx(entry[key], rel=2e-3, abs=2e-3), name
        if name in old:
            assert entry["value"] == pytest.approx(old[name]["value"], rel=2e-3, abs=2e-3), "the same model"
        assert entry["null_low"] <= entry["null"] <= entry["null_high"]
        assert entry["level"] == 0.95
        assert entry["reading"]
        assert entry["refuted_by"].startswith("a measured value below ")


def test_the_film_reaches_no_peak_above_its_own() -> None:
    """Every assumed input only lowers the peak of the bearing; mirrored, its interval went up to 1168 kPa."""
    (entry,) = [e for e in register() if e["date"] > ENTERED and e["name"].startswith("peak pressure, 250")]
    assert (entry["low"], entry["high"]) == pytest.approx((586.0, 877.0), abs=1.0)
