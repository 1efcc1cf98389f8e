"""Errors that users see."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import Final

from tribodyn.core.quoting import brief

MOST_FAULTS: Final = 20  #: Number of errors that a user reads at once.


class TribodynError(Exception):
    """Base class of the errors that are shown to a user as one message."""


class InputError(TribodynError):
    """Something the user wrote is wrong; the message says what to change.

    Parameters
    ----------
    message
        What is wrong, what was given and what is allowed.
    key
        Dotted path of the offending entry (``joint.clearance``), if there is one.
    source
        File or option that held the entry, if known. Of both the text shows no more than
        :func:`~tribodyn.core.quoting.brief` does.
    """

    def __init__(self, message: str, *, key: str | None = None, source: str | None = None) -> None:
        self.key = key
        self.source = source
        self.reason = message
        where = ": ".join(brief(part) for part in (source, key) if part)
        super().__init__(f"{where}: {message}" if where else message)

    @property
    def faults(self) -> tuple[InputError, ...]:
        """Everything that is wrong, one error each."""
        return (self,)


@contextmanager
def below(path: str) -> Iterator[None]:
    """Put the keys of errors that the block raises below the path of a table."""
    try:
        yield
    except InputError as error:
        raise InputError(error.reason, key=".".join(filter(None, (path, error.key)))) from None


#: Number of errors with a suggestion, each of which takes as long as reading a whole case.
MOST_HINTS: Final = 5


class InputErrors(InputError):
    """Several things that the user wrote are wrong; the text has a line for each.

    Parameters
    ----------
    faults
        Two errors or more, of which each has one reason.
    """

    def __init__(self, faults: Sequence[InputError]) -> None:
        super().__init__(faults[0].reason, key=faults[0].key, source=faults[0].source)
        self._faults = tuple(faults)
        self.args = ("\n".join(map(str, faults)),)

    @property
    def faults(self) -> tuple[InputError, ...]:
        """Everything that is wrong, one error each."""
        return self._faults

    def __reduce__(self) -> tuple[type[InputErrors], tuple[tuple[InputError, ...]]]:
        return type(self), (self._faults,)


def together(faults: Sequence[InputError]) -> InputError:
    """Return one error for all that is wrong, which is at least one thing; of many the first are named."""
    return faults[0] if len(faults) == 1 else InputErrors(faults[:MOST_FAULTS])


class Faults:
    """Collector of errors in several entries, so that a user reads all of them at once, and once only.

    Attributes
    ----------
    found
        What was gathered so far.
    """

    def __init__(self, found: Iterable[InputError] = ()) -> None:
        self.found = list(found)

    @contextmanager
    def noted(self) -> Iterator[None]:
        """Note an :class:`InputError` of the block instead of raising it; when there are many, raise all."""
        try:
            yield
        except InputError as error:
            known = {str(fault) for fault in self.found}
            self.found += [fault for fault in error.faults if str(fault) not in known]
            if len(self.found) >= MOST_FAULTS:
                self.raise_any()

    def raise_any(self) -> None:
        """Raise the collected errors, if there are any."""
        if self.found:
            raise together(self.found)


class IntegrationFailure(TribodynError):
    """The time integration stopped before its end.

    Parameters
    ----------
    time
        Simulated time reached [s].
    reason
        Why the integrator stopped, in plain words.
    """

    def __init__(self, time: float, reason: str) -> None:
        self.time = time
        self.reason = reason
        super().__init__(f"stopped at t = {time:.6g} s: {reason}")


class Stopped(TribodynError):
    """The caller asked to stop before there was anything to return."""

    def __init__(self) -> None:
        super().__init__("stopped before anything was computed; nothing was saved")
