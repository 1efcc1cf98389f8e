"""Equations are compiled by a process of their own, so that every run uses the same machine code.

A process that has just compiled a function holds the functions that it calls, too, each compiled on its own,
and uses those. One that finds the function in numba's cache on disk uses the copies inside it. Both are right
but add up in other orders: the first run of all would differ in the last bits from every later one.
"""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from tribodyn.cases.case import Case

Simulator = Callable[..., Any]

_CHILD: Final = "from tribodyn.simulation import compile_case; import sys; compile_case(sys.stdin.read())"
_loaded: Final[set[frozenset[tuple[str, object]]]] = set()
"""Choices of the cases whose equations this process has loaded."""


class NotCompiled(Exception):
    """Something is not in numba's cache."""


@contextmanager
def loading_only() -> Iterator[None]:
    """Raise :class:`NotCompiled` where numba would compile."""
    from numba.core import event

    class NothingElse(event.Listener):
        def on_start(self, event: Any) -> None:
            raise NotCompiled

        def on_end(self, event: Any) -> None:
            """Never comes."""

    with event.install_listener("numba:compile", NothingElse()):
        yield


def loaded(case: Case, simulator: Simulator) -> bool:
    """Load the equations of a case; False if they are not compiled yet."""
    choices = frozenset(_choices(case.model_dump(exclude={"title"})))
    if choices not in _loaded:
        try:
            with loading_only():
                simulator(case, stop=lambda: True)
        except NotCompiled:
            return False
        except Exception:  # the run itself will say
            return True
        _loaded.add(choices)
    return True


def _choices(settings: Mapping[str, Any], path: str = "") -> Iterator[tuple[str, object]]:
    """Yield all settings but numbers: those that equations may depend on."""
    for name, value in settings.items():
        if isinstance(value, Mapping):
            yield from _choices(value, f"{path}{name}.")
        elif value is None or isinstance(value, str | bool):
            yield f"{path}{name}", value


def compile_elsewhere(case: Case) -> None:
    """Have another process compile the equations of a case; where that fails, this one will do it.

    So it will where compiled code can be kept nowhere.

    Raises
    ------
    KeyboardInterrupt
        If the other process was interrupted, as by Ctrl-C, which reaches both.
    """
    from tribodyn.kernels.cache import folder

    if folder() is None:
        return
    with suppress(OSError):
        done = subprocess.run(
            [sys.executable, "-c", _CHILD], input=case.to_toml().encode(), capture_output=True, check=False
        )
        if done.returncode == -signal.SIGINT:
            raise KeyboardInterrupt
