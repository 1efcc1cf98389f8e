"""The workbench in a browser: from the move of a slider to the picture, and what the page itself weighs.

WebGL is drawn in software, as where there is no graphics card. A slider that moves back and forth comes to
places where it has been, whose runs the server still has; what it shows for the first time is told apart.
"""

from __future__ import annotations

import os
import shutil
import time
from typing import Any, Final
from urllib.parse import urlsplit

import numpy as np
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, Response, sync_playwright

from benchmarks.program.workbench_hands import KEY, PER_SECOND

BROWSER: Final = os.environ.get("TRIBODYN_BROWSER") or shutil.which("chromium") or "chromium"
#: WebGL alone in software: a page put together in software by it, too, costs a third more.
OPTIONS: Final = ("--no-sandbox", "--use-angle=swiftshader-webgl", "--enable-unsafe-swiftshader")
#: Ends in a truth: a run that it returned would be held by Playwright.
DRAWN: Final = "() => typeof pageState === 'object' && pageState.shown && !requests.awaited"
DRAG: Final = """async ([key, apart, seconds]) => {
  const slider = controlAt(key).querySelector("input[type=range]");
  const moved = new Map();
  const pictures = [];
  const say = line.say;
  let input = 0;
  line.say = (message) => {
    if (message.type === "run") moved.set(message.number, input);
    return say(message);
  };
  let decoding = 0;
  const decode = runOf;
  runOf = (buffer) => {
    const begun = performance.now();
    const run = decode(buffer);
    decoding = performance.now() - begun;
    return run;
  };
  const known = new Set([pageState.shown.run]);
  const show = pageState.show;
  pageState.show = (run) => {
    const begun = performance.now();
    show(run);
    const drawn = performance.now();
    // What was drawn is on the screen when the next picture of it begins.
    const parts = [1e3 * run.seconds, decoding, drawn - begun, known.has(run.run) ? 0 : 1e3];
    known.add(run.run);
    requestAnimationFrame(() => pictures.push([performance.now() - moved.get(run.number), ...parts]));
  };
  slider.focus();
  const begin = performance.now();
  while (performance.now() - begin < 1000 * seconds) {
    const place = 0.68 + 0.3 * Math.sin((0.7 * (performance.now() - begin)) / 1000);
    slider.value = Number(slider.min) + place * (slider.max - slider.min);
    input = performance.now();
    slider.dispatchEvent(new Event("input"));
    await new Promise((done) => setTimeout(done, apart));
  }
  slider.dispatchEvent(new Event("change"));
  return pictures;
}"""


def measured(address: str, begun: float, seconds: float) -> dict[str, dict[str, float]]:
    """Open the page in a browser, look at it, and drag a slider whose pictures are in sight.

    Parameters
    ----------
    address
        Of a workbench, with its key.
    begun
        When its command was given [s since 1970].
    seconds
        How long it is dragged.
    """
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=BROWSER, args=list(OPTIONS))
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        answers: list[Response] = []
        page.on("response", lambda answer: answers.append(answer))
        page.goto(address)
        page.wait_for_function(DRAWN, timeout=600_000)
        first = time.time() - begun
        # Once more, for a page that was left does not tell what it was sent.
        loaded = len(answers)
        page.reload()
        page.wait_for_function(DRAWN, timeout=600_000)
        asked = [answer for answer in answers if answer.url.startswith(("http:", "https:"))]
        own = [answer for answer in asked if urlsplit(answer.url).netloc == urlsplit(address).netloc]
        about = {
            "first picture after the command [s]": first,
            "without pictures [kB]": sum(len(answer.body()) for answer in own if answer in answers[loaded:])
            / 1e3,
            "requests to another origin": float(len(asked) - len(own)),
            "serious faults by axe": float(_faults(page)),
        }
        pictures = np.array(page.evaluate(DRAG, [KEY, 1000.0 / PER_SECOND, seconds]))
        browser.close()
    return {"page": about, "drag in a browser": _told(pictures, seconds)}


def _faults(page: Page) -> int:
    found = Axe().run(page).response["violations"]
    return sum(fault["impact"] in ("serious", "critical") for fault in found)


def _told(pictures: Any, seconds: float) -> dict[str, float]:
    whole, run, decoding, drawing, new = pictures.T / 1e3
    first_time = whole[new > 0.0]
    return {
        "input to picture, median [s]": float(np.median(whole)),
        "95 % [s]": float(np.quantile(whole, 0.95)),
        "pictures a second": whole.size / seconds,
        "never shown before": first_time.size / whole.size,
        "median of these [s]": float(np.median(first_time)),
        "95 % of these [s]": float(np.quantile(first_time, 0.95)),
        "run, median [s]": float(np.median(run)),
        "decoding, median [s]": float(np.median(decoding)),
        "drawing, median [s]": float(np.median(drawing)),
    }
