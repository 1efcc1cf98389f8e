"""Tables that a user names, as ``[joints.crankpin]``: their keys, once the names are known.

Such a field is declared with :func:`tribodyn.cases.fields.tables`. Its keys are known as
``joints.*.clearance`` before there is a case, and as ``joints.crankpin.clearance`` in one.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from itertools import groupby
from typing import Any, Final, NoReturn

from pydantic import BaseModel

from tribodyn.cases.keys import ANY_NAME, Key, keys_of

LONGEST_NAME: Final = 40
ALLOWED_NAME: Final = f"a name of letters without accents, digits, - and _, at most {LONGEST_NAME} of them"
_NAME: Final = re.compile(rf"[A-Za-z0-9_-]{{1,{LONGEST_NAME}}}")


class Tables(dict[str, Any]):
    """Tables by their names; frozen, as all of a case is."""

    def _refuse(self, *_: object, **__: object) -> NoReturn:
        raise TypeError("a case is frozen; replace() returns a changed copy")

    __setitem__ = __delitem__ = __ior__ = clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle and copy as a whole: filling is refused."""
        return type(self), (dict(self),)


def expanded(declared: Mapping[str, Key], paths: Iterable[str]) -> dict[str, Key]:
    """Return the keys that there are, given the names of tables in some dotted paths.

    Parameters
    ----------
    declared
        From :func:`tribodyn.cases.keys.keys_of`.
    paths
        Of keys and tables; names that none can have are passed over.
    """
    found: dict[str, Key] = {}
    for before, group in groupby(declared.values(), key=lambda key: _before_name(key.path)):
        keys = {key.path: key for key in group}
        if before is None:
            found |= keys
            continue
        below = [path for path in paths if path.startswith(before)]
        for name in dict.fromkeys(path[len(before) :].partition(".")[0] for path in below):
            if _NAME.fullmatch(name):
                named = (replace(key, path=_with_name(key.path, name)) for key in keys.values())
                found |= expanded({key.path: key for key in named}, below)
    return found


def keys_in(case: BaseModel) -> dict[str, Key]:
    """Return every key of a case, by dotted path, with those of the tables that it names."""
    declared = keys_of(type(case))
    if not any(ANY_NAME in path for path in declared):
        return declared
    return expanded(declared, list(_paths(case.model_dump())))


def value_at(case: BaseModel, path: str) -> Any:
    """Return the value of a case at a dotted path."""
    value: Any = case
    for name in path.split("."):
        value = value[name] if isinstance(value, Mapping) else getattr(value, name)
    return value


def impossible_name(path: str, declared: Mapping[str, Key]) -> str | None:
    """Return the first name in a dotted path that no table can have."""
    steps = path.split(".")
    for key in declared.values():
        pattern = key.path.split(".")
        for place, step in enumerate(pattern[: len(steps)]):
            if step == ANY_NAME and not _NAME.fullmatch(steps[place]):
                return ".".join(steps[place:])
            if step not in (ANY_NAME, steps[place]):
                break
    return None


def general(path: str, declared: Mapping[str, Key]) -> str:
    """Return the dotted path of a key or table as it is declared: without the names that a user chose."""
    steps = path.split(".")
    for key in declared.values():
        pattern = key.path.split(".")[: len(steps)]
        if len(pattern) == len(steps) and all(
            place in (ANY_NAME, step) for place, step in zip(pattern, steps, strict=True)
        ):
            return ".".join(pattern)
    return path


def _before_name(path: str) -> str | None:
    """Return what stands before the first name that a user chooses; None if there is none."""
    before, name, _ = path.partition(ANY_NAME)
    return before if name else None


def _with_name(path: str, name: str) -> str:
    return path.replace(ANY_NAME, name, 1)


def _paths(values: Mapping[str, Any], prefix: str = "") -> Iterator[str]:
    """Yield the dotted paths of all values."""
    for name, value in values.items():
        if isinstance(value, Mapping):
            yield from _paths(value, f"{prefix}{name}.")
        else:
            yield prefix + name
