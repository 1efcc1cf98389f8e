"""Folders that may not be written to, by any command that would: refused in a sentence, left as they are."""

from dataclasses import replace
from pathlib import Path

import pytest

from tribodyn.cli.main import main
from tribodyn.cli.options import OutputDirectory
from tribodyn.papers.cheng_2022.figures import FIGURES
from tribodyn.surfaces import SelfAffine, generate, write_text

#: All that write into a folder of their own; ``report`` writes where there are results.
COMMANDS = [
    ("run", "vsv"),
    ("run", "vsv", "--set", "wear.cycles=400"),
    ("sweep", "vsv", "--vary", "joint.clearance=20,30 um"),
    ("reproduce", "fig10"),
    ("surface", "scan.csv", "--short-cutoff", "6 um"),
]


@pytest.fixture(autouse=True)
def scan(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Go where a file of a generated surface is."""
    monkeypatch.chdir(tmp_path)
    write_text(generate(SelfAffine(1e-6, 0.8, 24e-6, 8e-6), (96, 128), 1e-6, 1), tmp_path / "scan.csv")


def refused(command: tuple[str, ...], folder: str, capsys: pytest.CaptureFixture[str]) -> str:
    """Return the one line that is said."""
    assert main([*command, "--quiet", "-o", folder]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("tribodyn: --output: ")
    assert err.count("\n") == 1
    return err


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_of_two_into_one_folder_one_is_refused(command, tmp_path, capsys):
    folder = tmp_path / "out"
    with OutputDirectory(str(folder)).reserved():
        assert "another tribodyn is writing results there" in refused(command, "out", capsys)
        # The folder was made for the first: it stays.
        assert list(folder.iterdir()) == []


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_a_read_only_folder_is_refused(command, mounted, capsys):
    folder = mounted("ro")
    for path in (folder, folder / "new"):
        assert "read-only" in refused(command, str(path), capsys)


def test_a_command_that_fails_leaves_no_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setitem(FIGURES, "fig10", replace(FIGURES["fig10"], data=fails))
    assert main(["reproduce", "fig10", "--quiet", "-o", "new/out"]) == 1
    assert not (tmp_path / "new").exists()
