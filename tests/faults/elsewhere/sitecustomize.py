"""Python as on Windows or macOS, to this project, in every process with this folder on its path.

The variable ``ELSEWHERE`` says which: ``win32`` or ``darwin``. What Windows lacks is not there, folders
cannot be opened, and nothing takes the name of an open file or removes one.
"""

import builtins
import fcntl
import os
import signal
import sys
import types
import warnings
from typing import Any

SYSTEM = os.environ["ELSEWHERE"]
OURS = ("tribodyn", "mebdf")
ABSENT = ("fcntl", "grp", "pwd", "resource", "termios") if SYSTEM == "win32" else ()


class Elsewhere(types.ModuleType):
    """A module as it is elsewhere: without some names, or with other values of them."""

    def __init__(self, module: types.ModuleType, absent: tuple[str, ...] = (), **other: Any) -> None:
        self.__dict__.update(module=module, absent=absent, **other)

    def __getattr__(self, name: str) -> Any:
        if name in self.absent:
            raise AttributeError(f"module {self.module.__name__!r} has no attribute {name!r}")
        return getattr(self.module, name)

    def __setattr__(self, name: str, value: Any) -> None:
        setattr(self.module, name, value)


def locking(handle: int, mode: int, size: int) -> None:
    """Lock the beginning of an open file, as the module of Windows does."""
    fcntl.lockf(handle, fcntl.LOCK_EX | fcntl.LOCK_NB, size)


msvcrt = types.ModuleType("msvcrt")
msvcrt.LK_NBLCK, msvcrt.locking = 2, locking
INSTEAD = {"sys": Elsewhere(sys, platform=SYSTEM), "os": Elsewhere(os, ("fork", "sched_getaffinity"))}
if SYSTEM == "win32":
    INSTEAD |= {
        "msvcrt": msvcrt,
        "os": Elsewhere(os, ("fork", "geteuid", "getuid", "sched_getaffinity", "O_DIRECTORY")),
        "signal": Elsewhere(signal, ("pthread_sigmask", "SIGHUP", "SIGKILL")),
    }
import_, open_, replace_, unlink_ = builtins.__import__, os.open, os.replace, os.unlink


def imported(name: str, *arguments: Any, **named: Any) -> Any:
    """Import a module; ours are given what another system has."""
    importer = (arguments[0] or {}).get("__name__", "") if arguments else ""
    # Machine code is that of the system which this is.
    if importer.split(".")[0] in OURS and not importer.startswith("mebdf.compiled"):
        if name in ABSENT:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
        if name in INSTEAD:
            return INSTEAD[name]
    return import_(name, *arguments, **named)


def opened(path: Any, flags: int, mode: int = 0o777, *, dir_fd: int | None = None) -> int:
    """Open a file; folders are refused to ours."""
    caller = sys._getframe(1).f_globals.get("__name__", "")
    if caller.split(".")[0] in OURS and os.path.isdir(path):
        raise PermissionError(13, "Permission denied", os.fspath(path))
    return open_(path, flags, mode, dir_fd=dir_fd)


def refuse_open(path: Any) -> None:
    """Refuse the name of a file that this process has open."""
    named = os.path.realpath(path)
    for handle in os.listdir("/proc/self/fd"):
        try:
            held = os.readlink(f"/proc/self/fd/{handle}")
        except OSError:
            continue
        if held == named:
            raise PermissionError(13, "The process cannot access the file: it is open", os.fspath(path))


def replaced(old: Any, new: Any, **named: Any) -> None:
    """Rename a file onto another one, neither of which is open."""
    refuse_open(old)
    refuse_open(new)
    replace_(old, new, **named)


def unlinked(path: Any, **named: Any) -> None:
    """Remove a file that is not open."""
    if not named:
        refuse_open(path)
    unlink_(path, **named)


builtins.__import__ = imported
warnings.filterwarnings("ignore", category=EncodingWarning)
warnings.filterwarnings("error", category=EncodingWarning, module=r"(tribodyn|mebdf)\.")
if SYSTEM == "win32":
    os.open, os.replace, os.unlink = opened, replaced, unlinked
