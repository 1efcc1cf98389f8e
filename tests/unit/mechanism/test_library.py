"""Every file of the gallery runs to its end and answers its question."""

from pathlib import Path

import pytest

import tribodyn as td
from tribodyn.mechanism.descriptor import GALLERY, TEMPLATES
from tribodyn.mechanisms.results import known, summarise


def test_the_gallery_has_twelve_mechanisms() -> None:
    assert len(GALLERY) == 12


@pytest.mark.parametrize("name", TEMPLATES)
def test_a_template_says_what_it_is(name: str) -> None:
    assert TEMPLATES[name].title
    assert len(TEMPLATES[name].description.split()) > 5


@pytest.mark.parametrize("name", GALLERY)
def test_a_mechanism_of_the_gallery_answers_its_question(name: str, tmp_path: Path) -> None:
    path = tmp_path / f"{name}.toml"
    path.write_text(GALLERY[name].text, encoding="utf-8")
    result = td.simulate(path)
    summary = summarise(result)
    assert result.attrs["failure"] == ""
    assert not summary["doubtful"]
    assert GALLERY[name].question.endswith("?")
    assert 0 < len(GALLERY[name].results) == len(known(GALLERY[name].results, "mechanism"))
    assert set(GALLERY[name].results) <= set(summary)
