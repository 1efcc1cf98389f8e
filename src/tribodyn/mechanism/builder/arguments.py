"""Keyword arguments of the builder, from the keys of a case: names, types, meanings, defaults."""

import inspect
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Final

from pydantic import BaseModel

from tribodyn.cases.keys import ANY_NAME, VALUE, Key, groups_of, keys_of
from tribodyn.mechanism.mechanism_case import MechanismCase

CASE: Final = "case"
#: Annotations by kind of key; other kinds are text.
_TYPES: Final = {
    "quantity": "str",
    "number": "float | str",
    "count": "int | str",
    "switch": "bool",
    "vector": "Vector",
    "series": "Vector",
    "names": "Sequence[str]",
}


@dataclass(frozen=True)
class Argument:
    """A keyword argument of a method: a key, or a table of keys."""

    annotation: str  #: Its type.
    text: str  #: Its meaning, what it may hold, and its default.
    required: bool  #: Whether it must be given.

    def with_need(self, needed: bool) -> "Argument":
        """Return the same, which must be given if ``needed``."""
        return self if self.required or not needed else Argument(self.annotation, self.text, True)


@cache
def arguments_of(model: type[BaseModel]) -> Mapping[str, Argument]:
    """Return the keyword arguments for the keys and tables of a model, in their order."""
    keys, tables = keys_of(model), dict(groups_of(model))
    replaceable = {key for pair in getattr(model, "ALTERNATIVES", ()) for key in pair}
    found: dict[str, Argument] = {}
    for name, info in model.model_fields.items():
        if f"{name}.{ANY_NAME}" in tables:
            text = f"{_sentence(info.description or '')} Tables by their names."
            found[name] = Argument("Table", text, False)
        elif name in tables:
            found[name] = _of_table(tables[name])
        else:
            found[name] = _of_key(keys[name], name not in replaceable)
    return found


def _of_key(key: Key, alone: bool) -> Argument:
    """Return the argument for a key, which may be left out unless it is required and stands alone."""
    default = "" if key.default is None else f" Default {key.write(key.default)}."
    text = f"{_sentence(key.description)} {_sentence(key.allowed)}{default}"
    return Argument(_TYPES.get(key.kind, "str"), text, key.required and alone)


def _of_table(group: type[BaseModel]) -> Argument:
    """Return the argument for a table, which may be its value alone where it has one."""
    about = str(group.__doc__).splitlines()[0]
    own = keys_of(group)
    names = ", ".join(dict.fromkeys(path.split(".")[0] for path in own))
    value = f"{own[VALUE].allowed.replace('a number', 'A number', 1)}; or a" if VALUE in own else "A"
    text = f"{_sentence(about)} {value} table of these keys: {names}."
    return Argument("str | Table" if VALUE in own else "Table", text, False)


def _sentence(text: str) -> str:
    """Return words as a sentence."""
    return f"{text[:1].upper()}{text[1:].rstrip('.')}." if text else ""


def parameters_of(arguments: Mapping[str, Argument]) -> Iterator[inspect.Parameter]:
    """Yield keyword arguments as those of a signature."""
    for name, one in arguments.items():
        kind = inspect.Parameter.KEYWORD_ONLY
        if one.required:
            yield inspect.Parameter(name, kind, annotation=one.annotation)
        else:
            yield inspect.Parameter(name, kind, annotation=f"{one.annotation} | None", default=None)


def signature_of_case() -> inspect.Signature:
    """Return the signature of the builder: its title, and keys and tables of a case."""
    kind, title = inspect.Parameter.POSITIONAL_OR_KEYWORD, "title"
    own = inspect.Parameter(
        title, kind, annotation="str", default=str(MechanismCase.model_fields[title].default)
    )
    others = {name: one for name, one in arguments_of(MechanismCase).items() if name not in (CASE, title)}
    return inspect.Signature([own, *parameters_of(others)], return_annotation=None)
