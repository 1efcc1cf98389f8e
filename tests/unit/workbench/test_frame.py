"""What the workbench sends: frames, series, costs."""

import numpy as np
import pytest
from tests.unit.workbench.host import unframed

from tribodyn.core.errors import TribodynError
from tribodyn.mechanisms.catalogue import load_case, parse_case, template
from tribodyn.studies.builds import NUMBERS
from tribodyn.views.encode import packed
from tribodyn.workbench import messages, work
from tribodyn.workbench.description import description
from tribodyn.workbench.series import AROUND, slopes
from tribodyn.workbench.server_state import MOST_CASES, Costs, KeptRuns
from tribodyn.workbench.variant import Origin


def test_arrays_stand_where_the_header_says_at_multiples_of_eight():
    arrays = {"f32": np.arange(3.0), "u8": np.arange(5), "f64": np.array([np.pi, np.nan])}
    kinds = {"f32": "float32", "u8": "uint8", "f64": "float64"}
    made = messages.body({"ä": [{kind: packed(values, kinds[kind])} for kind, values in arrays.items()]})
    answer = unframed(messages.addressed(made, 7, messages.KEPT))
    assert (answer.number, answer.flags) == (7, messages.KEPT)
    for found, (kind, values) in zip(answer.header["ä"], arrays.items(), strict=True):
        offset, length = found[kind][kind]
        assert offset % 8 == 0
        assert np.array_equal(
            np.frombuffer(answer.data, np.dtype(kinds[kind]).newbyteorder("<"), length, offset),
            values.astype(kinds[kind]),
            equal_nan=True,
        )
    assert messages.header(made) == answer.header


def test_of_runs_the_last_and_the_pinned_are_kept_and_others_as_there_is_room():
    runs = KeptRuns(room=25)
    for run in "abcd":
        runs.keep(run, f"case {run}", b"x" * 10)
        if run == "a":
            assert runs.pin("a")
    assert [run for run in "abcd" if runs.frame(run)] == ["a", "d"]
    assert runs.cases["b"] == "case b", "texts take no room"
    runs.unpin("a")
    runs.keep("e", "case e", b"x" * 30)
    assert list(runs.frames) == ["e"]
    assert not runs.pin("nothing")


def points(value, number):
    return [{"value": value * (1 + share), "results": {"a": number(1 + share)}} for share in AROUND]


def test_the_slope_of_a_power_is_its_exponent_and_a_line_has_no_scatter():
    line = slopes(points(40.0, lambda x: 3.0 * x))["a"]
    assert line["slope"] == pytest.approx(1.0, rel=1e-12)
    assert line["scatter"] == pytest.approx(0.0, abs=1e-12)
    # Over ten percent to either side, a square is its tangent but for the cube of that.
    assert slopes(points(40.0, lambda x: x**2))["a"]["slope"] == pytest.approx(2.0, rel=0.01)


def test_scatter_is_the_standard_error_of_the_slope():
    # Residuals ±1 % in turns, none of them along the line.
    noise = dict(zip(AROUND, (0.01, -0.01, 0.0, -0.01, 0.01), strict=True))
    found = slopes(points(40.0, lambda x: 1.0 + noise[min(AROUND, key=lambda s: abs(1 + s - x))]))["a"]
    assert found["slope"] == pytest.approx(0.0, abs=1e-12)
    assert found["scatter"] == pytest.approx((4e-4 / 3 / 0.025) ** 0.5, rel=1e-9)


def test_numbers_that_a_point_lacks_have_no_slope():
    some = points(40.0, lambda x: x)
    some[2]["results"] = {}
    assert slopes(some) == {}


def test_one_run_that_the_machine_held_up_does_not_end_a_drag():
    costs, case = Costs(), load_case("vsv")
    for seconds in (0.15, 0.16, 9.0, 0.14):
        costs.note(case, seconds)
        assert costs.expected(case) < 0.2
    for _ in range(3):
        costs.note(case, 9.0)
    assert 8.9 < costs.expected(case) < 9.1


def test_of_cases_whose_copies_scatter_a_page_can_save_histograms_of_builds(monkeypatch):
    monkeypatch.setattr(work, "_COPIES", 4)
    monkeypatch.setattr(work, "_DRAWS", 400)
    text = template("vsv-ring").replace('elastic = "beam"\n', "")
    origin = Origin(
        parse_case(text, "ring").replace({"pattern.vanes.count": 3, "run.duration": "0.2 s"}), "ring"
    )
    assert "builds.svg" in description(origin)["downloads"]
    assert "builds.svg" not in description(Origin(load_case("vsv"), "vsv"))["downloads"]
    drawn = work.distribution(origin.case, {}, lambda reached: None, lambda: False)
    assert drawn.count(b'id="axes_') == len(NUMBERS)
    with pytest.raises(TribodynError, match="not computed"):
        work.distribution(origin.case, {}, lambda reached: None, lambda: True)


def test_texts_of_cases_are_forgotten_in_time():
    runs = KeptRuns(room=1)
    for number in range(MOST_CASES + 10):
        runs.keep(str(number), "", b"xx")
    assert len(runs.cases) == MOST_CASES
    assert str(MOST_CASES + 9) in runs.cases
