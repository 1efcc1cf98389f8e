"""Published metadata: one version and one list of dependencies, in whatever form a packager reads them."""

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
import yaml

ROOT = Path(__file__).parents[2]
PROJECTS = {"mebdf": ROOT / "packages" / "mebdf", "tribodyn": ROOT}


def project(name: str) -> dict[str, Any]:
    found: dict[str, Any] = tomllib.loads((PROJECTS[name] / "pyproject.toml").read_text(encoding="utf-8"))
    return found["project"]


def recipe() -> dict[str, Any]:
    found: dict[str, Any] = yaml.safe_load((ROOT / "tools" / "recipe.yaml").read_text(encoding="utf-8"))
    return found


def bounds(lines: list[str]) -> set[str]:
    """Return requirements in one spelling; those of some systems alone are left out."""
    return {re.sub(r"\s", "", line.partition(";")[0]).lower() for line in lines if ";" not in line}


@pytest.mark.parametrize("place", [0, 1], ids=list(PROJECTS))
def test_the_conda_recipe_has_the_bounds_of_the_project(place: int) -> None:
    output = recipe()["outputs"][place]
    ours = project(output["package"]["name"])
    needed = bounds(output["requirements"]["run"])
    assert needed == bounds(ours["dependencies"]) | {f"python{ours['requires-python']}"}


def test_all_files_name_one_version() -> None:
    version = project("tribodyn")["version"]
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert {citation["version"], recipe()["context"]["version"], project("mebdf")["version"]} == {version}
    assert f"mebdf=={version}" in bounds(project("tribodyn")["dependencies"])


def test_a_release_builds_for_every_system_that_has_a_library() -> None:
    from mebdf.compiled.platforms import PLATFORMS

    steps = (ROOT / ".github" / "workflows" / "release.yml").read_text(encoding="utf-8")
    assert f"for system in {' '.join(PLATFORMS)}; do" in steps
