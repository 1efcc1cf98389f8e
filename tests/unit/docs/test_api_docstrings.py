"""Docstrings of the public functions: parameters, what is returned, and what is raised."""

from __future__ import annotations

import importlib
import inspect
import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import tribodyn as td

MODULES = ("tribodyn", "tribodyn.contact", "tribodyn.integrate", "tribodyn.studies", "tribodyn.surfaces")
NOTHING_RAISED = {
    "lined": "arithmetic on a table that exists",
    "moments": "arithmetic on heights; no height gives NaN",
    "statistics": "empty where nothing was sampled",
}
"""Public functions that raise nothing of their own, and why."""


def public() -> Iterator[Any]:
    for module in map(importlib.import_module, MODULES):
        for name in module.__all__:
            found = getattr(module, name)
            if inspect.isfunction(found):
                yield pytest.param(found, id=f"{module.__name__}.{name}")
    for name, found in vars(td.Mechanism).items():
        if inspect.isfunction(found) and not name.startswith("_"):
            yield pytest.param(found, id=f"Mechanism.{name}")


@pytest.mark.parametrize("function", list(public()))
def test_a_public_function_says_what_it_takes_returns_and_raises(function: Callable[..., Any]) -> None:
    text = inspect.getdoc(function) or ""
    signature = inspect.signature(function)
    takes = [name for name in signature.parameters if name != "self"]
    wanted = ["Parameters"] if takes else []
    wanted += ["Returns"] if signature.return_annotation not in (None, "None") else []
    wanted += [] if function.__name__ in NOTHING_RAISED else ["Raises"]
    assert [name for name in wanted if f"{name}\n{'-' * len(name)}\n" not in text] == []
    arrays = [name for name, one in signature.parameters.items() if "FloatArray" in str(one.annotation)]
    for name in arrays:
        meaning = re.search(rf"^{name}\n((?: {{4}}.*\n?)+)", text, re.M)
        assert meaning is not None, name
        assert "shape" in meaning[1].lower(), name
