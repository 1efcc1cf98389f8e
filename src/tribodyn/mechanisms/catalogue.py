"""The list of the mechanisms, and their cases: by built-in name, from a TOML file, from TOML text."""

from __future__ import annotations

import importlib
import os
from pathlib import Path
from typing import Final, cast

from tribodyn.cases import load
from tribodyn.cases.case import Case
from tribodyn.cases.load import BuiltIn
from tribodyn.mechanisms.base import Mechanism

FOLDERS: Final = (
    "vsv",
    "general",
    "journal",
)
"""Every mechanism by its folder beside this file, whose ``descriptor.py`` holds its ``MECHANISM``."""


def _described(folder: str) -> Mechanism:
    return cast(Mechanism, importlib.import_module(f"tribodyn.mechanisms.{folder}.descriptor").MECHANISM)


MECHANISMS: Final[dict[str, Mechanism]] = {
    mechanism.kind: mechanism for mechanism in map(_described, FOLDERS)
}
"""Every mechanism, by the kind of its cases."""


def kinds() -> dict[str, type[Case]]:
    """Return what may stand under ``case =`` in a file."""
    return {kind: mechanism.case for kind, mechanism in MECHANISMS.items()}


def built_in() -> dict[str, BuiltIn]:
    """Return the cases that can be run by name."""
    return {name: case for mechanism in MECHANISMS.values() for name, case in mechanism.built_in.items()}


def load_case(case: str | os.PathLike[str]) -> Case:
    """Return a case by built-in name or from a TOML file.

    Parameters
    ----------
    case
        A built-in name, as ``tribodyn cases`` lists them, or the path of a file.

    Raises
    ------
    InputError
        There is no such case or file, or something in the file is wrong.
    """
    return load.read_case(case, kinds(), built_in())


def parse_case(text: str, source: str, folder: Path | None = None) -> Case:
    """Return the case that a TOML text describes.

    Parameters
    ----------
    text
        Content of a case file.
    source
        Where it comes from, for messages.
    folder
        Where the names of files in it begin; None is the current directory.
    """
    return load.parse(text, source, kinds(), folder, built_in())
