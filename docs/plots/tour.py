"""Record a tour of the workbench, a minute long, as an animated picture for README and manual.

python docs/plots/tour.py docs/_static/tour.png
"""

from __future__ import annotations

import io
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

from PIL import Image
from playwright.sync_api import Page, sync_playwright

BROWSER: Final = os.environ.get("TRIBODYN_BROWSER") or shutil.which("chromium") or "chromium"
OPTIONS: Final = ("--no-sandbox", "--use-angle=swiftshader-webgl", "--enable-unsafe-swiftshader")
SIZE: Final = {"width": 1280, "height": 824}
SHOWN: Final = (885, 570)
COLOURS: Final = 256
KEY: Final = "joint.clearance"
OVERLAY: Final = """() => {
  const make = (id, style) => {
    const made = document.createElement("div");
    made.id = id;
    made.style.cssText = `position: fixed; z-index: 99; pointer-events: none; ${style}`;
    document.body.append(made);
  };
  make("hand", `width: 18px; height: 18px; margin: -9px; border-radius: 50%; border: 3px solid #c04a00;
    background: rgb(192 74 0 / 25%); left: 600px; top: 400px`);
  make("words", `left: 0; right: 0; bottom: 0; padding: 10px; text-align: center; font-size: 19px;
    line-height: 24px; color: #fff; background: rgb(20 30 45)`);
  document.querySelector("#results > .clock").style.bottom = "44px";
}"""


class Recorder:
    """Pictures of a page, and how long each is shown [ms]."""

    def __init__(self, page: Page) -> None:
        """Begin without pictures."""
        self.page = page
        self.pictures: list[Image.Image] = []
        self.times: list[int] = []

    def say(self, words: str) -> None:
        """Write words below the page."""
        self.page.evaluate("words => { document.getElementById('words').textContent = words; }", words)

    def take(self, milliseconds: int) -> None:
        """Take a picture once the run shown is the one requested."""
        self.page.wait_for_function("() => pageState.shown && !requests.awaited", timeout=600_000)
        self.page.wait_for_timeout(150)
        picture = Image.open(io.BytesIO(self.page.screenshot())).convert("RGB")
        self.pictures.append(picture.resize(SHOWN, Image.Resampling.LANCZOS))
        self.times.append(milliseconds)

    def move(self, x: float, y: float) -> None:
        """Move the hand."""
        self.page.mouse.move(x, y)
        style = f"left = '{x}px'", f"top = '{y}px'"
        self.page.evaluate("".join(f"document.getElementById('hand').style.{one};" for one in style))

    def click(self, name: str) -> None:
        """Press the first button of a name, with the hand on it."""
        button = self.page.get_by_role("button", name=name).first
        box = button.bounding_box()
        assert box is not None
        self.move(box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"])
        button.click()

    def save(self, target: str) -> None:
        """Write what was recorded."""
        width, height = SHOWN
        all_of_them = Image.new("RGB", (width, height * len(self.pictures)))
        for k, picture in enumerate(self.pictures):
            all_of_them.paste(picture, (0, k * height))
        # One palette for all, in which no colour of a curve is lost: what does not change is stored once.
        palette = all_of_them.quantize(COLOURS, method=Image.Quantize.MAXCOVERAGE)
        flat = [one.quantize(palette=palette, dither=Image.Dither.NONE) for one in self.pictures]
        flat[0].save(
            target, save_all=True, append_images=flat[1:], duration=self.times, loop=0, optimize=True
        )


@contextmanager
def workbench() -> Iterator[str]:
    """Have a workbench, and its address with the key."""
    command = [sys.executable, "-m", "tribodyn", "workbench", "--json", "--quiet"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            yield json.loads("".join(iter(process.stdout.readline, "}\n")) + "}")["address"]
        finally:
            process.terminate()


def tour(film: Recorder) -> None:
    """Go through what a person can do."""
    page = film.page
    slider = page.locator(f".control[data-key='{KEY}'] input[type=range]")
    film.say("The vane mechanism: each value has a slider")
    film.take(3000)
    film.say("Move a slider: mechanism, orbit, pressure and numbers follow")
    box = slider.bounding_box()
    assert box is not None
    y = box["y"] + 0.5 * box["height"]
    for share in (0.45, 0.55, 0.65, 0.75):
        # A press a step: on a busy machine runs are too long to be made in the middle of a drag.
        film.move(box["x"] + share * box["width"], y)
        page.mouse.down()
        page.mouse.up()
        film.take(900)
    film.take(1200)
    film.say("P pins the run: differences in percent, and its curves stay behind")
    page.keyboard.press("p")
    film.take(2500)
    film.say("A double click on the name: back to the case's value")
    page.locator(f".control[data-key='{KEY}'] label").dblclick()
    film.take(3000)
    film.click("Trunnion and bushing")
    film.say("The clearance magnified; the faint trunnion is that of the pinned run")
    film.take(3000)
    follow_time(film)
    sweep(film)
    film.say("An invalid value gets a message beside its box; the run stays")
    entry = page.locator(f".control[data-key='{KEY}'] .entry")
    entry.fill("40 mN")
    entry.press("Enter")
    film.take(3500)
    entry.press("Escape")
    film.say("Curves over time: hatched where a value depends on the motion before")
    page.locator("#contact-force").scroll_into_view_if_needed()
    film.take(3500)
    page.evaluate("scrollTo(0, 0)")
    film.say("C copies the run as a command or as Python, and saves files")
    page.keyboard.press("c")
    film.take(4000)
    page.keyboard.press("Escape")
    film.say("Dark if the system is; ? lists all keys")
    page.emulate_media(color_scheme="dark")
    film.take(3500)


def follow_time(film: Recorder) -> None:
    """Step through half a drive cycle."""
    film.say("One time for all figures: play, or step with , and .")
    for _ in range(7):
        for _ in range(8):
            film.page.keyboard.press(".")
        film.take(450)


def sweep(film: Recorder) -> None:
    """Sweep the clearance and look at its points."""
    page = film.page
    page.select_option("#points", "9")
    film.say("Sweep a key: the result is a curve above its slider")
    film.click("Sweep radial clearance")
    for count in (3, 6, 9):
        page.wait_for_function(f"() => sweeps.get('{KEY}').points.length >= {count}", timeout=600_000)
        film.take(900)
    film.say("Point at the curve: that run is shown")
    curve = page.locator(f".control[data-key='{KEY}'] canvas").bounding_box()
    assert curve is not None
    for share in (0.2, 0.45, 0.7, 0.97):
        film.move(curve["x"] + share * curve["width"], curve["y"] + 0.5 * curve["height"])
        film.take(1300)
    film.move(600.0, 300.0)
    page.locator(f".control[data-key='{KEY}'] input[type=range]").focus()
    page.wait_for_function(f"() => slope.key === '{KEY}' && slope.finished", timeout=600_000)
    page.evaluate("scrollTo(0, 0)")
    film.say("The key in focus: change of each number in percent, with its standard error")
    film.take(4000)


def main() -> None:
    """Record and save."""
    with workbench() as address, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=BROWSER, args=list(OPTIONS))
        page = browser.new_page(viewport=SIZE)
        page.goto(address)
        page.wait_for_function("() => typeof pageState === 'object' && pageState.shown", timeout=600_000)
        page.evaluate(OVERLAY)
        film = Recorder(page)
        tour(film)
        browser.close()
    film.save(sys.argv[1])
    print(f"{len(film.pictures)} pictures, {sum(film.times) / 1e3:.0f} s")


if __name__ == "__main__":
    main()
