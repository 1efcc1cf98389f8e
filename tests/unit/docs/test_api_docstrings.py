"""Docstrings of public functions and methods: parameters, what is returned, and what is raised."""

import importlib
import inspect
import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import tribodyn as td

MODULES = ("tribodyn", "tribodyn.contact", "tribodyn.integrate", "tribodyn.studies", "tribodyn.surfaces")
SECTIONS = ("Parameters", "Returns", "Raises")
#: Public functions that raise nothing of their own, and why.
NOTHING_RAISED = {
    "lined": "arithmetic on a table that exists",
    "moments": "arithmetic on heights; no height gives NaN",
    "statistics": "empty where nothing was sampled",
}


def public_members() -> Iterator[Any]:
    for module in map(importlib.import_module, MODULES):
        yield from ((f"{module.__name__}.{name}", getattr(module, name)) for name in module.__all__)


def methods() -> Iterator[Any]:
    for prefix, owner in public_members():
        if inspect.isclass(owner) and owner is not td.Mechanism:
            for name, found in vars(owner).items():
                method = found.__func__ if isinstance(found, (classmethod, staticmethod)) else found
                field = name in inspect.get_annotations(owner)
                if inspect.isfunction(method) and not field and not name.startswith("_"):
                    yield pytest.param(method, id=f"{prefix}.{name}")


def public() -> Iterator[Any]:
    for prefix, found in public_members():
        if inspect.isfunction(found):
            yield pytest.param(found, id=prefix)
    for name, found in vars(td.Mechanism).items():
        if inspect.isfunction(found) and not name.startswith("_"):
            yield pytest.param(found, id=f"Mechanism.{name}")


@pytest.mark.parametrize("function", list(public()))
def test_a_public_function_says_what_it_takes_returns_and_raises(function: Callable[..., Any]) -> None:
    said = check(function)
    assert "Raises" in said or function.__name__ in NOTHING_RAISED


@pytest.mark.parametrize("method", list(methods()))
def test_a_public_method_says_what_it_takes_and_returns_and_what_it_raises_itself(method):
    said = check(method)
    assert "Raises" in said or "    raise " not in inspect.getsource(method)


def check(function: Callable[..., Any]) -> list[str]:
    """Return the sections of a docstring, after a look at what every one of them must hold."""
    text = inspect.getdoc(function) or ""
    signature = inspect.signature(function)
    takes = [name for name in signature.parameters if name not in ("self", "cls")]
    wanted = ["Parameters"] if takes else []
    wanted += ["Returns"] if signature.return_annotation not in (None, "None") else []
    said = [name for name in SECTIONS if f"{name}\n{'-' * len(name)}\n" in text]
    assert [name for name in wanted if name not in said] == []
    arrays = [name for name, one in signature.parameters.items() if "FloatArray" in str(one.annotation)]
    for name in arrays:
        meaning = re.search(rf"^{name}\n((?: {{4}}.*\n?)+)", text, re.M)
        assert meaning is not None, name
        assert "shape" in meaning[1].lower(), name
    return said
