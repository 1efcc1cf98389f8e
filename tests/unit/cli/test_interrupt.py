"""Signals, and the progress that a command shows meanwhile."""

import io
import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from tribodyn.cli.console import Bar, Console, ProgressLines, progress
from tribodyn.cli.interrupt import Interruption, end, last_words, on_leaving, signals_heard

NUMBERS = pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])

WITH_WORKERS = """
import os, signal
from multiprocessing import util
from tribodyn.cli import interrupt

with interrupt.signals_heard():
    assert os.path.isdir(util.get_temp_dir())
    os.kill(os.getpid(), signal.SIGTERM)
"""


def send(number: int) -> None:
    os.kill(os.getpid(), number)


def status_of(number: int) -> object:
    """Return the exit status with which a signal ends this process."""
    with pytest.raises(SystemExit) as left:
        send(number)
    return left.value.code


@NUMBERS
def test_the_first_signal_asks_and_the_second_leaves(number, leaving, capfd):
    before = signal.getsignal(number)
    with signals_heard(), Interruption("stopping") as stop:
        assert not stop()
        send(number)
        assert stop()
        assert "stopping" in capfd.readouterr().err
        assert status_of(number) == 1
    assert "aborted; nothing was saved" in capfd.readouterr().err
    assert signal.getsignal(number) is before


def test_leaving_tidies_up_and_says_what_is_kept(leaving: None, capfd: pytest.CaptureFixture[str]) -> None:
    done: list[str] = []

    def fail() -> None:
        raise OSError("no permission")

    with signals_heard():
        on_leaving(lambda: done.append("tidy"))
        on_leaving(fail)
        last_words("µ is kept")
        assert status_of(signal.SIGTERM) == 1
    assert done == ["tidy"]
    assert capfd.readouterr().err == "\ntribodyn: µ is kept\n"


def test_python_shutting_down_does_not_turn_success_into_a_kill() -> None:
    # An object that goes only when Python clears its modules, when it has put its own handlers back.
    script = """
import os, signal, sys
from tribodyn.__main__ import main

class Last:
    def __del__(self, kill=os.kill, pid=os.getpid(), number=signal.SIGTERM):
        kill(pid, number)

sys.modules["last"] = Last()
sys.argv[1:] = ["cases", "--quiet"]
sys.exit(main())
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


def test_leaving_removes_the_folder_of_workers(tmp_path: Path) -> None:
    environment = os.environ | {"TMPDIR": str(tmp_path)}
    done = subprocess.run([sys.executable, "-c", WITH_WORKERS], env=environment, capture_output=True)
    assert (done.returncode, list(tmp_path.iterdir())) == (1, [])


def test_lines_come_at_every_tenth(capsys: pytest.CaptureFixture[str]) -> None:
    with progress(12.0, Console()) as shown:
        assert isinstance(shown, ProgressLines)
        for reached in np.linspace(0.0, 12.0, 1000):
            shown(float(reached))
    captured = capsys.readouterr()
    assert captured.out == ""
    lines = captured.err.splitlines()
    assert len(lines) == 10
    assert lines[0].startswith(" 10 %  1.2")
    assert lines[-1].startswith("100 %  12 of 12 s simulated")


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_a_terminal_gets_a_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    with progress(2.0, Console()) as shown:
        assert isinstance(shown, Bar)
        shown._bar.mininterval = 0.0
        shown._bar.delay = 0.0
        shown(0.5)
        shown.note("news")
        shown(1.0)
    assert " 50%|" in terminal.getvalue()
    assert "1.00 of 2.00 s simulated" in terminal.getvalue()
    assert "news" in terminal.getvalue()


IN_A_CALLBACK = """
import os, signal, sys, time, weakref
from tribodyn.cli import interrupt

class Thing: pass

def gone(reference):
    # What a handler raises here is printed and lost.
    os.kill(os.getpid(), signal.SIGTERM)
    time.sleep(0.1)

with interrupt.signals_heard():
    thing = Thing()
    reference = weakref.ref(thing, gone)
    del thing
    print("went on")
"""


@NUMBERS
def test_where_nobody_has_asked_yet_there_is_nothing_to_save(number: signal.Signals, leaving: None) -> None:
    with signals_heard(), Interruption() as stop:
        assert status_of(number) == 1
    assert not stop.requested


def test_after_the_work_a_signal_changes_nothing(leaving: None, capfd: pytest.CaptureFixture[str]) -> None:
    with signals_heard():
        end(0)
        assert status_of(signal.SIGINT) == 0
    assert capfd.readouterr().err == ""


def test_a_signal_in_a_callback_of_the_interpreter_is_not_lost() -> None:
    done = subprocess.run([sys.executable, "-c", IN_A_CALLBACK], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (1, "", "\ntribodyn: aborted; nothing was saved\n")
