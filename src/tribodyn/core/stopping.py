"""Whether the caller wants a run to stop, asked by everything that takes long outside the time integration.

The question is set once around a run. Whatever computes for longer than a second asks it in between: what a
result needs raises, what a result can do without is skipped.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import TypeAlias

from tribodyn.core.errors import Stopped

Stop: TypeAlias = Callable[[], bool] | None  #: Returns whether to stop; None where nobody can ask for that.


@dataclass
class _Question:
    """Question to the caller, and whether anything was skipped because of the answer."""

    stop: Stop = None
    skipped: bool = False


_question: ContextVar[_Question | None] = ContextVar("question", default=None)


@contextmanager
def asked(stop: Stop) -> Iterator[None]:
    """Have everything within the block ask ``stop``."""
    before = _question.set(_Question(stop))
    try:
        yield
    finally:
        _question.reset(before)


def ask() -> None:
    """Raise :class:`~tribodyn.core.errors.Stopped` if the caller wants to stop."""
    question = _question.get()
    if question is not None and question.stop is not None and question.stop():
        raise Stopped


def skip() -> bool:
    """Return whether the caller wants to stop, so that work which a result can do without is skipped."""
    try:
        ask()
    except Stopped:
        if (question := _question.get()) is not None:
            question.skipped = True
        return True
    return False


def skipped() -> bool:
    """Return whether any work was skipped."""
    question = _question.get()
    return question is not None and question.skipped
