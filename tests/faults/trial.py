"""The command under watch: each one in a process of its own, with its memory and time measured.

A program that is started for each of thousands of files would mostly import. Run as a script this module
imports once what a command needs, reads command lines as JSON, one a line, forks for each, and answers with
what came of it.
"""

import contextlib
import importlib
import io
import json
import os
import re
import resource
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from tribodyn.cli.main import main

#: What one command may take of memory, all that is imported included, and of a processor's time.
MEGABYTES, SECONDS = 500, 10
PATIENCE = 600  #: Seconds by the clock after which a command counts as one that hangs.
_SPARE = 2  #: So many times as much the system gives at all.


@dataclass(frozen=True)
class Outcome:
    """What came of one command."""

    status: int
    said: str
    seconds: float
    megabytes: float


PICTURES = ("figures", "report", "results.store")
#: What a command imports.
NEEDED = {
    "surface": ("cases", "figures", "surfaces"),
    "report": PICTURES,
    "compare": PICTURES,
    **dict.fromkeys(("check", "show", "run"), (*PICTURES, "simulation")),
}


class Watched:
    """Processes that run commands, one for all that import the same."""

    def __init__(self) -> None:
        self._processes: dict[tuple[str, ...], subprocess.Popen[str]] = {}

    def run(self, arguments: Sequence[str]) -> Outcome:
        """Run a command; a process that did not survive it answers nothing, which is an error."""
        process = self._process(arguments[0])
        assert process.stdin is not None
        assert process.stdout is not None
        print(json.dumps(list(arguments)), file=process.stdin, flush=True)
        answer = process.stdout.readline()
        assert answer, f"the process did not survive {arguments}"
        return Outcome(**json.loads(answer))

    def _process(self, word: str) -> subprocess.Popen[str]:
        needed = NEEDED[word]
        if needed not in self._processes:
            command = [sys.executable, __file__, word]
            self._processes[needed] = subprocess.Popen(
                command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
            )
        return self._processes[needed]

    def close(self) -> None:
        """End the processes."""
        for process in self._processes.values():
            process.communicate()


def tolerable(outcome: Outcome) -> bool:
    """Tell whether a command kept the limits and ended well, or in one line that blames its input."""
    small = outcome.megabytes <= MEGABYTES and outcome.seconds <= SECONDS
    one_line = outcome.said.count("\n") == 1 and outcome.said[:-1].isprintable()
    return small and (outcome.status == 0 or (outcome.status == 2 and one_line and len(outcome.said) < 1500))


def _attempt(arguments: Sequence[str], rest: int) -> Outcome:
    Path("/proc/self/clear_refs").write_text("5", encoding="ascii")
    shared = rest - _from_status("VmRSS")
    out, err = io.StringIO(), io.StringIO()
    began = time.process_time()
    signal.alarm(PATIENCE)
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            status = main(arguments)
        except SystemExit as end:
            status = int(end.code or 0)
    signal.alarm(0)
    seconds = time.process_time() - began
    return Outcome(status, err.getvalue(), seconds, (_from_status("VmHWM") + shared) / 1024**2)


def _answer(arguments: Sequence[str]) -> str:
    """Return what came of a command in a process that ends with it, so that none bears what another left."""
    rest = _from_status("VmRSS")
    ours, theirs = os.pipe()
    if (child := os.fork()) == 0:
        with contextlib.suppress(BaseException):
            os.write(theirs, json.dumps(asdict(_attempt(arguments, rest))).encode())
        os._exit(0)
    os.close(theirs)
    with os.fdopen(ours, encoding="ascii") as answer:
        text = answer.read()
    ended = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    return text or json.dumps(asdict(Outcome(ended, "ended without an answer", 0.0, 0.0)))


def _from_status(name: str) -> int:
    """Return what the system says of this process [bytes]."""
    found = re.search(rf"{name}:\s+(\d+) kB", Path("/proc/self/status").read_text(encoding="ascii"))
    assert found is not None
    return int(found[1]) * 1024


def _serve(word: str) -> None:
    _load(word)
    limit = _from_status("VmData") + _SPARE * MEGABYTES * 1024**2
    resource.setrlimit(resource.RLIMIT_DATA, (limit, limit))
    for line in sys.stdin:
        print(_answer(json.loads(line)), flush=True)


def _load(word: str) -> None:
    """Load what a command would each time; its files are not to be blamed for it."""
    for name in NEEDED[word]:
        importlib.import_module(f"tribodyn.{name}")
    if word == "surface":
        with contextlib.suppress(ImportError):
            importlib.import_module("SurfaceTopography.IO")
    if "simulation" in NEEDED[word]:
        with contextlib.redirect_stdout(io.StringIO()):
            main(["check", "vsv", "--deep", "--quiet"])


if __name__ == "__main__":
    _serve(sys.argv[1])
