"""Cases that a page requests: a case with changed values, all that is said about it, and its neighbours."""

import hashlib
import shlex
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from functools import cached_property
from typing import Final, Self

from tribodyn.cases.case import Case
from tribodyn.cases.keys import Key
from tribodyn.cases.tables import keys_in, plain_path, with_components
from tribodyn.core.errors import Faults, InputError
from tribodyn.workbench.controls import FILE, shown_number, text, track, turnable
from tribodyn.workbench.messages import Values

_DIGITS: Final = 16
SAVED: Final = "case.toml"  #: Name of the file as which a page saves a case.
NO_FILES: Final = "a page may not name files of this machine; start the workbench with a case that does"


@dataclass(frozen=True)
class Origin:
    """The case that a workbench was started with."""

    case: Case  #: The case.
    name: str  #: As it was given: a built-in case or a file.
    #: Values that were changed there and then, by dotted path.
    changes: Mapping[str, str] = field(default_factory=dict)
    #: Whether a page has edited it: then its runs are made from the file that the page saves.
    edited: bool = False

    @cached_property
    def texts(self) -> dict[str, str]:
        """Values of all keys as texts, by dotted path."""
        return _texts(self.case)

    @cached_property
    def keys(self) -> dict[str, Key]:
        """Keys of the case and components of its vectors, by dotted path."""
        return with_components(keys_in(self.case))

    def varied(self, values: Mapping[str, str]) -> "Variant":
        """Return the case with other values.

        Raises InputError if a value cannot be, or names a file.
        """
        faults = Faults()
        for path in values:
            key = self.keys.get(plain_path(path, self.keys))
            with faults.noted():
                if key is not None and key.kind == FILE:
                    raise InputError(NO_FILES, key=path)
        faults.raise_any()
        case = self.case.replace(values, source="") if values else self.case
        return Variant(self, case, {path: self._canonical(case, path) for path in values})

    def _canonical(self, case: Case, path: str) -> str:
        plain = plain_path(path, self.keys)
        return text(self.keys[plain], case.at(plain))


@dataclass(frozen=True)
class Variant:
    """A case as the page wants it."""

    origin: Origin  #: What it was made from.
    case: Case  #: The case.
    values: Mapping[str, str]  #: What the page changed, as texts in the units of the keys.

    @cached_property
    def toml(self) -> str:
        """The case as text, which is all that a worker gets of it."""
        return self.case.to_toml()

    @cached_property
    def run(self) -> str:
        """Name of the run: that of every case with this very text."""
        return hashlib.sha256(self.toml.encode("utf-8", "surrogatepass")).hexdigest()[:_DIGITS]

    def filled(self) -> Self:
        """Return itself with all texts that are made of it, which can take as long as reading the case."""
        _ = self.run, self.header
        return self

    @property
    def follows(self) -> dict[str, str]:
        """Values that differ from those of the origin though the page did not change them."""
        before = self.origin.texts
        return {
            path: value
            for path, value in _texts(self.case).items()
            if value != before.get(path, "") and path not in self.values
        }

    @property
    def command(self) -> str:
        """The command that makes this very run."""
        options = [f"--set {shlex.quote(f'{path}={value}')}" for path, value in self._changes.items()]
        return " ".join(["tribodyn run", shlex.quote(self._source), *options])

    @property
    def python(self) -> str:
        """Lines of Python that make this very run."""
        return "\n".join(self._lines())

    @property
    def _source(self) -> str:
        """Name of the case or file that the run is made from."""
        return SAVED if self.origin.edited else self.origin.name

    @property
    def _changes(self) -> dict[str, str]:
        """Values that differ from that case; a saved file holds them."""
        return {} if self.origin.edited else {**self.origin.changes, **self.values}

    def _lines(self) -> Iterator[str]:
        changes = self._changes
        yield "import tribodyn as td"
        yield ""
        yield f"case = td.load_case({self._source!r})"
        if changes:
            yield "case = case.replace({"
            yield from (f"    {path!r}: {value!r}," for path, value in changes.items())
            yield "})"
        yield "result = td.simulate(case)"

    @cached_property
    def header(self) -> dict[str, object]:
        """Part of the header of a frame that describes the case."""
        return {
            "run": self.run,
            "values": dict(self.values),
            "follows": self.follows,
            "command": self.command,
            "python": self.python,
        }


def _texts(case: Case) -> dict[str, str]:
    return {path: text(key, case.at(path)) for path, key in with_components(keys_in(case)).items()}


_SIDES: Final = (1, -1)


def neighbours(origin: Origin, values: Values, before: Values) -> Iterator[dict[str, str]]:
    """Yield the values one step to either side, for the key that was turned last.

    ``origin``: the case of the workbench; ``values``, ``before``: values of the last request and of the one
    before.
    """
    turned = [path for path in {**before, **values} if values.get(path) != before.get(path)]
    keys = turnable(origin.case)
    if len(turned) != 1 or turned[0] not in keys:
        return
    path, key = turned[0], keys[turned[0]]
    at_first = origin.case.at(path)
    if isinstance(at_first, bool) or not isinstance(at_first, int | float):
        return
    found = track(key, at_first)
    try:
        now = shown_number(key, origin.varied(values).case.at(path))
    except InputError:
        return
    if found is None or now is None:
        return
    step = Decimal(repr(found.step))
    for side in _SIDES:
        number = (round(Decimal(repr(now)) / step) + side) * step
        if found.least <= number <= found.greatest:
            yield {**values, path: f"{number.normalize():f} {key.unit}".strip()}
