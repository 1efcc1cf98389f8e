"""Choices of a case: all its settings but numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from tribodyn.cases.case import Case

Choices: TypeAlias = frozenset[tuple[str, object]]


def choices_of(case: Case) -> Choices:
    """Return the choices of a case but for its title. Cases that agree in them have the same equations."""
    return frozenset(_choices(case.model_dump(exclude={"title", "results"})))


def _choices(settings: Mapping[str, Any], path: str = "") -> Iterator[tuple[str, object]]:
    """Yield settings below a path."""
    for name, value in settings.items():
        if isinstance(value, Mapping):
            yield from _choices(value, f"{path}{name}.")
        elif value is None or isinstance(value, str | bool):
            yield f"{path}{name}", value
