"""Files from strangers: they are data, nothing in them runs, and nothing they say leaves the folder named."""

import ast
import json
import pickle
import re
import tomllib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import mebdf
import tribodyn
from tribodyn import report
from tribodyn.cli.main import main
from tribodyn.cli.options import OutputDirectory
from tribodyn.core.errors import InputError
from tribodyn.figures.style import sheet
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.mechanisms.results import write_run
from tribodyn.report.parallel import points_of
from tribodyn.simulation import simulate

SOURCES = [Path(package.__file__).parent for package in (mebdf, tribodyn)]
ROOT = Path(__file__).parents[3]
FORBIDDEN_CALLS = {"eval", "exec", "compile", "__import__"}
#: Files that unpickle what comes through a pipe between a process and the workers that it started.
OWN_PIPES = {"tribodyn/studies/local.py"}
FORBIDDEN_MODULES = {"pickle", "cPickle", "cloudpickle", "dill", "joblib", "marshal", "shelve", "yaml"}
#: They choose an engine by themselves, and what is installed adds engines; ours is named.
XARRAY_READERS = {"open_dataset", "load_dataset", "open_dataarray", "load_dataarray", "open_mfdataset"}
SCRIPT = '<img src=x onerror="alert(1)"><script>alert(1)</script> $\\frac{ {{ 7*7 }}'


@pytest.fixture(scope="module")
def brief() -> xr.Dataset:
    """Return a real result, as short as it gets, of a case with a hostile title."""
    case = load_case("vsv").replace({"run.duration": "2 ms", "run.output_interval": "1 ms", "title": SCRIPT})
    return simulate(case)


def test_the_source_executes_no_data() -> None:
    trees = {
        path.relative_to(source.parent).as_posix(): ast.parse(path.read_text(encoding="utf-8"))
        for source in SOURCES
        for path in source.rglob("*.py")
    }
    assert len(trees) > 100
    assert not [
        (path, node.lineno)
        for path, tree in trees.items()
        for node in ast.walk(tree)
        if _unsafe(node) and path not in OWN_PIPES
    ]


def _unsafe(node: ast.AST) -> bool:
    """Tell whether a node executes text, unpickles, or allows one of both."""
    match node:
        case ast.Call(func=ast.Attribute(attr=name), keywords=keywords) if name in XARRAY_READERS:
            return not _says(keywords, "engine", "netcdf4")
        case ast.Call(func=ast.Attribute(value=ast.Name(id="np" | "numpy"), attr="load"), keywords=keywords):
            return not _says(keywords, "allow_pickle", False)
        case ast.Attribute(attr="read_pickle" | "open_zarr" | "open_datatree"):
            return True
        case ast.Call(func=ast.Name(id=name)):
            return name in FORBIDDEN_CALLS
        case ast.Import(names=names):
            return any(alias.name.partition(".")[0] in FORBIDDEN_MODULES for alias in names)
        case ast.ImportFrom(module=str(module)):
            return module.partition(".")[0] in FORBIDDEN_MODULES
        case ast.keyword(arg="allow_pickle" | "shell", value=value):
            return not (isinstance(value, ast.Constant) and value.value is False)
    return False


def _says(keywords: list[ast.keyword], name: str, value: object) -> bool:
    """Tell whether a call gives a keyword this constant."""
    given = {keyword.arg: keyword.value for keyword in keywords}.get(name)
    return isinstance(given, ast.Constant) and given.value == value


@pytest.mark.parametrize(
    "text",
    [
        *("eval(x)", "import pickle", "from yaml import load", "f(allow_pickle=a)", "import joblib"),
        *("np.load(x)", "np.load(x, allow_pickle=True)", "pd.read_pickle(x)"),
        *("xr.open_dataset(x)", "xr.load_dataset(x, engine='pynio')", "xr.open_zarr(x)"),
    ],
)
def test_what_would_execute_data_is_seen(text: str) -> None:
    assert any(_unsafe(node) for node in ast.walk(ast.parse(text)))


def test_a_hostile_title_is_a_text_in_report_and_figures(brief: xr.Dataset, tmp_path: Path) -> None:
    page = report.write(brief, tmp_path).read_text(encoding="utf-8")
    assert brief.attrs["title"] == SCRIPT
    assert "<script>alert(1)" not in page
    assert "<img src=x" not in page
    assert "&lt;script&gt;alert(1)" in page
    assert "{{ 7*7 }}" in page
    figure = sheet(brief, "Title", 3.0)
    figure.canvas.draw()
    assert any(SCRIPT[:20] in text.get_text() for text in figure.texts)


class Trap:
    """Makes a file when it is unpickled."""

    def __init__(self, mark: Path) -> None:
        self.mark = mark

    def __reduce__(self) -> tuple[Callable[..., object], tuple[object, ...]]:
        return Path.touch, (self.mark,)


@pytest.fixture
def mark(tmp_path: Path) -> Path:
    """Return the path of a file that must not appear, after making sure that the trap works."""
    path = tmp_path / "sprung"
    pickle.loads(pickle.dumps(Trap(path)))
    path.unlink()
    return path


@pytest.mark.parametrize("name", ["scan.npy", "scan.nc", "scan.csv", "scan.mat", "scan.h5", "scan"])
def test_a_pickled_scan_is_refused(name, mark, tmp_path, capsys):
    file = tmp_path / name
    if name.endswith(".npy"):
        np.save(file, np.array([Trap(mark)], dtype=object), allow_pickle=True)
    else:
        file.write_bytes(pickle.dumps(Trap(mark)))
    (tmp_path / "case.toml").write_text(f'case = "vsv"\n[asperities]\nsurface = "{name}"\n', encoding="utf-8")
    for arguments in (["surface", str(file)], ["check", str(tmp_path / "case.toml")]):
        assert main(arguments) == 2
        assert name in capsys.readouterr().err
    assert not mark.exists()


def test_a_pickled_result_is_refused(mark: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "result"
    folder.mkdir()
    (folder / "result.nc").write_bytes(pickle.dumps(Trap(mark)))
    assert main(["report", str(folder)]) == 2
    assert "result.nc" in capsys.readouterr().err
    assert not mark.exists()
    assert sorted(path.name for path in folder.iterdir()) == ["result.nc"]


@pytest.mark.parametrize(
    "name", ["../case.toml", "/dev/zero", "..", "~/.ssh/id_rsa", "a\x00b", "file:///etc/passwd"]
)
def test_a_file_key_reads_regular_files_of_numbers_and_writes_nothing(name, tmp_path, capsys):
    inner = tmp_path / "inner"
    inner.mkdir()
    text = f'case = "vsv"\n[asperities]\nsurface = {json.dumps(name)}\n'
    for folder in (tmp_path, inner):
        (folder / "case.toml").write_text(text, encoding="utf-8")
    before = sorted(tmp_path.rglob("*"))
    assert main(["check", str(inner / "case.toml")]) == 2
    assert "asperities.surface" in capsys.readouterr().err
    assert sorted(tmp_path.rglob("*")) == before


def test_results_take_fixed_names_in_the_folder_named(brief: xr.Dataset, tmp_path: Path) -> None:
    folder = tmp_path / "a" / ".." / "b"
    write_run(brief.assign_attrs(title="../../title", case="../../case"), folder)
    assert sorted(path.name for path in (tmp_path / "b").iterdir()) == [
        "case.toml",
        "result.nc",
        "summary.json",
    ]
    assert {path.name for path in tmp_path.iterdir()} <= {"a", "b"}


def test_a_file_that_is_a_link_is_replaced_not_written_through(brief: xr.Dataset, tmp_path: Path) -> None:
    victim, folder = tmp_path / "victim", tmp_path / "out"
    victim.write_text("precious", encoding="utf-8")
    folder.mkdir()
    for name in ("result.nc", "summary.json", "case.toml"):
        (folder / name).symlink_to(victim)
    write_run(brief, folder)
    assert victim.read_text(encoding="utf-8") == "precious"
    assert not (folder / "result.nc").is_symlink()


@pytest.mark.parametrize("name", ["figures", "points"])
def test_a_folder_that_is_a_link_out_of_the_results_is_refused(name: str, tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    folder = tmp_path / "out"
    folder.mkdir()
    (folder / name).symlink_to(tmp_path / "elsewhere")
    with pytest.raises(InputError, match="leads out of it"):
        OutputDirectory(str(folder))


def test_a_sweep_links_only_its_own_points(tmp_path: Path) -> None:
    inner = tmp_path / "sweep"
    for folder in (tmp_path, inner / "points" / "good"):
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "report.html").touch()
    names = ["good", "../..", "javascript:alert(1)", str(tmp_path)]
    dataset = xr.Dataset({"points": ("point", names), "failure": ("point", [""] * len(names))})
    assert [point.link for point in points_of(dataset, inner)] == ["points/good/report.html", "", "", ""]


def test_dependencies_are_pinned_with_hashes() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    needed, extras = project["dependencies"], project["optional-dependencies"].values()
    every, of_container = _pinned("requirements.lock"), _pinned("tools/container.lock")
    ours = {"mebdf", "tribodyn"}
    assert _names(needed, *extras) - ours <= {name for name, _ in every}
    assert _names(needed) - ours <= {name for name, _ in of_container}
    assert of_container <= every


def _names(*lists: list[str]) -> set[str]:
    return {re.split(r"[^A-Za-z0-9-]", line)[0].lower() for lines in lists for line in lines}


def _pinned(path: str) -> set[tuple[str, str]]:
    """Return names and versions in a lock file, each of which must have a hash."""
    lock = (ROOT / path).read_text(encoding="utf-8")
    pinned = re.findall(r"^([a-z0-9-]+)==(\S+).*\\\n    --hash=sha256:", lock, flags=re.MULTILINE)
    assert len(pinned) == len(re.findall(r"^[a-z0-9]", lock, flags=re.MULTILINE))
    return set(pinned)
