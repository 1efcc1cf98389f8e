"""A real browser, and pages of short runs for it to open.

The browser is the system's Chromium, driven by Playwright. Where it is missing the tests are left out with a
line that says so, except in continuous integration (CI=true), where that is a failure. TRIBODYN_BROWSER names
another one; the system's Firefox, too, which draws with WebGL where there is a display (xvfb-run is one).
"""

import os
import shutil
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import xarray as xr
from playwright.sync_api import Browser, ConsoleMessage, Page, Playwright, Request, sync_playwright

sys.path.insert(0, str(Path(__file__).parents[2]))
import tribodyn as td
from benchmarks.program.workbench_page import OPTIONS
from tribodyn.figures.chart import save
from tribodyn.papers.cheng_2022.reduced.figures import FIGURES
from tribodyn.report import write

NAMES = ("chromium", "chromium-browser", "google-chrome")
NO_WEBGL = """const all = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
  return kind.startsWith('webgl') ? null : all.call(this, kind, ...more);
};"""
# The style that Playwright writes into a page of Firefox to take a picture; the page's policy refuses it.
OF_PICTURES = "sha256-YjaKGiklmzC6wjXA513HAMmzus8VE61XCOT+SmwNZWA="
SCREENSHOTS = Path(os.environ.get("TRIBODYN_SCREENSHOTS", Path(__file__).parents[2] / "out" / "screenshots"))
STILLS = ("motion", "trajectory")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker(pytest.mark.browser)


def _executable() -> str:
    named = os.environ.get("TRIBODYN_BROWSER")
    found = next((path for path in [named, *map(shutil.which, NAMES)] if path), None)
    if found is None:
        message = f"NO BROWSER: none of {', '.join(NAMES)} is installed; see tools/ensure-browser"
        if os.environ.get("CI") == "true":
            pytest.fail(message)
        pytest.skip(message)
    return found


# Playwright holds the event loop of the process as long as it runs, and other tests want one of their own.
@pytest.fixture(scope="package")
def browser() -> Iterator[Browser]:
    """The system's Chromium, one for all tests of this folder."""
    path = _executable()
    with sync_playwright() as playwright:
        launched = _launched(playwright, path)
        yield launched
        launched.close()


def _launched(playwright: Playwright, path: str) -> Browser:
    if "firefox" not in Path(path).name:
        return playwright.chromium.launch(executable_path=path, args=list(OPTIONS))
    # Playwright's own Firefox speaks a protocol of its own, everybody else's WebDriver BiDi.
    return playwright.firefox.launch(
        executable_path=path,
        channel="moz-firefox",
        headless="DISPLAY" not in os.environ,
        firefox_user_prefs={"webgl.force-enabled": True},
    )


def by_bidi(browser: Browser | None) -> bool:
    """Tell whether this is Firefox, to which Playwright speaks by WebDriver BiDi, and not as well."""
    return browser is not None and browser.browser_type.name == "firefox"


@pytest.fixture
def emulating(browser: Browser) -> None:
    """Leave a test out in Firefox, which Playwright cannot have pretend by WebDriver BiDi."""
    if by_bidi(browser):
        pytest.skip("dark colours, paper, no scripts, double clicks: not by WebDriver BiDi")


class Watched:
    """What a page said and asked for while it was open."""

    def __init__(self, page: Page) -> None:
        self.faults: list[str] = []
        self.requests: list[str] = []
        page.on("console", self._hear)
        page.on("pageerror", lambda error: OF_PICTURES in str(error) or self.faults.append(str(error)))
        page.on("request", self._note)

    def _hear(self, message: ConsoleMessage) -> None:
        if message.type == "error":
            self.faults.append(message.text)

    def _note(self, request: Request) -> None:
        if not request.url.startswith(("data:", "blob:")):
            self.requests.append(request.url)


class Reader:
    """A person who reads a page."""

    def __init__(self, page: Page) -> None:
        self.page = page

    def draw_everything(self) -> None:
        """Scroll through the page until every figure of it is drawn."""
        page = self.page
        shown = page.locator("figure:not([hidden]) [data-widget]")
        for name in shown.evaluate_all("all => all.map(one => one.dataset.name)"):
            page.locator(f"#{name}").scroll_into_view_if_needed()
            page.wait_for_function(
                "name => document.querySelector(`#${name} .plot`)?.plotted", arg=name, timeout=300_000
            )
        page.evaluate("scrollTo(0, 0)")
        self.settle()

    def look_at(self, name: str) -> None:
        """Scroll to a figure and wait until it is drawn."""
        self.page.locator(f"#{name}").scroll_into_view_if_needed()
        self.page.wait_for_function(
            "name => document.querySelector(`#${name} .plot`)?.plotted", arg=name, timeout=300_000
        )

    def go_to_frame(self, frame: int) -> None:
        """Move the time slider, and wait for the pictures that follow."""
        move = "(slider, frame) => { slider.value = frame; slider.dispatchEvent(new Event('input')); }"
        self.page.locator(".clock input").evaluate(move, frame)
        self.settle()

    def settle(self) -> None:
        """Wait until the figures have followed."""
        self.page.evaluate("() => new Promise(done => requestAnimationFrame(() => setTimeout(done, 200)))")

    def plot(self, name: str, path: str) -> Any:
        """Return an expression of `plot`, the element of a figure, whose `plotted` says what is drawn."""
        text = f"name => {{ const plot = document.querySelector(`#${{name}} .plot`); return {path}; }}"
        return self.page.evaluate(text, name)

    def colours(self, name: str, places: str) -> list[list[int]]:
        """Return red, green and blue at places of a figure: an expression of `plot`, [[x, y], ...] in px."""
        text = """name => {
          const plot = document.querySelector(`#${name} .plot`);
          const sheet = document.createElement('canvas');
          [sheet.width, sheet.height] = [plot.clientWidth, plot.clientHeight];
          const pen = sheet.getContext('2d', {willReadFrequently: true});
          pen.fillStyle = getComputedStyle(plot.closest('figure')).backgroundColor;
          pen.fillRect(0, 0, sheet.width, sheet.height);
          // A graphics card forgets its picture after the moment in which it was drawn.
          if (plot.plotted.draw) plot.plotted.draw();
          const {width, height} = sheet;
          for (const one of plot.querySelectorAll('canvas')) pen.drawImage(one, 0, 0, width, height);
          const colour = (x, y) => [...pen.getImageData(Math.round(x), Math.round(y), 1, 1).data];
          return PLACES.map(place => colour(...place).slice(0, 3));
        }""".replace("PLACES", places)
        found: list[list[int]] = self.page.evaluate(text, name)
        return found

    def overflow(self) -> int:
        """Return by how many pixels the page is wider than the window."""
        wide = "document.documentElement.scrollWidth - document.documentElement.clientWidth"
        return int(self.page.evaluate(wide))

    def keep_picture(self, name: str) -> None:
        """Keep a picture of the whole page where CI finds it."""
        SCREENSHOTS.mkdir(parents=True, exist_ok=True)
        self.page.screenshot(path=SCREENSHOTS / f"{name}.png", full_page=True)


@pytest.fixture
def opened(browser: Browser) -> Iterator[Callable[..., Reader]]:
    """Return an opener of pages; at the end no page may have complained or asked for anything but itself."""
    contexts, watched = [], []

    def open_page(
        path: Path,
        *,
        width: int = 1280,
        dark: bool = False,
        phone: bool = False,
        elsewhere: bool = False,
        webgl: bool = True,
        moving: bool = False,
    ) -> Reader:
        context = browser.new_context(
            viewport={"width": width, "height": 800},
            color_scheme="dark" if dark else "light",
            has_touch=phone,
            is_mobile=phone,
            reduced_motion="no-preference" if moving else "reduce",
        )
        contexts.append(context)
        page = context.new_page()
        if not webgl:
            page.add_init_script(NO_WEBGL)
        watched.append((path, Watched(page), elsewhere))
        page.goto(path.as_uri())
        if page.locator("#page-data").count():
            page.wait_for_selector("html.alive")
        return Reader(page)

    yield open_page
    for context in contexts:
        context.close()
    for path, heard, may_leave in watched:
        assert heard.faults == []
        asked = {url.partition("#")[0] for url in heard.requests}
        # Following a link to another page of the same folder is no request of the page.
        allowed = path.parent.as_uri() if may_leave else path.as_uri()
        assert all(url.startswith(allowed) for url in asked)


@pytest.fixture(scope="session")
def result() -> xr.Dataset:
    """A run over the first reversal of the vane mechanism."""
    return td.simulate(td.load_case("vsv").replace({"run.duration": "3.3 s"}))


@pytest.fixture(scope="session")
def report(result: xr.Dataset, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page of that run."""
    folder = tmp_path_factory.mktemp("run")
    stills = [save(FIGURES[name].draw(result), folder, name) for name in STILLS]
    return write(result, folder, stills)
