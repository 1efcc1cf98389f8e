"""Contact laws that come from a user or from another package."""

import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest

import tribodyn as td
from tribodyn.contact import ContactLaw, law_of_user, tabulate
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.bushing import bushing_of

LAW = """
from dataclasses import dataclass
from typing import ClassVar
import numpy as np
from tribodyn.contact import ContactLaw
from tribodyn.contact.parameter import parameter

@dataclass(frozen=True)
class Mine(ContactLaw):
    name: ClassVar[str] = "mine"
    title: ClassVar[str] = "Mine"
    source: ClassVar[str] = "mine"
    validity: ClassVar[str] = "mine"

    def stiffness_pressure(self, h_star):
        return 0.02 * self.pair.hardness * np.exp(-2.5 * np.asarray(h_star))

class Nameless(ContactLaw):
    pass

@dataclass(frozen=True)
class Steep(Mine):
    name: ClassVar[str] = "steep"
    steepness: float = parameter(2.5, "", "decay of the pressure over h*", above=0.0)

    def stiffness_pressure(self, h_star):
        return 0.02 * self.pair.hardness * np.exp(-self.steepness * np.asarray(h_star))

@dataclass(frozen=True)
class Clashing(Mine):
    name: ClassVar[str] = "clashing"
    penalty_stiffness: float = parameter(2.5, "", "of no unit")

@dataclass(frozen=True)
class Shadowing(Mine):
    name: ClassVar[str] = "shadowing"
    tensile_clip: float = parameter(2.5, "", "not a switch")
"""


@dataclass(frozen=True)
class Soft(ContactLaw):
    """An exponential pressure."""

    name: ClassVar[str] = "soft"
    title: ClassVar[str] = "Soft"
    source: ClassVar[str] = "here"
    validity: ClassVar[str] = "here"

    def stiffness_pressure(self, h_star: Any) -> Any:
        return 2.0e6 * np.exp(-1.5 * np.asarray(h_star))


def soft(h_star: Any) -> Any:
    return 2.0e6 * np.exp(-1.5 * h_star)


@pytest.mark.parametrize("given", [Soft, soft])
def test_the_joint_of_a_case_has_the_table_of_the_law(given: Any) -> None:
    case: Any = td.load_case("vsv")
    chosen = case.contact.with_own(law_of_user(given))
    joint = bushing_of(case.model_copy(update={"contact": chosen}))
    wanted = tabulate(Soft(case.surface_pair))
    assert joint.table.nodes[0, 0] == pytest.approx(wanted.nodes[0, 0])
    assert chosen.law == "soft"
    assert case.contact.law == "rsdc"


@pytest.mark.parametrize("given", [Soft, soft])
def test_a_run_takes_it(given: Any) -> None:
    case = td.load_case("vsv").replace({"run.duration": "10 ms"})
    result = td.simulate(case, law=given)
    assert result.attrs["contact_law"] == "soft"
    assert not result.attrs["failure"]
    # Softer surfaces touch over more of the bushing: the same load at a smaller peak pressure.
    assert float(result.p_max[-1]) < float(td.simulate(case).p_max[-1])


@pytest.mark.parametrize(
    ("given", "hint"),
    [
        (3, "a class of a contact law, or a function"),
        (int, "subclass of tribodyn.contact.ContactLaw"),
        (ContactLaw, "lacks name, title, source, validity"),
        (lambda h_star: -h_star, "finite pressure >= 0"),
        (lambda h_star: 1.0e6, "for each separation"),
    ],
)
def test_what_is_no_law_is_refused(given: Any, hint: str) -> None:
    pair: Any = td.load_case("vsv")
    with pytest.raises(InputError, match=hint):
        tabulate(law_of_user(given)(pair.surface_pair))


def check_with_package(place: Path, laws: str, law: str, *more: str) -> subprocess.CompletedProcess[str]:
    """Check ``vsv`` with a law where a package is installed that registers some."""
    (place / "mine.py").write_text(LAW, encoding="utf-8")
    about = place / "mine-1.0.dist-info"
    about.mkdir(exist_ok=True)
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: mine\nVersion: 1.0\n", encoding="utf-8")
    (about / "entry_points.txt").write_text(f"[tribodyn.laws]\n{laws}", encoding="utf-8")
    path = os.pathsep.join([str(place), *sys.path])
    return subprocess.run(
        [sys.executable, "-m", "tribodyn", "check", "vsv", "--set", f"contact.law={law}", *more],
        env=os.environ | {"PYTHONPATH": path},
        capture_output=True,
        text=True,
    )


def test_a_package_adds_its_law_and_one_that_is_none_keeps_nobody_from_the_others(tmp_path: Path) -> None:
    laws = "mine = mine:Mine\nwrong = mine:Nameless\ngone = nowhere:Law\n"
    done = check_with_package(tmp_path, laws, "mine")
    assert done.returncode == 0, done.stderr
    assert "mine:Nameless was left out: the contact law Nameless lacks name" in " ".join(
        done.stderr.split()
    ).replace("law: ", "")
    assert "nowhere:Law was left out" in done.stderr


def test_the_law_of_a_package_has_parameters_and_takes_none_from_the_others(tmp_path: Path) -> None:
    laws = "a = mine:Steep\nb = mine:Clashing\nc = mine:Shadowing\n"
    done = check_with_package(tmp_path, laws, "steep", "--set", "contact.steepness=3")
    assert done.returncode == 0, done.stderr
    said = " ".join(done.stderr.split())
    assert "mine:Clashing was left out: another law has another parameter 'penalty_stiffness'" in said
    assert "contact.tensile_clip is a key of all laws, and not declared by the law shadowing" in said
    refused = check_with_package(tmp_path, laws, "steep", "--set", "contact.steepness=-3")
    assert refused.returncode != 0
    assert "contact.steepness" in refused.stderr + refused.stdout
