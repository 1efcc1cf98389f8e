"""Members of a family that stand in modules of a package."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from importlib import import_module
from typing import TypeVar

T = TypeVar("T")


def members_of(package: str, names: Iterable[str], base: type[T]) -> Iterator[type[T]]:
    """Yield the classes of a kind that modules of a package define, in the order of the modules.

    Parameters
    ----------
    package
        Dotted name of the package.
    names
        Its modules that hold members.
    base
        What members are classes of; classes whose names begin with an underscore are none.
    """
    for name in names:
        module = import_module(f"{package}.{name}")
        for kind in vars(module).values():
            own = isinstance(kind, type) and kind.__module__ == module.__name__
            if own and issubclass(kind, base) and not kind.__name__.startswith("_"):
                yield kind
