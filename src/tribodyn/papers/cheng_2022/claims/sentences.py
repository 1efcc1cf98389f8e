"""The sentences of the paper that claim a result, each with its place."""

from __future__ import annotations

import tomllib
from importlib.resources import files
from typing import Final, NamedTuple


class Sentence(NamedTuple):
    """A sentence of the paper.

    Attributes
    ----------
    where
        Section, and figure where it names one.
    text
        Its words, shortened where dots stand.
    """

    where: str
    text: str


def _read() -> dict[str, Sentence]:
    text = files(__package__).joinpath("sentences.toml").read_text(encoding="utf-8")
    return {name: Sentence(**row) for name, row in tomllib.loads(text).items()}


SENTENCES: Final = _read()
"""Sentences by name, in the order of the paper."""
