import io
import sys

import numpy as np
import pytest

from tribodyn.cli.console import Bar, Console, ProgressLines, progress


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
