"""Scripts of a page share one scope: each declares names of its own."""

from __future__ import annotations

import re
from collections import Counter
from importlib.resources import files
from itertools import chain

import pytest

_DECLARED = re.compile(r"^(?:async\s+)?(?:function\*?|const|let|var|class)\s+(\w+)", re.M)


def declared(package: str) -> Counter[str]:
    scripts = [path.read_text("utf-8") for path in files(package).iterdir() if path.name.endswith(".js")]
    return Counter(chain.from_iterable(map(_DECLARED.findall, scripts)))


@pytest.mark.parametrize("package", ["tribodyn.report.assets", "tribodyn.workbench.assets"])
def test_no_name_is_declared_twice(package: str) -> None:
    names = declared(package)
    assert len(names) > 10
    assert {name: number for name, number in names.items() if number > 1} == {}
