"""The reference shows every part of the package, so that whatever is public is found there."""

import importlib.util
import re
from pathlib import Path

ROOT = Path(__file__).parents[3]
EXTENSION = ROOT / "docs" / "_ext" / "reference.py"


def test_every_package_and_module_stands_in_the_reference() -> None:
    spec = importlib.util.spec_from_file_location("reference", EXTENSION)
    assert spec is not None
    assert spec.loader is not None
    reference = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(reference)
    source = ROOT / "src"
    files = {
        ".".join(path.relative_to(source).with_suffix("").parts).removesuffix(".__init__")
        for path in source.rglob("*.py")
        if path.name != "__main__.py"
    }
    shown = "".join(reference.page(package) for package in reference.packages())
    missing = [name for name in files - {"tribodyn"} if f".. automodule:: {name}\n" not in shown]
    assert missing == []


def test_files_that_the_page_on_architecture_names_exist() -> None:
    page = (ROOT / "docs" / "developer" / "architecture.md").read_text(encoding="utf-8")
    named = set(re.findall(r"`([\w/]+\.(?:py|toml))`", page))
    there = [str(path) for top in ("src", "packages", "tests", "docs") for path in (ROOT / top).rglob("*.*")]
    assert len(named) > 30
    assert [name for name in sorted(named) if not any(path.endswith(f"/{name}") for path in there)] == []
    assert len(page.split()) <= 2000
