"""Architecture of the source: layers, size of files and style; `make lint` and `make check` see to types.

Each check is one test and runs the tool a developer runs, so that ``make test`` and ``make lint`` agree.
Leave them out with ``pytest -m "not architecture"``.
"""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

import grimp
import pytest

pytestmark = pytest.mark.architecture

ROOT = Path(__file__).parents[2]
SOURCES = sorted([*(ROOT / "src").rglob("*.py"), *ROOT.glob("packages/*/src/**/*.py")])
LONG_FILE = 400
TOOLS = {
    "layers": ("lint-imports",),
    "lint": ("ruff", "check", "--no-cache", "."),
    "format": ("ruff", "format", "--check", "."),
}


@pytest.mark.parametrize("command", TOOLS.values(), ids=TOOLS.keys())
def test_tool_finds_nothing(command: tuple[str, ...]) -> None:
    tool, *arguments = command
    found = subprocess.run(
        [Path(sys.executable).with_name(tool), *arguments], cwd=ROOT, capture_output=True, text=True
    )
    assert found.returncode == 0, found.stdout + found.stderr


def test_no_module_imports_a_package_that_imports_it() -> None:
    """The contract on circles compares siblings only: neither is the package that a module is in."""
    graph = grimp.build_graph("mebdf", "tribodyn", cache_dir=None)
    circles = [
        f"{module} imports {imported}"
        for module in graph.modules
        for imported in graph.find_modules_directly_imported_by(module)
        if module.startswith(f"{imported}.") and graph.chain_exists(importer=imported, imported=module)
    ]
    assert not circles


def test_no_folder_holds_more_than_25_files() -> None:
    others = [path for top in ("tests", "benchmarks", "docs") for path in (ROOT / top).rglob("*.py")]
    files = Counter(path.parent.relative_to(ROOT) for path in [*SOURCES, *others])
    assert len(files) > 80
    assert {str(folder): count for folder, count in files.items() if count > 25} == {}


def test_long_files_say_why() -> None:
    silent = [
        str(path.relative_to(ROOT))
        for path in SOURCES
        if _is_long(path) and "One file because" not in _doc(path)
    ]
    assert not silent, (
        f"over {LONG_FILE} lines, and no 'One file because ...' in the module docstring: {silent}"
    )


def test_charts_are_described_without_matplotlib() -> None:
    """A report is drawn in the browser: whoever describes a chart must not need the other way of drawing."""
    graph = grimp.build_graph("tribodyn", include_external_packages=True, cache_dir=None)
    views = {"tribodyn.views", *graph.find_descendants("tribodyn.views")}
    assert not [view for view in sorted(views) if graph.chain_exists(importer=view, imported="matplotlib")]


def test_no_two_classes_have_the_same_name() -> None:
    """A name in a traceback, a signature or a search then means one class."""
    places: dict[str, list[str]] = {}
    for path in SOURCES:
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.ClassDef):
                places.setdefault(node.name, []).append(str(path.relative_to(ROOT)))
    shared = {name: files for name, files in places.items() if len(files) > 1}
    assert not shared


CLAUSE = re.compile(
    r'^\s*"""(?:\w+ )?(?:what|how|which|where|when|whatever|who)\b', re.IGNORECASE | re.MULTILINE
)


def test_first_lines_of_docstrings_have_a_noun_as_their_object() -> None:
    assert [(str(path), line) for path in SOURCES for line in CLAUSE.findall(path.read_text("utf-8"))] == []


def test_fields_are_described_beside_them() -> None:
    """A name and a unit that stand twice drift apart."""
    parts = (node for path in SOURCES for node in ast.parse(path.read_text("utf-8")).body)
    classes = [part for part in parts if isinstance(part, ast.ClassDef) and _is_data(part)]
    assert len(classes) > 100
    assert [node.name for node in classes if "\n\nAttributes\n" in (ast.get_docstring(node) or "")] == []


def _is_data(node: ast.ClassDef) -> bool:
    kinds = [ast.unparse(kind) for kind in (*node.decorator_list, *node.bases)]
    return any(kind.startswith(("dataclass", "NamedTuple")) for kind in kinds)


def _is_long(path: Path) -> bool:
    return len(path.read_text(encoding="utf-8").splitlines()) > LONG_FILE


def _doc(path: Path) -> str:
    return ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""


@pytest.mark.parametrize("page", ["CONTRIBUTING.md", "docs/developer/architecture.md"])
def test_files_that_pages_for_developers_name_are_there(page: str) -> None:
    pattern = r"`((?:src|docs|tests|tools|benchmarks|packages)/[\w./-]+\.\w+)`"
    named = set(re.findall(pattern, (ROOT / page).read_text(encoding="utf-8")))
    assert named
    assert {name for name in named if not (ROOT / name).exists()} == set()
