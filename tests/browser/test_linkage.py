"""The report of a drawn mechanism in a real browser."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.unit.mechanism.made_up import N, result

from tribodyn.cases.case import with_entries
from tribodyn.mechanism.assembly.skeleton import case_of
from tribodyn.report import write

MAIN = {f"joints.main.clearance.{key}": value for key, value in {"radial": "20 um", "length": "5 mm"}.items()}
SEEN = """PLACES.map(place =>
  plot.plotted.project(plot.plotted.camera.matrix(plot.plotted.wide()), place).slice(0, 2))"""


def hide_arrows(reader: Any) -> None:
    for kind in ("Joint forces", "Load forces"):
        reader.page.locator("#mechanism").get_by_role("button", name=kind).click()


def test_bodies_and_joints_move_with_the_slider(opened: Callable[..., Any], tmp_path: Path) -> None:
    reader = opened(write(result(), tmp_path))
    reader.draw_everything()
    reader.keep_picture("linkage")
    # Arrows of forces cover the joints that they act on.
    hide_arrows(reader)
    for frame in (N // 8, N // 3):
        reader.look_at("mechanism")
        reader.go_to_frame(frame)
        turn = 2.0 * np.pi * frame / (N - 1)
        pin = 50.0 * np.array([np.cos(turn), np.sin(turn), 0.0])
        wrist = np.array([pin[0] + np.sqrt(120.0**2 - pin[1] ** 2), 0.0, 0.0])
        aside = np.array([0.0, 60.0, 0.0])
        places = [0.5 * pin, 0.5 * (pin + wrist), wrist, wrist + aside]
        shown = SEEN.replace("PLACES", json.dumps([place.tolist() for place in places]))
        crank, rod, joint, nothing = reader.colours("mechanism", shown)
        # Blue and vermilion of the style sheet in any light; the real wrist stands out of the slider's block.
        assert crank[2] > crank[1] > crank[0] + 20
        assert rod[0] > rod[1] + 40
        assert joint[0] > joint[1] + 40
        assert min(nothing) > 240
        reader.look_at("orbits")
        place = [22.0 * np.cos(turn), 21.0 * np.sin(turn)]
        assert reader.plot("orbits", "plot.plotted.now[0]") == pytest.approx(place, abs=1e-3)


def test_clearance_is_magnified_and_arrows_are_shown_by_controls(opened, tmp_path):
    reader = opened(write(result(), tmp_path), width=390)
    reader.look_at("mechanism")
    figure = reader.page.locator("#mechanism")
    corners = "plot.plotted.solids.map((solid) => solid.corners.length)"
    before = reader.plot("mechanism", f"[...plot.plotted.solids[0].points, {corners}]")
    assert before[-1][2] > 0
    slider = figure.locator(".magnifier input")
    slider.evaluate("slider => { slider.value = slider.min; slider.dispatchEvent(new Event('input')); }")
    after = reader.plot("mechanism", f"[...plot.plotted.solids[0].points, {corners}]")
    assert figure.locator(".magnifier output").inner_text() == "1×"
    assert after[-1] == before[-1]
    assert after[:-1] != before[:-1]
    hide_arrows(reader)
    assert reader.plot("mechanism", corners)[2] == 0
    assert reader.overflow() == 0


def test_a_bore_far_wider_than_long_is_a_ring_that_hides_nothing(opened, tmp_path):
    wide = with_entries(case_of(result()), {"joints.main.clearance.radius": "60 mm", **MAIN}, "test")
    clearance = np.array([20e-6, np.nan, 20e-6, np.nan])
    whole = result().assign(clearance=("joint", clearance)).assign_attrs(case=wide.to_toml())
    reader = opened(write(whole, tmp_path))
    reader.look_at("mechanism")
    hide_arrows(reader)
    reader.go_to_frame(0)
    # Inside the ring of the main bearing: the crank, which begins along x, and nothing aside of it.
    shown = SEEN.replace("PLACES", json.dumps([[25.0, 0.0, 0.0], [25.0, 30.0, 0.0]]))
    crank, nothing = reader.colours("mechanism", shown)
    assert crank[2] > crank[1] > crank[0] + 20
    assert min(nothing) > 240


def test_names_of_joints_do_not_overlap(opened: Callable[..., Any], tmp_path: Path) -> None:
    reader = opened(write(result(), tmp_path), width=390)
    reader.look_at("mechanism")
    crowd = """(() => {
      const stage = plot.plotted;
      const [{ at }] = stage.names;
      stage.names = Array.from({ length: 30 }, (_, k) => ({ text: `a long name ${k}`, at, aside: [8, -12] }));
      stage.draw();
      return stage.written;
    })()"""
    boxes = reader.plot("mechanism", crowd)
    assert len(boxes) >= 8
    for k, one in enumerate(boxes):
        for other in boxes[:k]:
            beside = one["right"] < other["left"] or other["right"] < one["left"]
            assert beside or one["bottom"] <= other["top"] or other["bottom"] <= one["top"]


def test_the_mechanism_fits_the_picture_after_the_window_has_become_narrow(opened, tmp_path):
    reader = opened(write(result(), tmp_path))
    reader.look_at("mechanism")
    reader.page.set_viewport_size({"width": 390, "height": 800})
    reader.settle()
    slider = SEEN.replace("PLACES", json.dumps([[170.0, 0.0, 0.0]]))
    ((across, _),) = reader.plot("mechanism", slider)
    assert 0 < across < reader.plot("mechanism", "plot.clientWidth")


def test_arrows_are_not_cut_at_the_edge_of_the_picture(opened: Callable[..., Any], tmp_path: Path) -> None:
    reader = opened(write(result(), tmp_path))
    reader.look_at("mechanism")
    ends = """(() => {
      const { points } = plot.plotted.solids[2];
      const matrix = plot.plotted.camera.matrix(plot.plotted.wide());
      const places = Array.from({ length: points.length / 3 }, (_, k) => points.slice(3 * k, 3 * k + 3));
      const seen = places.map(place => plot.plotted.project(matrix, place));
      const of = (k) => seen.map(place => place[k]);
      const beyond = (k, size) => Math.max(-Math.min(...of(k)), Math.max(...of(k)) - size);
      return Math.max(beyond(0, plot.clientWidth), beyond(1, plot.clientHeight));
    })()"""
    for frame in range(0, N, N // 8):
        reader.go_to_frame(frame)
        assert reader.plot("mechanism", ends) < 0
