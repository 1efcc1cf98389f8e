"""Members of a family that stand in modules of a package, and keys of their own."""

from collections.abc import Iterable, Iterator
from importlib import import_module
from typing import Any, ClassVar, Protocol, TypeVar

from pydantic import create_model

from tribodyn.cases.case import NamedGroup

T = TypeVar("T")


class WithKeys(Protocol):
    """A member with keys of its own."""

    NAME: ClassVar[str]
    KEYS: ClassVar[type[NamedGroup]]


M = TypeVar("M", bound=WithKeys)


def members_of(package: str, names: Iterable[str], base: type[T]) -> Iterator[type[T]]:
    """Yield the classes of a kind that modules of a package define, in the order of the modules.

    ``package``: dotted name of the package; ``names``: its modules that hold members; ``base``: what members
    are classes of; classes whose names begin with an underscore are none.
    """
    for name in names:
        module = import_module(f"{package}.{name}")
        for kind in vars(module).values():
            own = isinstance(kind, type) and kind.__module__ == module.__name__
            if own and issubclass(kind, base) and not kind.__name__.startswith("_"):
                yield kind


def with_own_keys(common: type[NamedGroup], members: Iterable[WithKeys]) -> Any:
    """Return the keys that all members share, followed by those of single ones."""
    own = [kind for kind in dict.fromkeys(member.KEYS for member in members) if kind is not NamedGroup]
    make: Any = create_model
    found = make("_WithOwnKeys", __base__=(*reversed(own), common), __module__=common.__module__)
    found.ALTERNATIVES = sum((kind.ALTERNATIVES for kind in own), ())
    return found


def foreign_keys(keys: NamedGroup, member: WithKeys, members: Iterable[M]) -> Iterator[tuple[M, str]]:
    """Yield the keys that are given and belong to other members, each after one that it belongs to."""
    for other in members:
        for key, field in other.KEYS.model_fields.items():
            if key not in member.KEYS.model_fields and getattr(keys, key) != field.default:
                yield other, key
