"""The report in a real browser."""

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from axe_playwright_python.sync_playwright import Axe
from scipy.interpolate import CubicHermiteSpline

import tribodyn as td
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.report import ComparedRun, write, write_comparison
from tribodyn.studies import Sampling, make_plan
from tribodyn.studies.archive import merge
from tribodyn.views.playback import playback_times

Opened = Callable[..., Any]
FIELD = """(field => Array.from(field.data.height, (_, k) =>
  Array.from(field.data.angle, (_, i) => field.value(i, k))))(plot.plotted)"""
# The 64 corners of the pivot come first, then the bar of the crank: 4 corners at the pivot, 4 at the tip.
ON_CRANK = """[plot.plotted].map(stage => {
  const at = n => [...stage.solids[0].points.slice(3 * n, 3 * n + 3)];
  const middle = (m, n, k) => 0.5 * (at(m)[k] + at(n)[k]);
  const place = [0, 1, 2].map(k => 0.35 * middle(64, 66, k) + 0.65 * middle(68, 70, k));
  return stage.project(stage.camera.matrix(stage.wide()), place).slice(0, 2);
})"""
SERIOUS = ("serious", "critical")


def _faults(reader: Any) -> list[str]:
    """Return what axe-core calls serious or worse."""
    found = Axe().run(reader.page).response["violations"]
    return [
        f"{fault['id']}: {node['html'][:160]}"
        for fault in found
        if fault["impact"] in SERIOUS
        for node in fault["nodes"]
    ]


def test_every_figure_is_drawn_without_a_word_to_the_network(opened: Opened, report: Path) -> None:
    reader = _opened_wide(opened, report, dark=False)
    assert reader.page.locator("[data-widget]").count() >= 10
    assert reader.plot("mechanism", "plot.plotted.gl instanceof WebGL2RenderingContext")
    assert reader.overflow() == 0
    reader.keep_picture("report-light")


def between(result: xr.Dataset, name: str, time: float) -> float:
    """Return a variable between rows from values and rates, as a flight across the clearance goes on."""
    rows = (result[one].values for one in ("time", name, f"{name}_dot"))
    return float(CubicHermiteSpline(*rows)(time))


def test_the_slider_moves_scene_circle_and_pressure_together(opened, report, result):
    reader = opened(report)
    for name in ("mechanism", "orbit", "pressure"):
        reader.look_at(name)
    times = playback_times(result)
    half = 0.5 * result.attrs["joint_length"]
    for frame in (0, times.size // 3, times.size - 20):
        reader.go_to_frame(frame)
        x, y, tilt_x, tilt_y = (
            between(result, name, times[frame]) for name in ("e_x", "e_y", "phi_x", "phi_y")
        )
        heights = (half, 0.0, -half)
        place = [[1e6 * (x - z * np.tan(tilt_y)), 1e6 * (y - z * np.tan(tilt_x))] for z in heights]
        shown = reader.plot("orbit", "plot.plotted.now")
        # Positions travel in single precision, 7 digits.
        np.testing.assert_allclose(shown, place, rtol=1e-5, atol=1e-5)
        _check_marks(reader, place)
        field = reader.plot("pressure", FIELD)
        expected = result["pressure_cycle"].values[frame] * 1e-6
        # Pressures travel in 255 steps of the frame's peak; the first column comes again at the end.
        step = float(expected.max()) / 255.0
        drawn = np.array(field)[:, :-1]
        np.testing.assert_allclose(np.sort(drawn, axis=None), np.sort(expected, axis=None), atol=0.51 * step)
        assert f"t = {times[frame]:.3f} s" in reader.page.locator(".clock output").inner_text()
        _check_scene(reader, result, times[frame])


def _check_marks(reader: Any, places: Sequence[Sequence[float]]) -> None:
    """Check that the marks of top, middle and bottom are painted in their colours where the points are."""
    here = json.dumps(places)
    colours = reader.colours("orbit", f"{here}.map(([x, y]) => [plot.plotted.x.at(x), plot.plotted.y.at(y)])")
    assert colours == [
        [0, 114, 178],
        [27, 29, 31],
        [192, 74, 0],
    ]  # blue, ink and vermilion of the style sheet


def _check_scene(reader: Any, result: xr.Dataset, time: float) -> None:
    """Check that crank and ring stand where the result says."""
    corners = np.array(reader.plot("mechanism", "[...plot.plotted.solids[0].points]")).reshape(-1, 3).T
    theta_a, h_1 = (np.interp(time, result["time"], result[name]) for name in ("theta_a", "h_1"))
    pivot = 500.0 * np.cos(np.deg2rad(20.0)), 500.0 * np.sin(np.deg2rad(20.0))
    tip = pivot[0] - 47.7 * np.sin(theta_a), pivot[1] + 47.7 * np.cos(theta_a)
    # The joint at the crank's end is drawn as a pin with a radius of 5 mm.
    distance = np.hypot(corners[0] - tip[0], corners[2] - tip[1])
    assert np.sum(np.abs(distance - 5.0) < 1e-3) >= 32
    # The ring is 10 mm wide about y = l_4 + h_1.
    assert np.sum(np.abs(corners[1] - (50.0 + 1e3 * h_1 + 5.0)) < 1e-3) > 100
    _check_ink(reader)


def _check_ink(reader: Any) -> None:
    """Check that the crank is painted: brown, where a point of it is seen."""
    colours = reader.colours("mechanism", ON_CRANK)
    red, green, blue = colours[0]
    assert red > green > blue
    assert red - blue > 40  # #b5652b in any light, a few pixels wide; all else is grey or blue


def test_time_series_show_the_moment_too(opened: Opened, report: Path, result: xr.Dataset) -> None:
    reader = opened(report)
    reader.look_at("contact-force")
    frame = playback_times(result).size // 2
    reader.go_to_frame(frame)
    assert reader.plot("contact-force", "plot.plotted.cursor") == pytest.approx(playback_times(result)[frame])
    assert reader.plot("contact-force", "plot.plotted.data.turns[0]") == pytest.approx(np.pi)
    # The line is 1.5 px wide and may lie between pixels: one of three is all of it.
    beside = """(({x, cursor, panels}) =>
      [-1, 0, 1].map(by => [x.at(cursor) + by, panels[0].frame.top + 1]))(plot.plotted)"""
    assert any(_near(colour, [11, 92, 143], 40) for colour in reader.colours("contact-force", beside))


def _near(colour: Sequence[int], wanted: Sequence[int], most: int) -> bool:
    return max(abs(a - b) for a, b in zip(colour, wanted, strict=True)) <= most


def test_the_first_screen_moves_by_itself_until_the_slider_is_touched(opened: Opened, report: Path) -> None:
    reader = opened(report, moving=True)
    page = reader.page
    for name in ("mechanism", "orbit"):
        assert page.locator(f"#{name} .plot").bounding_box()["y"] < 200.0
    assert page.locator(".first .key dd").count() == 3
    page.wait_for_function("() => document.querySelector('.clock input').value > 2")
    reader.go_to_frame(7)
    assert page.get_by_role("button", name="Play").is_visible()
    stopped = page.locator(".clock input").input_value()
    page.wait_for_timeout(200)
    assert page.locator(".clock input").input_value() == stopped


def test_it_can_be_read_with_the_keyboard_alone(opened: Opened, report: Path) -> None:
    reader = opened(report)
    page = reader.page
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.textContent") == "Skip to the numbers"
    page.locator(".clock input").focus()
    page.keyboard.press("ArrowRight")
    assert page.locator(".clock input").input_value() == "1"
    assert "t = " in (page.locator(".clock input").get_attribute("aria-valuetext") or "")
    _zoom_by_keyboard(reader)
    _turn_by_keyboard(reader)


def _zoom_by_keyboard(reader: Any) -> None:
    reader.look_at("contact-force")
    reader.page.locator("#contact-force .plot").focus()
    whole = reader.plot("contact-force", "plot.plotted.view")
    reader.page.keyboard.press("+")
    near = reader.plot("contact-force", "plot.plotted.view")
    assert near[1] - near[0] == pytest.approx(0.5 * (whole[1] - whole[0]))
    reader.page.keyboard.press("ArrowRight")
    assert reader.plot("contact-force", "plot.plotted.view[0]") > near[0]
    reader.page.keyboard.press("0")
    assert reader.plot("contact-force", "plot.plotted.view") == pytest.approx(whole)
    curve = reader.page.locator("#contact-force button.legend").first
    curve.focus()
    reader.page.keyboard.press("Enter")
    assert curve.get_attribute("aria-pressed") == "false"
    name = curve.text_content()
    assert reader.plot("contact-force", "[...plot.plotted.hidden]") == [name]


def _turn_by_keyboard(reader: Any) -> None:
    reader.look_at("mechanism")
    reader.page.locator("#mechanism .plot").focus()
    before = reader.plot("mechanism", "plot.plotted.camera.eye[0]")
    reader.page.keyboard.press("ArrowLeft")
    assert reader.plot("mechanism", "plot.plotted.camera.eye[0]") != before
    bore = reader.plot("mechanism", "plot.plotted.solids[1].points[0]")
    reader.page.locator("#mechanism input").focus()
    reader.page.keyboard.press("End")
    reader.settle()
    assert reader.plot("mechanism", "plot.plotted.solids[1].points[0]") > bore


def _opened_wide(opened: Opened, report: Path, dark: bool) -> Any:
    """Open a report with all that unfolds, draw it, and have axe look at it."""
    reader = opened(report, dark=dark)
    reader.page.evaluate("document.querySelectorAll('details').forEach(one => { one.open = true; })")
    reader.draw_everything()
    assert _faults(reader) == []
    return reader


def _ink(reader: Any) -> list[int]:
    """Return the colour of the mark of the middle, which is that of the ink."""
    middle = "[plot.plotted].map(({now, x, y}) => [x.at(now[1][0]), y.at(now[1][1])])"
    colour: list[int] = reader.colours("orbit", middle)[0]
    return colour


def test_a_phone_shows_it_all_without_overflow(opened: Opened, report: Path) -> None:
    reader = opened(report, width=380, phone=True)
    reader.draw_everything()
    assert reader.overflow() == 0
    wide = "all => all.filter(one => one.getBoundingClientRect().right > innerWidth + 1).map(one => one.id)"
    assert reader.page.locator("figure").evaluate_all(wide) == []
    assert _faults(reader) == []
    reader.keep_picture("report-phone")


@pytest.mark.usefixtures("emulating")
def test_the_colours_follow_the_system_while_it_is_open(opened: Opened, report: Path) -> None:
    reader = opened(report)
    reader.look_at("orbit")
    reader.page.emulate_media(color_scheme="dark")
    dark = [232, 232, 230]
    for _ in range(20):  # a busy machine tells it late
        reader.settle()
        if _ink(reader) == dark:
            break
    assert _ink(reader) == dark


@pytest.mark.usefixtures("emulating")
def test_paper_gets_stills_and_no_controls(opened: Opened, report: Path, tmp_path: Path) -> None:
    reader = opened(report, width=720)
    page = reader.page
    page.emulate_media(media="print")
    assert not page.locator(".clock").is_visible()
    assert not page.locator("#motion .live").is_visible()
    assert page.locator("#motion .still img").is_visible()
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    assert reader.overflow() == 0
    tables = "[...document.querySelectorAll('.wide')]"
    assert page.evaluate(f"{tables}.every((one) => one.scrollWidth <= one.clientWidth)")
    reader.keep_picture("report-print")
    page.pdf(path=tmp_path / "report.pdf", format="A4")
    assert (tmp_path / "report.pdf").stat().st_size > 50_000


@pytest.mark.usefixtures("emulating")
def test_without_scripts_it_still_says_everything(browser: Any, report: Path) -> None:
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(report.as_uri())
    assert page.locator("#motion .still img").is_visible()
    assert page.locator("table.numbers").is_visible()
    assert not page.locator(".clock").is_visible()
    context.close()


def test_worn_shapes_have_a_slider_of_their_own(opened: Opened, result: xr.Dataset, tmp_path: Path) -> None:
    final = result["wear_depth"].values
    stages = {"stage_depth": (("stage_cycles", "theta", "z"), np.stack([0.25 * final, 0.5 * final, final]))}
    campaign = result.assign(stages).assign_coords(stage_cycles=[100.0, 200.0, 400.0])
    reader = opened(write(campaign, tmp_path))
    reader.look_at("wear-stages")
    first = np.max(reader.plot("wear-stages", FIELD))
    slider = reader.page.locator("#wear-stages input")
    slider.focus()
    reader.page.keyboard.press("End")
    reader.settle()
    assert slider.get_attribute("aria-valuetext") == "after 400 cycles"
    last = np.max(reader.plot("wear-stages", FIELD))
    assert last == pytest.approx(4.0 * first, rel=1e-5)  # single precision


@pytest.mark.parametrize("width", [1280, 380])
def test_a_point_of_a_sweep_opens_its_report(opened: Opened, tmp_path: Path, width: int) -> None:
    plan = make_plan(load_case("vsv"), {"joint.clearance": "20:50:10 um"}, Sampling())
    numbers = {
        point.name: {"failure": "", "contact_force_max_N": 10.0 * k, "tilt_max_mrad": -1.0 * k}
        for k, point in enumerate(plan.points)
    }
    for point in plan.points:
        (tmp_path / "points" / point.name).mkdir(parents=True)
        (tmp_path / "points" / point.name / "report.html").write_text("a report", encoding="utf-8")
    reader = opened(write(merge(plan, numbers), tmp_path), elsewhere=True, width=width)
    reader.draw_everything()
    assert reader.overflow() == 0
    assert _faults(reader) == []
    reader.keep_picture(f"sweep-{width}")
    reader.look_at("parallel")
    place = reader.plot(
        "parallel",
        "(({left, top}, {x, y}) => [left + x.at(0), top + y.at(1)])"
        "(plot.getBoundingClientRect(), plot.plotted)",
    )
    reader.page.mouse.move(*place)
    reader.settle()
    assert "joint.clearance [µm] = 50" in reader.page.locator("#parallel .readout").inner_text()
    reader.page.mouse.click(*place)
    reader.page.wait_for_url(f"**/points/{plan.points[-1].name}/report.html")


def test_a_journal_is_followed(opened: Opened, tmp_path: Path) -> None:
    journal = td.simulate(td.load_case("journal-dry").replace({"run.duration": "2 ms"}))
    reader = opened(write(journal, tmp_path))
    reader.draw_everything()
    times = playback_times(journal)
    reader.look_at("orbits")
    reader.go_to_frame(times.size // 2)
    expected = np.interp(times[times.size // 2], journal["time"], journal["displacement"][:, 0, 0]) * 1e6
    # Positions travel in single precision, 7 digits; between rows the path follows cubics.
    assert reader.plot("orbits", "plot.plotted.now[0][0]") == pytest.approx(expected, rel=1e-3)
    assert _faults(reader) == []
    reader.keep_picture("journal")


@pytest.mark.usefixtures("emulating")
def test_a_drag_zooms_and_a_double_click_goes_back(opened: Opened, report: Path) -> None:
    reader = opened(report)
    reader.look_at("contact-force")
    box = reader.page.locator("#contact-force .plot").bounding_box()
    y = box["y"] + 60
    reader.page.mouse.move(box["x"] + 300, y)
    reader.page.mouse.down()
    reader.page.mouse.move(box["x"] + 500, y, steps=4)
    reader.page.mouse.up()
    left, right = reader.plot(
        "contact-force", "[plot.plotted.x.at(plot.plotted.view[0]), plot.plotted.x.at(plot.plotted.view[1])]"
    )
    view = reader.plot("contact-force", "plot.plotted.view")
    span = reader.plot("contact-force", "plot.plotted.span")
    share = 200 / (right - left)  # of the width, that the drag went over
    assert view[1] - view[0] == pytest.approx(share * (span[1] - span[0]), rel=1e-9)
    reader.page.mouse.move(box["x"] + 400, y)
    assert "t = " in reader.page.locator("#contact-force .hover").inner_text()
    reader.page.mouse.dblclick(box["x"] + 400, y)
    assert reader.plot("contact-force", "plot.plotted.view") == pytest.approx(span)


def test_without_webgl_the_same_triangles_are_drawn(opened: Opened, report: Path) -> None:
    reader = opened(report, webgl=False)
    reader.look_at("mechanism")
    assert reader.plot("mechanism", "plot.plotted.gl") is None
    _check_ink(reader)
    reader.page.get_by_role("button", name="Trunnion and bushing").click()
    reader.settle()
    reader.keep_picture("report-without-webgl")


HOSTILE = '<img src=x onerror="alert(1)"><script>alert(2)</script> & </script> </title> {{ 7*7 }} \u2028 “µ”'


def test_hostile_names_are_shown_as_text(opened: Opened, result: xr.Dataset, tmp_path: Path) -> None:
    texts = {"title": HOSTILE, "contact_law": HOSTILE, "failure": HOSTILE, "case": HOSTILE}
    hostile = result.assign_attrs(**texts, warnings=f'["{HOSTILE.replace(chr(34), chr(39))}"]')
    hostile["F_cx"].attrs["long_name"] = HOSTILE
    folder = tmp_path / "<b>run & more"
    reader = opened(write(hostile, folder))
    reader.draw_everything()
    assert reader.page.locator("h1").text_content() == HOSTILE
    assert reader.page.title().startswith("<img src=x")
    assert reader.page.locator("img").count() == 0
    # Data and our own script.
    assert reader.page.locator("script").count() == 2


def test_a_failed_run_shows_its_failure_and_time_first(
    opened: Opened, result: xr.Dataset, tmp_path: Path
) -> None:
    partial = result.isel(time=slice(0, 300), frame=slice(0, 50)).assign_attrs(
        failure="the step size became too small"
    )
    reader = opened(write(partial, tmp_path))
    first = reader.page.locator("main > *").first
    assert first.get_attribute("role") == "alert"
    assert "the step size became too small" in first.inner_text()
    assert f"stopped at t = {float(partial['time'][-1]):.4g} s" in first.inner_text()
    reader.draw_everything()
    assert _faults(reader) == []
    reader.keep_picture("report-failed")


def test_a_result_with_next_to_nothing_opens(opened: Opened, result: xr.Dataset, tmp_path: Path) -> None:
    bare = result[["e_x", "e_y"]].isel(time=slice(0, 1))
    reader = opened(write(bare, tmp_path))
    assert reader.page.locator("h1").count() == 1
    assert reader.overflow() == 0


def test_a_comparison_shows_directory_names_as_text(
    opened: Opened, result: xr.Dataset, tmp_path: Path
) -> None:
    runs = [ComparedRun("one", result), ComparedRun(HOSTILE, result.assign_attrs(case='case = "vsv"'))]
    reader = opened(write_comparison(runs, tmp_path / "comparison.html"))
    reader.draw_everything()
    assert reader.page.locator("[data-widget]").count() == 6
    assert reader.page.locator("img").count() == 0
    assert reader.page.locator("button.legend").nth(1).text_content() == HOSTILE
    assert reader.plot("overlay-force", "plot.plotted.data.panels.flatMap(panel => panel.curves).length") == 4
    assert _faults(reader) == []
    reader.keep_picture("comparison")
