"""Names of mechanisms occur in their own folders only."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tribodyn.mechanisms.catalogue import FOLDERS

SOURCE = Path(__file__).parents[2] / "src" / "tribodyn"
CATALOGUE = SOURCE / "mechanisms" / "catalogue.py"
ORDINARY = ("mechanism",)  #: Names that are words of prose, too: an import is what counts.
#: The list of what is compiled begins with the laws of elements, which stand there.
LISTING = SOURCE / "kernels" / "jit.py"
PUBLIC = SOURCE / "__init__.py"  #: What a user imports from the package says where it is.


@pytest.mark.parametrize("name", ["vsv", *(package.rpartition(".")[2] for package in FOLDERS.values())])
def test_no_mechanism_is_named_outside_its_folders(name: str) -> None:
    word = re.compile(rf"tribodyn\.{name}\b" if name in ORDINARY else rf"\b{name}\b")
    found = [
        str(path.relative_to(SOURCE))
        for path in SOURCE.rglob("*.py")
        if name not in path.relative_to(SOURCE).parts
        and path not in (CATALOGUE, LISTING, PUBLIC)
        and not {"papers", "validation"} & set(path.relative_to(SOURCE).parts)
        and word.search(path.read_text(encoding="utf-8"))
    ]
    assert found == []
