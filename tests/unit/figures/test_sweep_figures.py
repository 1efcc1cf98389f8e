import io
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from tribodyn.figures import sweep
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.report import draw_all, figures_of
from tribodyn.studies import Sampling, make_plan
from tribodyn.studies.archive import merge

SWEEPS = {
    "line": ({"joint.clearance": "10:100:10 um"}, Sampling()),
    "one point": ({"joint.clearance": "10 um"}, Sampling()),
    "logarithmic": ({"solver.rtol": "1e-6,1e-5,1e-4,1e-3"}, Sampling()),
    "names": ({"contact.law": "ke,rsdc"}, Sampling()),
    "switch": ({"contact.tensile_clip": "true,false"}, Sampling()),
    "lines": ({"mechanism.formulation": "exact,paper", "joint.clearance": "20:40:5 um"}, Sampling()),
    "map": ({"joint.clearance": "20:40:5 um", "joint.friction_coefficient": "0:0.3:0.1"}, Sampling()),
    "map of names": ({"contact.law": "ke,rsdc", "mechanism.formulation": "exact,paper"}, Sampling()),
    "three": (
        {"contact.law": "ke,rsdc", "joint.clearance": "20,30 um", "joint.friction_coefficient": "0:0.3:0.1"},
        Sampling(),
    ),
    "samples": (
        {"joint.clearance": "normal(20, 2 um)", "joint.friction_coefficient": "uniform(0, 0.3)"},
        Sampling(20),
    ),
    "groups": ({"joint.clearance": "normal(20, 2 um)", "contact.law": "ke,rsdc"}, Sampling(20)),
}
LOST = {"none": lambda i: False, "some": lambda i: i % 3 == 1, "all": lambda i: True}


def made_up(name: str, lost: str = "none") -> xr.Dataset:
    plan = make_plan(load_case("vsv"), *SWEEPS[name])
    rng = np.random.default_rng(0)
    return merge(
        plan,
        {
            point.name: {
                "failure": "boom" if LOST[lost](i) else "",
                "contact_force_max_N": rng.normal(100.0, 10.0),
                "of_another_law_ms": rng.normal(1.0, 0.1),
            }
            for i, point in enumerate(plan.points)
        },
    )


@pytest.mark.parametrize(
    "lost", ["some", *(pytest.param(lost, marks=pytest.mark.long) for lost in ("none", "all"))]
)
@pytest.mark.parametrize("name", SWEEPS)
def test_every_sweep_is_drawn(name: str, lost: str) -> None:
    dataset = made_up(name, lost)
    family = figures_of(dataset)["contact_force_max_N"]
    figure = family.draw(dataset)
    figure.savefig(io.BytesIO(), format="png", dpi=30)
    texts = " ".join(text.get_text() for text in figure.texts)
    assert "Contact force, peak" in texts
    assert ("without a result" in texts) == (dataset.attrs["points_failed"] > 0)
    labels = [axes.get_ylabel() for axes in figure.axes]
    assert any("[N]" in label for label in labels)


def test_there_is_one_figure_a_number(tmp_path: Path) -> None:
    written = draw_all(made_up("lines"), tmp_path)
    assert [path.name for path in written] == ["contact_force_max_N.png", "of_another_law_ms.png"]


def test_lines_stand_over_the_shown_unit() -> None:
    axes = figures_of(made_up("lines"))["contact_force_max_N"].draw(made_up("lines")).axes[0]
    assert "µm" in axes.get_xlabel()
    assert axes.lines[0].get_xdata().tolist() == pytest.approx([20, 25, 30, 35, 40])
    assert [line.get_label() for line in axes.lines] == ["exact", "paper"]


def test_samples_that_rounding_alone_parts_are_drawn() -> None:
    dataset = made_up("samples")
    dataset["contact_force_max_N"][:] = 100.0
    dataset["contact_force_max_N"][0] = np.nextafter(100.0, 101.0)
    shown = dataset.assign_attrs(shown="contact_force_max_N")
    figures_of(shown)["contact_force_max_N"].draw(shown)


def test_numbers_that_do_not_differ_in_the_digits_that_hold_have_no_figure():
    values = {"moves": [1.0, 1.02, 1.04], "noise": [6190.0, 6191.0, 6190.5], "steps": [5.0, 6.0, 7.0]}
    swept = xr.Dataset(
        {name: ("x", np.array(numbers), {"digits": 3}) for name, numbers in values.items()},
        {"x": [1.0, 2.0, 3.0]},
    )
    swept["steps"].attrs["group"] = sweep.EFFORT_GROUP
    assert list(sweep.families(swept)) == ["moves"]
    assert "noise" in sweep.families(swept.assign_attrs(shown="noise"))
