"""Commands that README and manual show with their answers print these."""

import re
import shlex
from pathlib import Path

import pytest

from tribodyn.cli.main import main
from tribodyn.mechanisms.catalogue import templates

ROOT = Path(__file__).parents[3]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
SHOWN = re.compile(
    r"^    \$ tribodyn (?P<command>[^\n]*)\n(?P<answer>(?:    (?!\$ )[^\n]*\n)+)", re.MULTILINE
)
EXAMPLES = [
    pytest.param(found["command"], found["answer"], id=f"{page.stem}-{found['command'].split()[0]}")
    for page in PAGES
    if "_build" not in page.parts
    for found in SHOWN.finditer(page.read_text(encoding="utf-8"))
]


NUMBER = re.compile(r"(?<![\w.])[+-]?\d+(?:\.\d+)?(?:e[+-]?\d+)?")


@pytest.mark.parametrize(("command", "answer"), EXAMPLES)
def test_a_command_answers_as_shown(
    command: str,
    answer: str,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Every line that is shown is printed, in this order; files with names of templates are written first."""
    monkeypatch.chdir(tmp_path)
    for name in templates():
        if f" {name}.toml" in command:
            assert main(["new", name]) == 0
    assert main(shlex.split(command)) == 0
    printed = iter(capsys.readouterr().out.splitlines())
    missing = [line for line in answer.splitlines() if not any(alike(line, other) for other in printed)]
    assert missing == []


def alike(line: str, other: str) -> bool:
    """Tell whether two lines have the same words and nearly the same numbers.

    Peaks of impacts move with the rounding of a processor, by 0.05 % here; 2 % leave room.
    """
    (words, numbers), (other_words, other_numbers) = map(_parts, (line, other))
    return words == other_words and numbers == pytest.approx(other_numbers, rel=0.02)


def _parts(line: str) -> tuple[list[str], list[float]]:
    return [part.strip() for part in NUMBER.split(line)], [float(number) for number in NUMBER.findall(line)]
