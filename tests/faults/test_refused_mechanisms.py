"""Mechanisms that cannot be: one change to a slider-crank each, and the message that its designer reads."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest
from tests.unit.mechanisms.general.slider_crank import FILE, IDEAL, parsed

from tribodyn.core.errors import InputError
from tribodyn.mechanisms.general.system import MechanismSystem

REFUSED = tomllib.loads(Path(__file__).with_name("refused_mechanisms.toml").read_text(encoding="utf-8"))


def test_the_slider_crank_itself_is_sound() -> None:
    for text in (FILE, IDEAL):
        assert MechanismSystem(parsed(text)).check()


@pytest.mark.parametrize("name", REFUSED)
def test_a_mechanism_that_cannot_be_is_refused_in_words(name: str) -> None:
    change = REFUSED[name]
    text = IDEAL if change.get("ideal") else FILE
    assert text.count(change["old"]) >= 1
    with pytest.raises(InputError) as caught:
        MechanismSystem(parsed(text.replace(change["old"], change["new"], 1))).check()
    assert str(caught.value) == change["message"]
