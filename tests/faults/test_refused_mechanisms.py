"""Mechanisms that cannot be: one change to a slider-crank each, and the message that its designer reads."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest
from tests.unit.mechanisms.general.slider_crank import FILE, parsed

from tribodyn.core.errors import InputError

REFUSED = tomllib.loads(Path(__file__).with_name("refused_mechanisms.toml").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", REFUSED)
def test_a_mechanism_that_cannot_be_is_refused_in_words(name: str) -> None:
    change = REFUSED[name]
    assert FILE.count(change["old"]) >= 1
    with pytest.raises(InputError) as caught:
        parsed(FILE.replace(change["old"], change["new"], 1))
    assert str(caught.value) == change["message"]
