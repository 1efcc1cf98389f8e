"""Packages: public names, layers of mechanisms, versions and recipes."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from scipy.integrate import OdeSolver, solve_ivp

import tribodyn as td
from tribodyn.mechanisms.catalogue import FOLDERS


def test_a_contact_law_is_a_pressure_over_a_gap_in_metres() -> None:
    pressure = td.contact.law("rsdc", td.load_case("vsv")).pressure(
        np.array([[0.0, 1.634e-6], [3.268e-6, 1.0]])
    )
    # The project's check values, given to four digits at whole multiples of sigma, itself to four digits.
    np.testing.assert_allclose(pressure[0], [518.2e6, 98.78e6], rtol=1e-3)
    assert pressure[1, 1] == 0.0


def test_the_integrator_is_one_of_scipys() -> None:
    assert issubclass(td.integrate.MEBDF, OdeSolver)
    decay = solve_ivp(lambda t, y: -y, (0.0, 1.0), [1.0], method=td.integrate.MEBDF, rtol=1e-8, atol=1e-10)
    assert decay.success
    np.testing.assert_allclose(decay.y[0, -1], np.exp(-1.0), rtol=1e-6)


SOURCE = Path(__file__).parents[2] / "src" / "tribodyn"
CATALOGUE = SOURCE / "mechanisms" / "catalogue.py"
ORDINARY = ("mechanism",)  #: Names that are words of prose, too: an import is what counts.
#: The list of what is compiled begins with the laws of elements, which stand there.
LISTING = SOURCE / "kernels" / "jit.py"
PUBLIC = SOURCE / "__init__.py"  #: What a user imports from the package says where it is.


@pytest.mark.parametrize("name", ["vsv", *(package.rpartition(".")[2] for package in FOLDERS.values())])
def test_no_mechanism_is_named_outside_its_folders(name: str) -> None:
    word = re.compile(rf"tribodyn\.{name}\b" if name in ORDINARY else rf"\b{name}\b")
    found = [
        str(path.relative_to(SOURCE))
        for path in SOURCE.rglob("*.py")
        if name not in path.relative_to(SOURCE).parts
        and path not in (CATALOGUE, LISTING, PUBLIC)
        and not {"papers", "validation"} & set(path.relative_to(SOURCE).parts)
        and word.search(path.read_text(encoding="utf-8"))
    ]
    assert found == []


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
