import json
from pathlib import Path

import pytest

import tribodyn as td
from tribodyn.cli.main import main
from tribodyn.mechanisms.catalogue import built_in, template, templates


def test_templates_are_listed_one_a_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new"]) == 0
    lines = capsys.readouterr().out.split("\n\n")[0].splitlines()
    assert [line.split()[0] for line in lines] == list(templates())
    assert main(["new", "--json"]) == 0
    assert set(json.loads(capsys.readouterr().out)) >= {*built_in(), "door-hinge", "vane-ring"}


def test_a_template_becomes_a_file_that_is_never_overwritten(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["new", "slider-crank", "mine.toml"]) == 0
    assert "tribodyn run mine.toml" in capsys.readouterr().out
    assert td.load_case("mine.toml") == td.load_case("slider-crank")
    Path("mine.toml").write_text("# my own\n", encoding="utf-8")
    assert main(["new", "slider-crank", "mine.toml"]) == 2
    assert "exists" in capsys.readouterr().err
    assert Path("mine.toml").read_text(encoding="utf-8") == "# my own\n"
    assert main(["new", "latch"]) == 0
    assert Path("latch.toml").read_text(encoding="utf-8") == template("latch")


def test_an_unknown_template_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "slidercrank"]) == 2
    assert 'did you mean "slider-crank"?' in capsys.readouterr().err


@pytest.mark.parametrize("name", [name for name in templates() if name in built_in()])
def test_cases_without_a_file_of_their_own_are_templates_too(name: str, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(template(name), encoding="utf-8")
    assert td.load_case(path) == td.load_case(name)


def test_show_lists_all_keys_of_a_kind(capsys: pytest.CaptureFixture[str]) -> None:
    from tribodyn.cases.keys import keys_of
    from tribodyn.mechanisms.catalogue import kinds

    kind = "mechanism"
    assert main(["show", kind]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert f'case = "{kind}"' in lines
    for key in keys_of(kinds()[kind]).values():
        assert any(line.startswith((f"# {key.name} =", f"{key.name} =")) for line in lines), key.path
    assert main(["show", kind, "--json"]) == 0
    assert list(json.loads(capsys.readouterr().out)) == list(keys_of(kinds()[kind]))
