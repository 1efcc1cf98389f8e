"""Messages from a page, their kinds and fields; and frames of results on their way to it."""

import json
import struct
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Final, TypeAlias

from tribodyn.core.quoting import brief
from tribodyn.views.encode import block

LARGEST: Final = 65_536  #: Length of a message [bytes].
_MOST_VALUES: Final = 200
_LONGEST_KEY, _LONGEST_TEXT = 200, 2000
_LARGEST_NUMBER: Final = 2**32
_EDIT_FIELDS: Final = ("template", "removed", "added")
_RUN_DIGITS: Final = 16
_POINTS: Final = (9, 25)  #: Least and greatest number of points of a sweep.

Values: TypeAlias = Mapping[str, str]


class InvalidMessage(ValueError):
    """A message is not one that a page may send; the text gives the reason."""


@dataclass(frozen=True)
class Edit:
    """Difference of a model from the case of the workbench."""

    template: str = ""  #: Name of the template that it starts from; empty for the case of the workbench.
    removed: tuple[str, ...] = ()  #: Dotted paths of the tables that are left out.
    added: Values = field(default_factory=dict)  #: Values of the tables that are added, by dotted path.


@dataclass(frozen=True)
class RunRequest:
    """A run with other values; ``rest``: the gesture has ended; ``agreed``: the user accepts its cost."""

    number: int
    values: Values
    rest: bool = False
    agreed: bool = False
    edit: Edit = Edit()


@dataclass(frozen=True)
class Drawn:
    """The page has drawn the answer to a request."""

    number: int


@dataclass(frozen=True)
class Cancel:
    """The request with this number is cancelled."""

    number: int


@dataclass(frozen=True)
class Pin:
    """A run is to be kept, or no longer."""

    run: str
    kept: bool


@dataclass(frozen=True)
class Sweep:
    """Runs along one key; ends are texts with units, empty for what has choices."""

    number: int
    key: str
    values: Values
    ends: tuple[str, str] = ("", "")
    points: int = _POINTS[0]


@dataclass(frozen=True)
class SlopeRequest:
    """Runs close to a value of one key."""

    number: int
    key: str
    values: Values


Message: TypeAlias = RunRequest | Drawn | Cancel | Pin | Sweep | SlopeRequest


def parsed(text: str | bytes) -> Message:
    """Return the message that a page sent.

    Raises InvalidMessage if it has no known kind, or its fields are invalid.
    """
    if isinstance(text, bytes):
        raise InvalidMessage("a message is text")
    try:
        said = json.loads(text)
    except (ValueError, RecursionError):
        raise InvalidMessage("a message is JSON") from None
    if not isinstance(said, dict):
        raise InvalidMessage("a message is an object")
    kind = said.pop("type", None)
    if not isinstance(kind, str) or kind not in _KINDS:
        raise InvalidMessage(f"there is no message {brief(kind)!r}; known: {', '.join(_KINDS)}")
    fields, made = _KINDS[kind]
    if unknown := said.keys() - fields:
        raise InvalidMessage(
            f"{kind} has no field {brief(min(unknown))!r}; known: {', '.join(sorted(fields))}"
        )
    return made(said)


def _run(said: Mapping[str, Any]) -> RunRequest:
    agreed = _switch(said, "agreed")
    return RunRequest(_number(said), _values(said), _switch(said, "rest"), agreed, _edit(said))


def _edit(said: Mapping[str, Any]) -> Edit:
    edit = said.get("edit", {})
    if not isinstance(edit, dict) or edit.keys() - _EDIT_FIELDS:
        raise InvalidMessage(f"edit: an object with {', '.join(_EDIT_FIELDS)} is needed")
    removed = edit.get("removed", [])
    if not isinstance(removed, list) or len(removed) > _MOST_VALUES:
        raise InvalidMessage(f"removed: a list of at most {_MOST_VALUES} tables is needed")
    if not all(isinstance(table, str) and len(table) <= _LONGEST_KEY for table in removed):
        raise InvalidMessage(f"removed: names of at most {_LONGEST_KEY} characters are needed")
    return Edit(_text(edit, "template", ""), tuple(removed), _values(edit, "added"))


def _sweep(said: Mapping[str, Any]) -> Sweep:
    ends = _text(said, "from", ""), _text(said, "to", "")
    points = said.get("points", _POINTS[0])
    if type(points) is not int or not _POINTS[0] <= points <= _POINTS[1]:
        raise InvalidMessage(f"points: a whole number from {_POINTS[0]} to {_POINTS[1]} is needed")
    return Sweep(_number(said), _text(said, "key"), _values(said), ends, points)


def _pin(kept: bool) -> Callable[[Mapping[str, Any]], Pin]:
    def made(said: Mapping[str, Any]) -> Pin:
        run = _text(said, "run")
        if len(run) != _RUN_DIGITS or set(run) - set("0123456789abcdef"):
            raise InvalidMessage(f"run: {_RUN_DIGITS} hexadecimal digits are needed")
        return Pin(run, kept)

    return made


#: Fields and constructors of all messages, by their type.
_KINDS: Final[dict[str, tuple[frozenset[str], Callable[[Mapping[str, Any]], Message]]]] = {
    "run": (frozenset({"number", "values", "rest", "agreed", "edit"}), _run),
    "drawn": (frozenset({"number"}), lambda said: Drawn(_number(said))),
    "cancel": (frozenset({"number"}), lambda said: Cancel(_number(said))),
    "pin": (frozenset({"run"}), _pin(True)),
    "unpin": (frozenset({"run"}), _pin(False)),
    "sweep": (frozenset({"number", "key", "values", "from", "to", "points"}), _sweep),
    "slope": (
        frozenset({"number", "key", "values"}),
        lambda said: SlopeRequest(_number(said), _text(said, "key"), _values(said)),
    ),
}


def _number(said: Mapping[str, Any]) -> int:
    number = said.get("number")
    if type(number) is not int or not 0 <= number < _LARGEST_NUMBER:
        raise InvalidMessage("number: a whole number from 0 to 2^32 - 1 is needed")
    return number


def _switch(said: Mapping[str, Any], name: str) -> bool:
    value = said.get(name, False)
    if not isinstance(value, bool):
        raise InvalidMessage(f"{name}: true or false is needed")
    return value


def _text(said: Mapping[str, Any], name: str, default: str | None = None) -> str:
    value = said.get(name, default)
    if not isinstance(value, str) or len(value) > _LONGEST_TEXT:
        raise InvalidMessage(f"{name}: a text of at most {_LONGEST_TEXT} characters is needed")
    return value


def _values(said: Mapping[str, Any], name: str = "values") -> Values:
    values = said.get(name, {})
    if not isinstance(values, dict) or len(values) > _MOST_VALUES:
        raise InvalidMessage(f"{name}: at most {_MOST_VALUES} keys with their values are needed")
    if any(len(key) > _LONGEST_KEY for key in values):
        raise InvalidMessage(f"{name}: keys of at most {_LONGEST_KEY} characters are needed")
    return {key: _value(key, value) for key, value in values.items()}


def _value(key: str, value: object) -> str:
    """Return a value as text."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int | float):
        return repr(value)
    if not isinstance(value, str) or len(value) > _LONGEST_TEXT:
        raise InvalidMessage(f"{brief(key)}: a text of at most {_LONGEST_TEXT} characters is needed")
    return value


MAGIC: Final = 0x31464254
KEPT: Final = 1  #: Flag of a frame that was computed for an earlier request.
_START: Final = struct.Struct("<IIII")


def body(header: Mapping[str, Any]) -> bytes:
    """Return all of a frame but its first sixteen bytes, after the length of its header.

    ``header``: what the page reads. Arrays in it, at any depth, become their kind with offset and length.
    """
    length, content = block(header)
    return struct.pack("<I", length) + content


def addressed(content: bytes, number: int, flags: int) -> bytes:
    """Return the frame that answers a request with a body."""
    (length,) = struct.unpack_from("<I", content)
    return _START.pack(MAGIC, number, length, flags) + memoryview(content)[4:]


def header(content: bytes) -> dict[str, Any]:
    """Return the header of a body."""
    (length,) = struct.unpack_from("<I", content)
    return dict(json.loads(content[4 : 4 + length]))
