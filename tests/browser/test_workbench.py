"""The workbench in a real browser, with a server in a process of its own: one for all tests."""

from __future__ import annotations

import json
import random
import signal
import subprocess
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Locator, StorageState, WebSocketRoute
from tests.unit.workbench.host import TRIBODYN

from tribodyn.cases.units import to_si
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.mechanisms.results import summarise

from .conftest import NO_WEBGL, Reader, Watched, by_bidi

#: Time within which everything must have happened, on a machine that does other things too [ms].
SOON = 300_000.0
CASE = ["vsv", "--set", "run.duration=6.5 s"]
CLEARANCE = "joint.clearance"
TIMES = ("wall_time_s", "real_time_factor")
PAGE_BYTES = 300_000  #: Promised: what a browser loads before the first run, without pictures.


class Workbench:
    """A server that runs, and the cookie that its one key was traded for."""

    def __init__(self, address: str) -> None:
        self.entrance = address
        self.address = address.partition("?")[0]
        self.state: StorageState | None = None


@pytest.fixture(scope="module")
def server() -> Iterator[Workbench]:
    """A workbench of a run of one drive cycle."""
    with serving(CASE) as found:
        yield found


@contextmanager
def serving(case: Sequence[str]) -> Iterator[Workbench]:
    """Have a workbench of a case."""
    command = [*TRIBODYN, "workbench", *case, "--json", "--no-browser", "--workers", "1"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    try:
        told = "".join(iter(process.stdout.readline, "}\n")) + "}"
        yield Workbench(json.loads(told)["address"])
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(20.0)
        process.stdout.close()


class Person(Reader):
    """Somebody at a workbench."""

    def shown(self) -> Any:
        """Return what is said of the run that is drawn."""
        return self.page.evaluate("({...pageState.shown, sections: null, clock: null})")

    def wait_for(self, truth: str) -> None:
        self.page.wait_for_function(f"() => {truth}", timeout=SOON)

    def wait_until_shown(self, values: dict[str, str]) -> None:
        """Wait until the run with some values is drawn, and nothing else is waited for."""
        self.wait_for(
            "pageState.shown && !requests.awaited && "
            f"sameValues(pageState.shown.values, {json.dumps(values)})"
        )

    def control(self, key: str) -> Any:
        return self.page.locator(f".control[data-key='{key}']")

    def classes(self, key: str) -> list[str]:
        return str(self.control(key).get_attribute("class")).split()

    def slider(self, key: str = CLEARANCE) -> Any:
        return self.control(key).locator("input[type=range]")

    def type_into(self, key: str, text: str) -> None:
        entry = self.control(key).locator(".entry")
        entry.fill(text)
        entry.press("Enter")

    def press(self, *keys: str) -> None:
        for key in keys:
            self.page.keyboard.press(key)

    def click_twice(self, place: Locator) -> None:
        """Double click; by BiDi two clicks stay two, though not those of a mouse."""
        if by_bidi(self.page.context.browser):
            place.dispatch_event("dblclick")
        else:
            place.dblclick()

    def faults(self) -> list[str]:
        """Return what axe-core calls serious or worse."""
        return [
            f"{fault['id']}: {node['html'][:160]}"
            for fault in Axe().run(self.page).response["violations"]
            if fault["impact"] in ("serious", "critical")
            for node in fault["nodes"]
        ]


Opened = Callable[..., Person]
Delayed = list[tuple[WebSocketRoute, str | bytes]]  #: Messages to pages, in their order.


@pytest.fixture
def at(browser: Browser, server: Workbench) -> Iterator[Opened]:
    """Return an opener of workbenches; at the end none may have complained or asked for another origin."""
    contexts, heard = [], []

    def open_page(
        fragment: str = "",
        *,
        width: int = 1280,
        dark: bool = False,
        webgl: bool = True,
        moving: bool = False,
        line: Any = None,
        server: Workbench = server,
    ) -> Person:
        context = browser.new_context(
            viewport={"width": width, "height": 800},
            color_scheme="dark" if dark else "light",
            reduced_motion="no-preference" if moving else "reduce",
            storage_state=server.state,
            permissions=["clipboard-read", "clipboard-write"],
        )
        contexts.append(context)
        page = context.new_page()
        if server.state is None:
            page.goto(server.entrance)
            page.wait_for_url(server.address)
            server.state = context.storage_state()
        heard.append((server, Watched(page)))
        if not webgl:
            page.add_init_script(NO_WEBGL)
        if line is not None:
            page.route_web_socket("**/socket?*", line)
        page.goto("about:blank")
        page.goto(server.address + fragment)
        return Person(page)

    yield open_page
    for context in contexts:
        context.close()
    for server, one in heard:
        assert one.faults == []
        assert all(url.startswith((server.address, "about:")) for url in one.requests)


def test_the_first_picture_is_of_the_case(at: Opened) -> None:
    person = at()
    person.wait_until_shown({})
    person.look_at("orbit")
    assert "the case as it is" in person.page.locator("#whose").inner_text()
    assert person.colours("orbit", ON_MARKS) == [[0, 114, 178], [27, 29, 31], [192, 74, 0]]
    person.look_at("mechanism")
    assert person.plot("mechanism", "plot.plotted.gl instanceof WebGL2RenderingContext")
    assert person.overflow() == 0
    first = person.page.locator(".live-numbers tbody tr").first
    expected = person.page.evaluate("pageState.hello.results[0].label")
    assert first.locator("th").inner_text() == expected
    person.keep_picture("workbench")


ON_MARKS = "[plot.plotted].flatMap(({now, x, y}) => now.map(([a, b]) => [x.at(a), y.at(b)]))"


def test_the_mechanism_moves_until_a_value_is_changed(at: Opened) -> None:
    person = at(moving=True)
    person.wait_until_shown({})
    person.wait_for("clock.playing && clock.frame > 3")
    person.slider().focus()
    person.press("Home")
    person.wait_until_shown({CLEARANCE: "5 um"})
    person.wait_for("!clock.playing")
    person.page.locator(".clock [data-play]").click()
    person.press("End")
    person.wait_for("clock.playing")


def test_the_page_is_small(at: Opened) -> None:
    sizes: list[int] = []
    person = at()
    person.wait_until_shown({})
    person.page.on("response", lambda answer: sizes.append(len(answer.body())))
    person.page.reload()
    person.wait_until_shown({})
    assert len(sizes) > 20
    assert sum(sizes) <= PAGE_BYTES


def test_a_drag_shows_runs_with_their_own_values(at: Opened) -> None:
    person = at()
    person.wait_until_shown({})
    person.look_at("orbit")
    person.page.evaluate(
        """() => {
          window.seen = [];
          pageState.on('shown', () => requestAnimationFrame(() => seen.push([
            pageState.shown.values['joint.clearance'] ?? '20 um',
            document.getElementById('whose').textContent,
            document.querySelector('#orbit .plot').plotted.data.clearance,
            pageState.shown.results.vane_angle_error_rms_deg,
          ])));
        }"""
    )
    # Where the machine does other things too, the hand moves until it has seen two.
    _drag(person, 0.39, 0.75, until="new Set(seen.map(([value]) => value)).size > 1")
    person.wait_for("!requests.awaited && pageState.past.length === 1")
    requested = person.page.evaluate("pageState.values['joint.clearance']")
    person.wait_until_shown({CLEARANCE: requested})
    seen = person.page.evaluate("seen")
    assert len({value for value, *_ in seen}) >= 2
    for value, words, circle, _ in seen:
        assert f"{float(value.removesuffix(' um')):g}" == f"{circle:g}"
        assert value == "20 um" or f"joint.clearance = {value}" in words
    # A wider clearance lets the vane stray farther: 2 µm make 8 % of it, rounding nothing.
    errors = [error for value, _, _, error in sorted(seen, key=lambda one: float(one[0][:-3]))]
    assert errors == sorted(errors)
    assert person.slider().get_attribute("aria-valuetext") == requested
    assert "changed" in person.classes(CLEARANCE)
    person.page.get_by_role("button", name="Undo").click()
    person.wait_until_shown({})
    person.page.get_by_role("button", name="Redo").click()
    person.wait_until_shown({CLEARANCE: requested})
    person.click_twice(person.control(CLEARANCE).locator("label"))
    person.wait_until_shown({})
    assert "changed" not in person.classes(CLEARANCE)
    assert person.control(CLEARANCE).locator(".entry").input_value() == "20 um"


def _drag(
    person: Person, begin: float, end: float, steps: int = 12, key: str = CLEARANCE, until: str = "true"
) -> None:
    """Drag a slider between two shares of its length, back and forth until something is true."""
    box = person.slider(key).bounding_box()
    y = box["y"] + 0.5 * box["height"]
    mouse = person.page.mouse
    mouse.move(box["x"] + begin * box["width"], y)
    mouse.down()
    for step in range(100 * steps):
        share = abs((step + steps) % (2 * steps) - steps) / steps
        mouse.move(box["x"] + (begin + (end - begin) * share) * box["width"], y)
        person.page.wait_for_timeout(60)
        if step % (2 * steps) == steps and person.page.evaluate(until):
            break
    mouse.up()


@pytest.mark.parametrize(
    ("case", "key", "figure"),
    [
        (["journal-oil", "--set", "run.duration=0.01 s"], "joints.bearing.clearance.radial", "orbits"),
        pytest.param(
            ["slider-crank", "--set", "run.duration=6 ms"],
            "joints.wrist.clearance.radial",
            "orbits",
            marks=pytest.mark.long,
        ),
    ],
    ids=["journal", "mechanism"],
)
def test_every_kind_of_mechanism_has_its_workbench(at, case, key, figure):
    with serving(case) as server:
        person = at(width=400, server=server)
        person.wait_until_shown({})
        assert person.overflow() == 0
        _drag(person, 0.39, 0.75, steps=3, key=key)
        person.wait_for("!requests.awaited && pageState.past.length === 1")
        requested = person.page.evaluate("pageState.values")
        person.wait_until_shown(requested)
        assert person.page.evaluate("location.hash") == f"#{key}={requested[key].replace(' ', '')}"
        person.look_at(figure)
        value = float(requested[key].removesuffix(" um"))
        # What was drawn while it was off the screen is drawn anew a moment after it came.
        person.wait_for(f"document.querySelector('#{figure} .plot').plotted.data.clearance === {value}")
        # The first picture shines through.
        assert 20.0 in person.plot(figure, "plot.plotted.ghosts.map(({data}) => data.clearance)")
        person.draw_everything()
        assert person.page.locator("#views figure:visible:not(:has(canvas, table))").count() == 0
        assert person.faults() == []
        person.keep_picture(f"workbench-{case[0]}")
        person.page.close()


STAGE = "document.querySelector('#mechanism .plot').plotted"
CRANK = """
case = "mechanism"
title = "Crank"
parameters.length = "50 mm"
[bodies.crank]
shape = "rod"
start = "0, 0, 0 mm"
end = ["length", "0 mm", "0 mm"]
radius = "5 mm"
density = "7850 kg/m^3"
[joints.main]
type = "revolute"
between = ["ground", "crank"]
point = "0, 0, 0 mm"
axis = [0, 0, 1]
[drives.motor]
joint = "main"
speed = "600 rpm"
[run]
cycles = 1
output_interval = "5 ms"
"""


def test_a_slider_of_a_parameter_moves_the_mechanism(at: Opened, tmp_path: Path) -> None:
    file, key = tmp_path / "crank.toml", "parameters.length.value"
    file.write_text(CRANK)
    reach = "Math.max(...plot.plotted.solids.map((solid) => Math.max(...solid.points)))"
    with serving([str(file)]) as server:
        person = at(server=server)
        person.wait_until_shown({})
        person.look_at("mechanism")
        assert person.plot("mechanism", reach) == pytest.approx(50.0)
        _drag(person, 0.3, 0.8, steps=3, key=key)
        person.wait_for("!requests.awaited && pageState.past.length === 1")
        requested = person.page.evaluate("pageState.values")
        person.wait_until_shown(requested)
        length = float(requested[key].removesuffix(" mm"))
        assert length != 50.0
        person.wait_for(f"Math.abs({reach.replace('plot.plotted', STAGE)} - {length}) < 1e-3")
        person.page.close()


SOLID = """\
shape = "rod"
start = "0, 0, 0 mm"
end = ["length", "0 mm", "0 mm"]
radius = "5 mm"
density = "7850 kg/m^3"
"""
MASSIVE = """\
mass = "weight"
centre = ["length / 2", "0 mm", "0 mm"]
inertia = "1e-4, 1e-3, 1e-3 kg m^2"
"""
#: A crank whose mass follows a parameter.
DEPENDENT = CRANK.replace("[bodies", 'parameters.weight = "1 kg"\n[bodies', 1).replace(SOLID, MASSIVE)
WEIGHT, MASS, LENGTH = "parameters.weight.value", "bodies.crank.mass", "parameters.length.value"
BOXES = """() => Object.fromEntries([...document.querySelectorAll(".control")].map((box) => [
  box.dataset.key,
  [
    box.querySelector(".entry").value,
    box.querySelector(".fault").hidden,
    pageState.controls.get(box.dataset.key).unit,
  ],
]))"""
#: Values that are typed; some of them are refused.
EDITS = (
    (WEIGHT, "2 kg"),
    (WEIGHT, "-1 kg"),
    (LENGTH, "60 mm"),
    (WEIGHT, "nonsense"),
    (WEIGHT, "3 kg"),
    (LENGTH, "2 kg"),
    (WEIGHT, "0 kg"),
    (LENGTH, "45 mm"),
)


def _boxes_are_what_was_run(person: Person, file: Path) -> None:
    """Compare every box with the case that the page says was run; a refused text alone may differ."""
    shown = person.shown()
    case = load_case(file).replace(shown["values"])
    refused = person.page.evaluate(
        "[...document.querySelectorAll('.control[data-refused]')].map((box) => box.dataset.key)"
    )
    boxes = person.page.evaluate(BOXES)
    said = [key for key, (_, sound, _) in boxes.items() if not sound]
    assert not refused or said or person.page.locator("#error").is_visible()
    for key, (text, _, unit) in boxes.items():
        if key not in refused and unit and isinstance(value := case.at(key), float):
            assert to_si(text, unit) == pytest.approx(value, rel=1e-9), key


@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.long) for seed in (1, 2))])
def test_a_box_shows_what_was_run_after_random_edits(at: Opened, tmp_path: Path, seed: int) -> None:
    file, chance = tmp_path / "crank.toml", random.Random(seed)
    file.write_text(DEPENDENT)
    with serving([str(file)]) as server:
        person = at(server=server)
        person.wait_until_shown({})
        person.page.locator("#all-keys").click()
        steps = [*EDITS, *(chance.choice([*EDITS, "u", "u", "r"]) for _ in range(12)), (WEIGHT, "4 kg")]
        for step in steps:
            if isinstance(step, str):
                person.page.evaluate("document.activeElement.blur()")
                person.press(step)
            else:
                person.type_into(*step)
            person.page.wait_for_timeout(50)
            person.wait_for("!requests.awaited")
            _boxes_are_what_was_run(person, file)
        # Once a value is run nothing refused is left, neither texts nor what was said of them.
        boxes = person.page.evaluate(BOXES)
        assert [key for key, (_, sound, _) in boxes.items() if not sound] == []
        assert boxes[MASS][0] == "4 kg"
        person.page.close()


def test_what_cannot_be_is_said_beside_its_box(at: Opened) -> None:
    person = at()
    person.wait_until_shown({})
    before = person.shown()["run"]
    person.type_into(CLEARANCE, "40 mN")
    fault = person.control(CLEARANCE).locator(".fault")
    fault.wait_for(timeout=SOON)
    assert "not a unit of length" in fault.inner_text()
    assert person.control(CLEARANCE).locator(".entry").input_value() == "40 mN"
    assert person.shown()["run"] == before
    assert person.page.evaluate("[pageState.values, pageState.past.length]") == [{}, 0]
    person.type_into(CLEARANCE, "0.04 mm")
    person.wait_until_shown({CLEARANCE: "40 um"})
    assert not fault.is_visible()
    assert person.slider().input_value() == "40"
    # Without its space this would be another number.
    person.type_into("asperities.density", "0.05 1/um^2")
    values = {CLEARANCE: "40 um", "asperities.density": "0.05 1/um^2"}
    person.wait_until_shown(values)
    person.page.reload()
    person.wait_until_shown(values)


def test_a_pinned_run_stays_behind_with_differences(at: Opened) -> None:
    person = at()
    person.wait_until_shown({})
    person.look_at("orbit")
    person.press("p")
    person.slider().focus()
    person.press("Home")
    person.wait_until_shown({CLEARANCE: "5 um"})
    rms = person.page.locator("[data-row=vane_angle_error_rms_deg] td").nth(1).inner_text()
    pinned, now = person.page.evaluate(
        "[pageState.pins[0], pageState.shown].map(run => run.results.vane_angle_error_rms_deg)"
    )
    assert float(rms.replace("−", "-").removesuffix(" %")) == pytest.approx(
        100 * (now / pinned - 1), rel=0.06
    )
    assert person.plot("orbit", "plot.plotted.ghosts.map(ghost => ghost.data.clearance)") == [20.0]
    # Dashed: a point on it may lie between two dashes.
    around = "Array.from({length: 20}, (_, k) => 0.7 + 0.02 * k)"
    place = "[x.at(r * Math.cos(a)), y.at(r * Math.sin(a))]"
    given = "({x, y, ghosts: [{data: {clearance: r}}]})"
    circle = person.colours("orbit", f"[plot.plotted].flatMap({given} => {around}.map(a => {place}))")
    assert any(max(colour) < 200 for colour in circle)  # half as strong as the ink
    person.press("v")
    person.look_at("mechanism")
    faint = "plot.plotted.solids[1].colours.filter((_, n) => n % 4 === 3)[0]"
    assert person.plot("mechanism", faint) == 127  # half of 255: the trunnion of the pinned run


def test_a_run_that_fails_says_so_and_can_be_left(at: Opened) -> None:
    # With bodies that yield the program would look for a start among these first.
    person = at("#joint.clearance=30um&joint.bulk=none")
    values = {CLEARANCE: "30 um", "joint.bulk": "none"}
    person.wait_until_shown(values)
    person.type_into("loads.air_moment", "2000 N m")
    person.wait_for("pageState.shown.failure")
    trouble = person.page.locator("#error")
    assert "came closer than the contact law reaches" in trouble.inner_text()
    assert trouble.get_attribute("role") == "alert"
    person.keep_picture("workbench-failed")
    person.press("Escape", "u")
    person.wait_until_shown(values)
    assert not trouble.is_visible()


@pytest.mark.parametrize("by", ["pointer", "keyboard"])
def test_a_run_under_way_can_be_stopped(at: Opened, by: str) -> None:
    person = at("#joint.clearance=30um")
    person.wait_until_shown({CLEARANCE: "30 um"})
    stop = person.page.locator("#stop")
    assert not stop.is_visible()
    # Sixty cycles, to which somebody has agreed.
    person.page.evaluate("pageState.values = {'run.duration': '400 s'}; requests.send(true, true)")
    stop.wait_for(timeout=SOON)
    if by == "pointer":
        stop.click()
    else:
        person.press("Escape")
    person.wait_until_shown({CLEARANCE: "30 um"})
    assert not stop.is_visible()
    # The worker is free again.
    person.type_into(CLEARANCE, "31 um")
    person.wait_until_shown({CLEARANCE: "31 um"})


def test_while_the_server_works_the_page_says_so(at: Opened) -> None:
    lines: list[WebSocketRoute] = []
    runs: list[bytes] = []

    def line(route: WebSocketRoute) -> None:
        lines.append(route)
        server = route.connect_to_server()
        server.on_message(
            lambda message: keep(message) if isinstance(message, bytes) else route.send(message)
        )

    def keep(run: bytes) -> None:
        runs.append(run)
        words = {"type": "state", "state": "loading", "message": "loading the equations", "seconds": 60}
        lines[0].send(json.dumps(words))

    person = at(line=line)
    person.wait_for("server.message === 'loading the equations'")
    assert person.page.locator("#state").inner_text() == "loading the equations · about 60 s"
    assert person.control(CLEARANCE).is_visible()
    lines[0].send(runs[0])
    person.wait_until_shown({})


def test_before_something_long_it_asks(at: Opened) -> None:
    def line(route: WebSocketRoute) -> None:
        server = route.connect_to_server()

        def said(message: str | bytes) -> None:
            request = json.loads(message)
            if request["type"] == "run" and request["values"] and not request["agreed"]:
                question = {
                    "type": "ask",
                    "number": request["number"],
                    "seconds": 40,
                    "message": "takes 40 s",
                }
                route.send(json.dumps(question))
            else:
                server.send(message)

        route.on_message(said)

    person = at(line=line)
    person.wait_until_shown({})
    question = person.page.locator("#ask")
    for answer, requested in (("Leave it", {}), ("Run it", {CLEARANCE: "30 um"})):
        person.type_into(CLEARANCE, "30 um")
        question.wait_for(timeout=SOON)
        assert "takes 40 s" in question.inner_text()
        assert person.shown()["values"] == {}
        question.get_by_role("button", name=answer).click()
        person.wait_until_shown(requested)
        assert not question.is_visible()
        assert person.page.evaluate("pageState.values") == requested


def test_over_a_slow_line_the_last_request_is_shown_last(at: Opened) -> None:
    person, delayed = _over_a_line_held_up(at)
    _deliver(person, delayed, "pageState.shown")
    _drag(person, 0.39, 0.6, steps=4)
    _deliver(person, delayed, "!requests.awaited")
    shown, requested = person.page.evaluate("[pageState.shown.values, pageState.values]")
    assert shown == requested
    assert shown != {}


def test_a_picture_that_comes_late_does_not_take_away_why_a_request_was_refused(at: Opened) -> None:
    person, delayed = _over_a_line_held_up(at)
    _deliver(person, delayed, "pageState.shown && !requests.awaited")
    person.page.evaluate("pageState.gesture({'drive.speed_amplitude': '18 deg/s'})")
    while not any(isinstance(message, bytes) for _, message in delayed):
        person.page.wait_for_timeout(50)
    person.page.evaluate("pageState.gesture({'drive.speed_amplitude': '-45 deg/s'})")
    while not any('"refused"' in message for _, message in delayed if isinstance(message, str)):
        person.page.wait_for_timeout(50)
    delayed.sort(key=lambda one: isinstance(one[1], bytes))
    _deliver(person, delayed, "pageState.shown.values['drive.speed_amplitude'] === '18 deg/s'")
    assert "reaches only" in person.page.locator("#error").inner_text()
    person.press("u")
    _deliver(person, delayed, "!requests.awaited")
    assert not person.page.locator("#error").is_visible()


def _over_a_line_held_up(at: Opened) -> tuple[Person, Delayed]:
    """Return a page, and what is on its way there, which does not arrive by itself."""
    delayed: Delayed = []

    def line(route: WebSocketRoute) -> None:
        route.connect_to_server().on_message(lambda message: delayed.append((route, message)))

    return at(line=line), delayed


def _deliver(person: Person, delayed: Delayed, truth: str) -> None:
    """Bring what is on its way one by one, a little later each, until something is true."""
    for _ in range(600):
        person.page.wait_for_timeout(100)
        if delayed:
            route, message = delayed.pop(0)
            route.send(message)
        if not delayed and person.page.evaluate(f"Boolean(pageState.hello && ({truth}))"):
            return
    raise AssertionError(f"never: {truth}")


def test_a_line_that_breaks_is_taken_up_again(at: Opened) -> None:
    person = at("#joint.clearance=25um")
    person.wait_until_shown({CLEARANCE: "25 um"})
    # It may say so for less than a moment.
    person.page.evaluate(
        """() => {
          const state = document.getElementById("state");
          window.said = [];
          const heard = new MutationObserver(() => said.push(state.textContent));
          heard.observe(state, { childList: true, characterData: true, subtree: true });
          line.socket.close();
        }"""
    )
    person.wait_for("said.some((text) => text.includes('does not answer'))")
    person.wait_for("server.connected && !requests.awaited")
    person.wait_until_shown({CLEARANCE: "25 um"})


def test_without_webgl_it_draws_on_a_plain_canvas(at: Opened) -> None:
    person = at(webgl=False)
    person.wait_until_shown({})
    person.look_at("mechanism")
    assert person.plot("mechanism", "plot.plotted.gl") is None
    assert person.plot("mechanism", "plot.plotted.solids[0].corners.length") > 1000


@pytest.mark.parametrize(
    ("width", "dark"),
    [
        pytest.param(1280, False, id="wide-light"),
        pytest.param(400, True, id="narrow-dark"),
        # Colours do not follow the width.
        pytest.param(1280, True, id="wide-dark", marks=pytest.mark.long),
        pytest.param(400, False, id="narrow-light", marks=pytest.mark.long),
    ],
)
def test_axe_finds_nothing_serious(at: Opened, width: int, dark: bool) -> None:
    person = at("#joint.clearance=25um", width=width, dark=dark)
    person.wait_until_shown({CLEARANCE: "25 um"})
    person.press("p")
    person.page.locator("#search").fill("modulus")
    person.draw_everything()
    assert person.overflow() == 0
    assert person.faults() == []
    person.keep_picture(f"workbench-{width}-{'dark' if dark else 'light'}")
    person.page.locator("h1").click()
    person.press("?")
    assert person.faults() == []
    person.press("Escape")


def test_six_tasks_by_keyboard_alone(at: Opened) -> None:
    person = at()
    person.wait_until_shown({})
    _find_the_clearance_by_keyboard(person)
    _compare_materials_by_keyboard(person)
    _see_the_wear_by_keyboard(person)
    _reproduce(person, lambda: person.press("c"))
    _share(person, at)
    person.press("c")
    while person.page.evaluate("document.activeElement.textContent") != "report.html":
        person.press("Tab")
    _save(person, "report.html", lambda: person.press("Enter"))


def _find_the_clearance_by_keyboard(person: Person) -> None:
    """Sweep the clearance and walk along its points to the last one below 0.03°."""
    person.press("1", "s")
    person.wait_for("sweeps.get('joint.clearance')?.finished")
    points = person.page.evaluate("sweeps.get('joint.clearance').points")
    assert len(points) == 15
    good = [p for p in points if p["results"]["vane_angle_error_outside_deg"] < 0.03]
    person.press("[")
    while person.page.evaluate("pageState.text('joint.clearance')") != good[-1]["text"]:
        person.press("]")
        person.wait_for("!requests.awaited")
    person.wait_until_shown({} if good[-1]["text"] == "20 um" else {CLEARANCE: good[-1]["text"]})
    assert person.shown()["results"]["vane_angle_error_outside_deg"] < 0.03
    person.wait_for("slope.finished && slope.key === 'joint.clearance'")
    # The vane strays in proportion to the clearance less what the asperities fill: a little more than 1.
    slope = person.page.evaluate("slope.results.vane_angle_error_rms_deg.slope")
    assert 1.0 < slope < 1.6


def _compare_materials_by_keyboard(person: Person) -> None:
    person.press("p", "/")
    person.page.keyboard.type("bushing hardness")
    person.press("Tab")
    key = "surfaces.bushing.hardness"
    entry = person.control(key).locator(".entry")
    while not entry.evaluate("entry => entry === document.activeElement"):
        person.press("Tab")
    person.press("Control+a")
    person.page.keyboard.type("2 GPa")
    person.press("Enter")
    person.wait_for(f"!requests.awaited && pageState.shown.values['{key}']")
    difference = person.page.locator("[data-row=wear_depth_rate_nm_per_1000_cycles] td").nth(1).inner_text()
    assert difference.endswith("%")
    person.press("Escape")


def _see_the_wear_by_keyboard(person: Person) -> None:
    person.press("v")
    while not person.page.evaluate("document.activeElement.matches('#wear .plot')"):
        person.press("Tab")
    person.wait_for("document.querySelector('#wear .plot')?.plotted")
    peak = person.page.locator("#wear .readout").inner_text()
    person.press("ArrowLeft")
    assert f"peak {person.page.locator('#wear .readout').inner_text()}" == peak
    person.press("Escape")


def _reproduce(person: Person, open_dialog: Callable[[], None]) -> None:
    """Copy the run as Python, run it here: the same numbers to the bit."""
    open_dialog()
    person.page.get_by_role("button", name="Copy", exact=True).nth(1).click()
    person.wait_for("document.querySelector('#away').textContent.includes('Copied')")
    text = person.page.evaluate("navigator.clipboard.readText()")
    names: dict[str, Any] = {}
    exec(text, names)
    _same_numbers(person, summarise(names["result"]))
    person.press("Escape")


def _same_numbers(person: Person, again: Mapping[str, Any]) -> None:
    """Find the key results of the run shown, but for what it took."""
    for name, value in person.shown()["results"].items():
        assert name in TIMES or again[name] == value, name


def _share(person: Person, at: Opened) -> None:
    fragment = person.page.evaluate("location.hash")
    values = person.shown()["values"]
    other = at(fragment)
    other.wait_until_shown(values)
    assert other.shown()["run"] == person.shown()["run"]


def _save(person: Person, name: str, act: Callable[[], None]) -> None:
    with person.page.expect_download(timeout=SOON) as download:
        act()
    # By BiDi the file is in the person's own folder, beside earlier ones.
    if not by_bidi(person.page.context.browser):
        assert download.value.suggested_filename == name
        assert Path(download.value.path()).stat().st_size > 100_000
    person.press("Escape")


@pytest.fixture(scope="module")
def linkage() -> Iterator[Workbench]:
    """A workbench of a short run of a four-bar linkage."""
    with serving(["four-bar", "--set", "run.cycles=0.5"]) as found:
        yield found


def _edit(person: Person, act: str) -> None:
    """Press a button of the dialog of the model, and wait for the run of the edited model."""
    person.page.locator(f"#{act}-model").click()
    person.page.locator("#edit").wait_for(state="hidden", timeout=SOON)
    # A long run is asked about.
    person.wait_for("!requests.awaited && (pageState.shown || !document.getElementById('ask').hidden)")
    if person.page.locator("#ask").is_visible():
        person.page.locator("#ask [data-yes]").click()
    person.wait_for("pageState.shown && !requests.awaited")


def test_parts_are_removed_and_added_on_the_page(at: Opened, linkage: Workbench, tmp_path: Path) -> None:
    person = at(server=linkage)
    person.wait_for("pageState.shown && !requests.awaited")
    page, dialog = person.page, person.page.locator("#edit")
    person.press("m")
    assert person.faults() == []
    page.locator("#removed").select_option("joints.main")
    page.locator("#remove-model").click()
    page.locator("#edit-fault").wait_for(timeout=SOON)
    assert 'drives.motor.joint: given "main"; "main" is no joint' in page.locator("#edit-fault").inner_text()
    assert dialog.is_visible()
    page.locator("#removed").select_option("joints.coupler-pin.clearance")
    _edit(person, "remove")
    assert not person.control("joints.coupler-pin.clearance.radial").count()
    page.locator("#model").click()
    page.locator("#kind").select_option("joints.*.clearance")
    page.locator("#part-name").select_option("rocker-pivot")
    for field, text in {"radius": "6 mm", "radial": "30 um", "length": "12 mm"}.items():
        page.locator(f"#fields [data-field={field}]").fill(text)
    _edit(person, "add")
    assert person.control("joints.rocker-pivot.clearance.radial").is_visible()
    _same_after_loading_and_undo(person, at, linkage)
    _saved_file_runs(person, tmp_path)


def _same_after_loading_and_undo(person: Person, at: Opened, server: Workbench) -> None:
    other = at(person.page.evaluate("location.hash"), server=server)
    other.wait_for("pageState.shown && !requests.awaited")
    assert other.shown()["run"] == person.shown()["run"]
    person.press("u", "u")
    person.wait_until_shown({})
    assert person.control("joints.coupler-pin.clearance.radial").is_visible()
    person.press("r", "r")
    person.wait_for("pageState.shown && !requests.awaited && pageState.values[EDIT]")
    assert person.shown()["run"] == other.shown()["run"]


def _saved_file_runs(person: Person, folder: Path) -> None:
    person.press("m")
    with person.page.expect_download(timeout=SOON) as download:
        person.page.locator("#save-model").click()
    download.value.save_as(folder / "case.toml")
    case = load_case(folder / "case.toml")
    assert [name for name, joint in case.joints.items() if joint.clearance] == ["rocker-pivot"]


def test_a_template_is_started_from(at: Opened, linkage: Workbench) -> None:
    person = at(server=linkage, width=400)
    person.wait_for("pageState.shown && !requests.awaited")
    person.press("m")
    assert person.overflow() == 0
    first = "document.getElementById('first')"
    assert person.page.evaluate(f"{first}.scrollWidth - {first}.clientWidth") <= 0
    person.page.locator("#template").select_option("pendulum")
    _edit(person, "start")
    assert "Pendulum" in person.page.locator("h1").inner_text()
    assert person.page.evaluate("Object.keys(pageState.shown.sections)")


def test_of_an_address_with_unknown_keys_the_page_says_so(at: Opened) -> None:
    person = at("#joint.clearance=24um&joint.colour=red")
    person.wait_until_shown({CLEARANCE: "24 um"})
    assert "does not have" in person.page.locator("#error").inner_text()
    person.type_into(CLEARANCE, "25 um")
    person.wait_until_shown({CLEARANCE: "25 um"})
    assert not person.page.locator("#error").is_visible()
