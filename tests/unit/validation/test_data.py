"""Data, inputs and acceptance bands equal those of the collection, and every number has its line."""

import hashlib
import re
import tomllib
from importlib.resources import files
from pathlib import Path

import pytest

from tribodyn.cli.main import main
from tribodyn.validation import catalogue
from tribodyn.validation.catalogue import NAMES, ValidationSet, index, load

FOLDER = Path(str(files("tribodyn.validation")))
MANIFEST = Path(__file__).with_name("data.sha256")  #: Hashes of the files of the collection, made there.
NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?", re.IGNORECASE)


def _manifest() -> dict[str, str]:
    lines = MANIFEST.read_text(encoding="utf-8").splitlines()
    return {path: digest for digest, path in (line.split(maxsplit=1) for line in lines)}


def _place(path: str) -> Path:
    name, _, file = path.rpartition("/")
    return Path(str(load(name).data / file)) if name else FOLDER / file


def _plain(text: str) -> str:
    return re.sub(r"\s+", " ", text)


def _numbers(text: str) -> set[float]:
    """Return the numbers of a text, each also as a hundredth, for percentages."""
    found = {float(match) for match in NUMBER.findall(text.replace("+-", " "))}
    return found | {abs(value) for value in found} | {round(value / 100.0, 12) for value in found}


@pytest.mark.parametrize("path", [path for path in _manifest()])
def test_every_file_is_that_of_the_collection(path: str) -> None:
    place = _place(path)
    assert hashlib.sha256(place.read_bytes()).hexdigest() == _manifest()[path]


def test_the_list_is_the_index() -> None:
    rows = re.findall(r"^\| ([a-z_0-9]+) \|", index(), re.MULTILINE)
    assert set(NAMES) == {name for name in rows if name != "set"}


@pytest.mark.parametrize("name", NAMES)
def test_bands_are_those_of_the_index(name: str) -> None:
    one = load(name)
    (row,) = [line for line in index().splitlines() if line.startswith(f"| {name} |")]
    acceptance = _plain(row.split(" | ")[-1])
    assert one.bands
    for band in one.bands.values():
        assert _plain(band.source) in acceptance, band.name
        given = [band.relative, band.absolute, band.at_least, band.at_most, band.must_exceed]
        numbers = [value for value in given if value is not None] + list(band.covers or ())
        assert numbers or f"{name}/{band.data}" in _manifest(), band.name
        assert set(numbers) <= _numbers(band.source), band.name


@pytest.mark.parametrize("name", NAMES)
def test_inputs_stand_in_the_quoted_line(name: str) -> None:
    one = load(name)
    tables = [path.read_text(encoding="utf-8") for path in Path(str(one.data)).glob("*.csv")]
    texts = [_plain(text) for text in (one.readme(), index(), *tables)]
    for given in one.inputs.values():
        assert given.source or given.assumed, f"{given.name} has no source"
        if not given.source:
            continue
        assert any(_plain(given.source) in text for text in texts), given.name
        if not given.assumed:
            written = NUMBER.match(given.text)
            assert written is not None
            assert float(written[0]) in _numbers(given.source), given.name


@pytest.mark.parametrize("name", NAMES)
def test_explanations_have_at_most_three_sentences(name: str) -> None:
    for row, text in load(name).table.get("explanations", {}).items():
        assert 1 <= len(re.findall(r"[.!?](?:\s|$)", text)) <= 3, row


def test_a_changed_band_is_noticed() -> None:
    """The comparison above is able to fail."""
    changed = ValidationSet("oblique_impact").bands["sliding"]
    assert 0.02 in _numbers(changed.source)
    assert 0.03 not in _numbers(changed.source)


def test_data_under_another_licence_lie_outside_the_package_with_licence_and_names() -> None:
    outside = [name for name in NAMES if "licence" in load(name).table]
    assert outside == ["friction_damper_backlash", "cycloid_reducer_play"]
    for name in outside:
        one = load(name)
        assert not list((FOLDER / "sets" / name).glob("*.csv"))
        assert not Path(str(one.data)).is_relative_to(FOLDER.parent)
        licence = (Path(str(one.data)).parent / "LICENSE.md").read_text(encoding="utf-8")
        assert f"`{name}`" in licence
        assert "creativecommons.org/licenses/by-sa/4.0" in licence
        assert one.missing == ""
    targets = tomllib.loads((FOLDER.parents[2] / "pyproject.toml").read_text(encoding="utf-8"))["tool"][
        "hatch"
    ]
    assert targets["build"]["targets"]["wheel"]["packages"] == ["src/tribodyn"]
    assert "data" not in targets["build"]["targets"]["sdist"]["include"]


def test_without_these_data_validate_says_so_and_goes_on(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(catalogue, "OUTSIDE", tmp_path / "none")
    assert main(["validate", "rack_pinion_friction", "cycloid_reducer_play"]) == 0
    out = capsys.readouterr().out
    assert "cycloid_reducer_play: its data, under cc-by-sa-4.0, are in the repository" in out
    assert "rack_pinion_friction: Friction force" in out
