"""What a person at the page of the workbench waits for: from the move of a slider to the picture.

python -m benchmarks.workbench_page [SECONDS]

Needs Chromium and Playwright; WebGL is drawn in software, as where there is no graphics card.
"""

from __future__ import annotations

import os
import shutil
import sys
from typing import Any, Final

import numpy as np
from playwright.sync_api import sync_playwright

from benchmarks.workbench import KEY, PER_SECOND, workbench

BROWSER: Final = os.environ.get("TRIBODYN_BROWSER") or shutil.which("chromium") or "chromium"
OPTIONS: Final = ("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
SECONDS: Final = 20.0
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
  const show = bench.show;
  bench.show = (run) => {
    const begun = performance.now();
    show(run);
    const drawn = performance.now();
    // What was drawn is on the screen when the next picture of it begins.
    requestAnimationFrame(() => pictures.push([performance.now() - moved.get(run.number), drawn - begun]));
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


def run(seconds: float = SECONDS) -> dict[str, dict[str, float]]:
    """Measure, print and return the drag of a slider whose pictures are in sight."""
    with workbench() as (_, address), sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=BROWSER, args=list(OPTIONS))
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        page.goto(address)
        page.wait_for_function(
            "() => typeof bench === 'object' && bench.shown && !wishes.awaited", timeout=600_000
        )
        pictures = np.array(page.evaluate(DRAG, [KEY, 1000.0 / PER_SECOND, seconds]))
        browser.close()
    found = {"drag in a browser": _told(pictures, seconds)}
    for name, row in found.items():
        print(f"{name}: " + ", ".join(f"{key} {value:.3g}" for key, value in row.items()), flush=True)
    return found


def _told(pictures: Any, seconds: float) -> dict[str, float]:
    whole, drawing = pictures.T / 1e3
    return {
        "input to picture, median [s]": float(np.median(whole)),
        "95 % [s]": float(np.quantile(whole, 0.95)),
        "pictures a second": whole.size / seconds,
        "drawing, median [s]": float(np.median(drawing)),
    }


if __name__ == "__main__":
    run(float(sys.argv[1]) if len(sys.argv) > 1 else SECONDS)
