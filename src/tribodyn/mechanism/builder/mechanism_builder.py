"""A mechanism put together in Python; what comes of it is the case that a file would have made."""

import inspect
import textwrap
from collections.abc import Callable, Iterator, Mapping
from html import escape
from typing import TYPE_CHECKING, Any, ClassVar, Final

import numpy as np

from tribodyn.cases.case import build
from tribodyn.cases.fields import Entry
from tribodyn.cases.keys import Key, keys_of
from tribodyn.cases.load import flat
from tribodyn.cases.tables import expanded
from tribodyn.cases.units import si_unit
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import meant
from tribodyn.mechanism.builder.arguments import CASE, signature_of_case
from tribodyn.mechanism.builder.methods import METHODS, OF_JOINT, BuilderMethod, Example
from tribodyn.mechanism.mechanism_case import MechanismCase

if TYPE_CHECKING:
    from tribodyn.mechanism.builder.signatures import Signatures
else:

    class Signatures:
        """Stands for the methods that are added below, whose types are in ``signatures.pyi``."""

        def __getattr__(self, name: str) -> Any:
            """Suggest the method that was probably meant by an unknown name."""
            hint = meant(name, [method.name for method in METHODS])
            raise AttributeError(f"a Mechanism has no method {name!r}{hint}", name=name, obj=self)


_WIDTH: Final = 100
_LINES: Final = textwrap.TextWrapper(_WIDTH, break_long_words=False, break_on_hyphens=False)
BY_NAME: Final = {method.name: method for method in METHODS}


def docstring(method: BuilderMethod) -> str:
    """Return the docstring of a method: what it does, its keys, and an example that runs."""
    named = [f"{name}\n    {meaning[0].upper()}{meaning[1:]}." for name, _, meaning in method.arguments]
    keys = [f"{name}\n{_indented(one.text)}" for name, one in method.keywords.items()]
    parts = (
        method.does,
        _section("Parameters", [*named, *keys]),
        _section("Returns", ["Mechanism\n    The mechanism itself, so that calls can be chained."]),
        _section("Raises", ["InputError\n" + _indented(_refusal(method))]),
        _section("Examples", [*written(method.example, method)]),
    )
    return "\n\n".join(parts) + "\n"


def _refusal(method: BuilderMethod) -> str:
    twice = "The joint is not there." if method.table in OF_JOINT else "The name is given twice."
    return f"{twice} Values are checked by ``case()``, whose message names key, value and what is allowed."


def _section(title: str, lines: list[str]) -> str:
    return "\n".join([title, "-" * len(title), *lines])


def _indented(text: str) -> str:
    return textwrap.indent(_LINES.fill(" ".join(text.split())), "    ")


def written(tables: Example, first: BuilderMethod) -> Iterator[str]:
    """Yield the lines of Python, as a prompt shows them, that make a case, by a method wherever it does."""
    named = {method.table for method in METHODS}
    calls = [_call("", _literals({k: v for k, v in tables.items() if k not in (CASE, *named)}))]
    for method, name, keys in _uses(tables, first):
        ends = iter(keys.get("between", keys.get("joints", ())))
        several = ("between", "joints")
        own = [
            next(ends, None) if key in several else keys[key] if key else name
            for _, key, _ in method.arguments
        ]
        filled = {*method.given, *(key for _, key, _ in method.arguments)}
        plain = {key: value for key, value in keys.items() if key not in filled}
        calls.append(
            _call(f".{method.name}", [*(_literal(one) for one in own if one is not None), *_literals(plain)])
        )
    yield ">>> import tribodyn as td"
    yield f">>> drawn = td.Mechanism{calls[0]}"
    yield from (f">>> _ = drawn{call}" for call in calls[1:])
    yield ">>> case = drawn.case()"


def _call(method: str, arguments: list[str]) -> str:
    """Return a call, on lines of its own where it is long."""
    line = f"{method}({', '.join(arguments)})"
    if len(line) <= _WIDTH - 12:
        return line
    return f"{method}(\n" + "\n".join(f"...     {argument}," for argument in arguments) + "\n... )"


def _uses(tables: Example, first: BuilderMethod) -> Iterator[tuple[BuilderMethod, str, dict[str, Any]]]:
    """Yield the methods that fill tables, with names and keys; the first one wherever it does."""
    for table, parts in tables.items():
        able = [method for method in (first, *METHODS) if method.table == table]
        for name, keys in parts.items() if able else ():
            own = {key: value for key, value in keys.items() if key not in OF_JOINT}
            yield next(method for method in able if method.given.items() <= keys.items()), name, own
            for below in (below for below in OF_JOINT if below in keys):
                yield BY_NAME[below], name, dict(keys[below])


def _literals(keys: Mapping[str, Any]) -> list[str]:
    return [f"{key}={_literal(value)}" for key, value in keys.items()]


def _literal(value: object) -> str:
    """Return a value as Python spells it, with double quotes."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f'"{key}": {_literal(one)}' for key, one in value.items()) + "}"
    if isinstance(value, list):
        return f"[{', '.join(map(_literal, value))}]"
    return f'"{value}"' if isinstance(value, str) else repr(value)


SOURCE: Final = "Mechanism"


class _CaseTables:
    """The tables of a case as they begin."""

    __signature__: ClassVar[inspect.Signature]

    def __init__(self, title: str = "Mechanism", **keys: object) -> None:
        self._tables: dict[str, Any] = {CASE: MechanismCase.kind(), "title": title, **keys}


class Mechanism(Signatures, _CaseTables):
    """Bodies, joints and what moves them, in one drawing with global coordinates.

    Values are written as in a case file, with their units; NumPy arrays are numbers in SI units. Keys of
    tables are arguments. Methods return the mechanism, so that calls can be chained; nothing is checked
    before :meth:`case`.

    Parameters
    ----------
    title
        Heading of figures and report.
    **keys
        Keys and tables of the case, such as ``gravity="0, 0, -9.81 m/s^2"`` or ``run={"cycles": 2}``.

    Examples
    --------
    >>> pendulum = Mechanism("Pendulum", gravity="0, -9.81, 0 m/s^2", run={"duration": "2 s"})
    >>> rod = {"mass": "1 kg", "inertia": "0.01, 0.01, 0.01 kg m^2"}
    >>> case = pendulum.body("rod", centre="0.5, 0, 0 m", **rod).revolute(
    ...     "pivot", "ground", "rod", point="0, 0, 0 m", axis=[0, 0, 1]
    ... ).case()
    >>> case.joints["pivot"].type
    'revolute'
    """

    def case(self) -> MechanismCase:
        """Return the case.

        Returns
        -------
        MechanismCase
            Checked; its values are in SI units.

        Raises
        ------
        InputError
            Something in it is wrong; the message names the key as a case file spells it.
        """
        values = dict(flat(self._tables))
        keys = expanded(keys_of(MechanismCase), values)
        entries = {path: Entry(_plain(value, keys.get(path)), SOURCE) for path, value in values.items()}
        return build(MechanismCase, entries, SOURCE)

    def _repr_html_(self) -> str:
        """Return the case as a notebook shows it, or what is still wrong and which parts there are."""
        try:
            return self.case()._repr_html_()
        except InputError as error:
            parts = [
                (table, ", ".join(names)) for table, names in self._tables.items() if isinstance(names, dict)
            ]
            rows = "".join(
                f"<tr><td>{escape(table)}</td><td>{escape(names)}</td></tr>" for table, names in parts
            )
            title = f"<strong>{escape(str(self._tables['title']))}</strong>"
            return f"{title}<table>{rows}</table><p>{escape(str(error))}</p>"

    def _fill(self, method: BuilderMethod, name: str, keys: Mapping[str, object]) -> None:
        """Add a table of some name."""
        inside = self._tables.setdefault(method.table, {})
        if name in inside:
            raise InputError("this name is given twice", key=f"{method.table}.{name}", source=SOURCE)
        inside[name] = dict(keys)

    def _fill_joint(self, method: BuilderMethod, joint: str, keys: Mapping[str, object]) -> None:
        """Add a table to a joint."""
        if joint not in self._tables.get("joints", {}):
            words = f"write the joint first, then its {method.table}"
            raise InputError(words, key=f"joints.{joint}", source=SOURCE)
        self._tables["joints"][joint][method.table] = dict(keys)


def _adding(method: BuilderMethod) -> Callable[..., Mechanism]:
    """Return a method of the builder."""

    def add(mechanism: Mechanism, /, *arguments: Any, **keys: object) -> Mechanism:
        name, values = method.values(*arguments, **keys)
        fill = mechanism._fill_joint if method.table in OF_JOINT else mechanism._fill
        fill(method, name, values)
        return mechanism

    add.__name__, add.__qualname__ = method.name, f"{Mechanism.__name__}.{method.name}"
    add.__doc__ = docstring(method)
    vars(add)["__signature__"] = method.signature
    return add


def _plain(value: Any, key: Key | None) -> Any:
    """Return a value as TOML would give it; an array of numbers of a unit is in SI units."""
    if isinstance(value, np.ndarray):
        numbers = value.ravel().tolist()
        unit = si_unit(key.unit) if key is not None and key.unit else ""
        return [f"{number!r} {unit}" for number in numbers] if unit else numbers
    return list(value) if isinstance(value, tuple) else value


for _method in METHODS:
    setattr(Mechanism, _method.name, _adding(_method))
Mechanism.__signature__ = signature_of_case()
