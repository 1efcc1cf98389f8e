from __future__ import annotations

import json

import numba
import pytest

import tribodyn as td
from mebdf.compiled import cache
from tribodyn import simulation
from tribodyn.cli.main import main
from tribodyn.cli.progress import announced_compilation
from tribodyn.mechanisms.catalogue import built_in
from tribodyn.simulation import compilation


def test_compilation_is_announced_once_and_only_when_it_happens() -> None:
    @numba.njit
    def double(x: float) -> float:
        return 2.0 * x

    @numba.njit
    def triple(x: float) -> float:
        return 3.0 * x

    lines: list[str] = []
    with announced_compilation(lines.append):
        double(1.0)
        triple(1.0)
    assert len(lines) == 1
    assert "compiling" in lines[0]
    with announced_compilation(lines.append):
        double(1.0)
    assert len(lines) == 1


def test_compile_does_what_the_first_run_of_each_case_does(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    asked: list[str] = []
    monkeypatch.setattr(compilation, "compile_elsewhere", lambda case: asked.append(case.title))
    monkeypatch.setattr(simulation, "loaded", lambda case, _: case.title in asked)
    assert main(["compile", "vsv", "journal-dry", "--json"]) == 0
    assert asked == [td.load_case(name).title for name in ("vsv", "journal-dry")]
    assert json.loads(capsys.readouterr().out)["seconds"].keys() == {"vsv", "journal-dry"}
    # Nothing is compiled twice.
    assert main(["compile", "vsv"]) == 0
    assert len(asked) == 2
    assert "vsv: was compiled" in capsys.readouterr().out


def test_compile_without_a_name_is_for_every_kind_of_case(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(simulation, "loaded", lambda case, steps: True)
    assert main(["compile"]) == 0
    told = capsys.readouterr().out
    assert all(f"{name}: was compiled" in told for name in built_in())


def test_equations_that_were_compiled_ahead_are_what_a_run_loads(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compile", "vsv"]) == 0
    capsys.readouterr()
    with compilation.loading_only():
        td.simulate(td.load_case("vsv").replace({"run.duration": "20 ms"}))


def test_compile_refuses_where_nothing_can_be_kept(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(cache, "folder", lambda _: None)
    assert main(["compile", "vsv"]) == 1
    assert "cannot be kept" in capsys.readouterr().err
