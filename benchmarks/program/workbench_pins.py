"""The workbench in a browser for long: runs pinned and let go, sliders dragged, what the page keeps of it.

What the page holds is asked for after its rubbish was collected, by the protocol of Chromium.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

import numpy as np
from playwright.sync_api import CDPSession, Page, sync_playwright

from benchmarks.program.workbench_hands import line
from benchmarks.program.workbench_page import BROWSER, DRAWN, OPTIONS

PINS: Final = 3  #: Runs that are pinned at a time.
STEPS: Final = 40  #: Positions of the pointer in one gesture.
APART: Final = 0.04  #: Time between two of them [s].
#: Whether numbers are those of the run shown and requested, unless the page gives the reason why not.
OWN: Final = """() => {
  const whose = document.getElementById("whose").textContent;
  const { values } = pageState.shown;
  const refused = !document.getElementById("error").hidden;
  return whose.endsWith(valuesInWords(values)) && (refused || sameValues(values, pageState.values));
}"""
#: Size of the runs that the page keeps, some large and some small [bytes].
RUNS: Final = """() => {
  const { shown, trail, pins } = pageState;
  const buffers = [shown, ...trail, ...pins].map(({ clock }) => clock.time.buffer);
  return [...new Set(buffers)].reduce((size, buffer) => size + buffer.byteLength, 0);
}"""
_FIRST: Final = 10  #: Looks at the page before which it fills what it may keep.


def pinned(address: str, minutes: float, picture: Path | None = None) -> dict[str, float]:
    """Drag and pin for some minutes, and tell what became of the page.

    Parameters
    ----------
    address
        Of a workbench, with its key.
    minutes
        How long.
    picture
        Where a picture of the page at the end is to be written, if anywhere.
    """
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=BROWSER, args=list(OPTIONS))
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        faults: list[str] = []
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.on("console", lambda said: faults.append(said.text) if said.type == "error" else None)
        page.goto(address)
        page.wait_for_function(DRAWN, timeout=600_000)
        protocol = page.context.new_cdp_session(page)
        rows = np.array(list(_looks(page, protocol, 60.0 * minutes)))
        if picture is not None:
            page.screenshot(path=picture, full_page=True)
        browser.close()
    return {"minutes": minutes, "errors of the page": float(len(faults)), **_told(rows)}


def _looks(page: Page, protocol: CDPSession, seconds: float) -> Iterator[list[float]]:
    """Yield after each gesture time [s], what the page holds beside runs [MB], elements, strange values."""
    chance, begin = np.random.default_rng(0), time.perf_counter()
    sliders = page.locator("#first input[type=range]")
    while time.perf_counter() - begin < seconds:
        _drag(page, sliders.nth(int(chance.integers(sliders.count()))), float(chance.uniform(0.05, 0.95)))
        page.wait_for_function(DRAWN, timeout=600_000)
        own = page.evaluate(OWN)
        _pin(page)
        if page.locator("#error").is_visible():
            page.keyboard.press("u")
            page.wait_for_function(DRAWN, timeout=600_000)
        protocol.send("HeapProfiler.collectGarbage")
        held = protocol.send("Runtime.getHeapUsage")
        megabytes = (held["usedSize"] + held["backingStorageSize"] - page.evaluate(RUNS)) / 1e6
        nodes = protocol.send("Memory.getDOMCounters")["nodes"]
        yield [time.perf_counter() - begin, megabytes, float(nodes), float(not own)]


def _drag(page: Page, slider: Any, end: float) -> None:
    """Take a slider where it is and move it to a share of its track."""
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    share = "one => (one.value - one.min) / (one.max - one.min)"
    begin, level = slider.evaluate(share), box["y"] + 0.5 * box["height"]
    # The knob stands within the track: its middle never comes to the ends.
    places = box["x"] + 8.0 + np.linspace(begin, end, STEPS) * (box["width"] - 16.0)
    page.mouse.move(places[0], level)
    page.mouse.down()
    for place in places:
        page.mouse.move(place, level)
        time.sleep(APART)
    page.mouse.up()


def _pin(page: Page) -> None:
    """Pin the run that is shown, and let the oldest go where there are too many."""
    if page.evaluate("() => pageState.pins.every(({ run }) => run !== pageState.shown.run)"):
        page.keyboard.press("p")
    if page.evaluate("() => pageState.pins.length") > PINS:
        page.locator("#pins .pinned button", has_text="Let go").first.click()


def _told(rows: Any) -> dict[str, float]:
    times, held, nodes, strange = rows.T
    later = slice(min(_FIRST, len(rows) // 2), None)
    slope, error = line(times[later] / 3600.0, held[later])
    return {
        "gestures": float(len(rows)),
        "MB beside runs, at first": float(held[0]),
        "MB from then on": float(held[later][0]),
        "MB at last": float(held[-1]),
        "MB an hour": slope,
        "its standard error": error,
        "growth over its standard error": slope / error,
        "elements from then": float(nodes[later][0]),
        "elements at last": float(nodes[-1]),
        "numbers of other values than requested": float(strange.sum()),
    }
