"""Answers to the requests of a page, by a pool that only pretends to compute."""

from __future__ import annotations

import asyncio
import threading

import pytest
from tests.unit.workbench.host import SOON, Answer, Pretending, hosting, in_loop

from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.workbench import page_session
from tribodyn.workbench.messages import KEPT
from tribodyn.workbench.page_session import _UNHURRIED as UNHURRIED
from tribodyn.workbench.server_state import Rules
from tribodyn.workbench.variant import Origin
from tribodyn.workbench.worker_pool import Job

CLEARANCE = "joint.clearance"


def wide(micrometres: float) -> dict[str, str]:
    return {CLEARANCE: f"{micrometres:g} um"}


@in_loop
async def test_the_answer_names_its_values_and_the_command_that_makes_it() -> None:
    async with hosting() as host:
        page = await host.greeted()
        await page.run(7, {CLEARANCE: "0.037 mm", "contact.law": "gw"}, rest=True)
        answer = await page.picture()
        assert answer.number == 7
        assert answer.header["values"] == {CLEARANCE: "37 um", "contact.law": "gw"}
        # A law without a restitution of its own is left undamped, which nobody asked for.
        assert answer.header["follows"] == {"contact.damping_factor": "none"}
        assert (
            answer.header["command"] == "tribodyn run vsv --set 'joint.clearance=37 um' --set contact.law=gw"
        )
        place = answer.header["sections"]["one"]["x"]["f32"]
        assert place == [0, 2]


class Held(Pretending):
    """A pool whose runs go on when they are let."""

    def __init__(self) -> None:
        super().__init__()
        self.gate, self.begun = asyncio.Event(), asyncio.Event()
        self.gate.set()

    async def do(self, job: Job) -> bytes:
        self.begun.set()
        await self.gate.wait()
        return await super().do(job)


@in_loop
async def test_while_a_slider_is_dragged_runs_end_and_the_newest_request_is_next() -> None:
    pool = Held()
    async with hosting(pool) as host:
        page = await host.greeted()
        pool.made.clear()
        pool.begun.clear()
        pool.gate.clear()
        await page.run(0, wide(20))
        await pool.begun.wait()
        for number in range(1, 10):
            await page.run(number, wide(20 + number))
        await page.say("no kind of message")  # is answered after all before it were heard
        await page.until("error")
        pool.gate.set()
        answers = [await page.picture(), await page.picture()]
        assert [answer.number for answer in answers] == [0, 9]
        assert [answer.header["values"] for answer in answers] == [wide(20), wide(29)]
        assert len(pool.made) == 2
        assert pool.given_up == []


@in_loop
async def test_a_hand_at_rest_ends_what_is_under_way_for_other_values() -> None:
    pool = Pretending(seconds=0.5)
    async with hosting(pool) as host:
        page = await host.greeted()
        await page.run(1, wide(30))
        await asyncio.sleep(0.1)
        await page.run(2, wide(31), rest=True)
        assert (await page.picture()).number == 2
        assert [order["header"]["values"] for order in pool.given_up] == [wide(30)]


@in_loop
async def test_equal_cases_are_run_once_however_they_are_spelled() -> None:
    pool = Pretending()
    async with hosting(pool) as host:
        page = await host.greeted()
        found = []
        for number, text in enumerate(("25 um", "0.025 mm", "2.5e-5 m")):
            await page.run(number, {CLEARANCE: text}, rest=True)
            found.append(await page.picture())
        runs = [order for order in pool.made if order["header"]["values"] == wide(25)]
        assert len(runs) == 1
        assert [answer.flags for answer in found] == [0, KEPT, KEPT]
        assert len({answer.header["run"] for answer in found}) == 1


@in_loop
async def test_one_result_waits_for_a_page_that_has_not_drawn_and_it_is_the_newest() -> None:
    pool = Pretending()
    # On a busy machine the time in which a page should have drawn would pass.
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(page_session, "_UNDRAWN", SOON)
        await _one_waits(pool)


async def _one_waits(pool: Pretending) -> None:
    async with hosting(pool) as host:
        page = await host.greeted()
        page.draws = False
        await page.run(0, wide(20), rest=True)
        assert (await page.picture()).number == 0
        # A run that a later one stops has no result: on a slow machine some of these have none.
        for number in range(1, 5):
            await page.run(number, wide(20 + number), rest=True)
        while not any(order["header"]["values"] == wide(24) for order in pool.made):
            await asyncio.sleep(0.01)
        await page.say("drawn", number=0)
        assert (await page.picture()).number == 4


@in_loop
async def test_what_is_wrong_is_said_by_key_and_the_socket_stays() -> None:
    async with hosting() as host:
        page = await host.greeted()
        await page.run(1, {CLEARANCE: "20 kg", "joint.radius": "-1 mm"}, rest=True)
        refused = await page.until("refused")
        assert refused["number"] == 1
        assert [fault["key"] for fault in refused["faults"]] == [CLEARANCE, "joint.radius"]
        assert "not a unit of length" in refused["faults"][0]["message"]
        await page.run(2, wide(21), rest=True)
        assert (await page.picture()).number == 2


@in_loop
async def test_keys_that_name_files_are_refused_and_no_control_has_one() -> None:
    async with hosting(case="slider-crank") as host:
        page = await host.greeted()
        files = ("asperities.surface", "joints.wrist.clearance.mesh", "drives.motor.speed.table")
        for number, key in enumerate(files):
            await page.run(number, {key: "/etc/passwd"}, rest=True)
            (fault,) = (await page.until("refused"))["faults"]
            assert fault["key"] == key
            assert "may not name files" in fault["message"]
        assert not set(files) & {control["key"] for control in host.state.hello["controls"]}


@in_loop
async def test_an_edited_model_is_described_before_its_run_and_can_be_saved() -> None:
    async with hosting(case="four-bar") as host:
        page = await host.greeted()
        edit = {"template": "", "removed": ["joints.coupler-pin.clearance"], "added": {}}
        await page.run(1, {"drives.motor.speed": "250 rpm"}, rest=True, edit=edit)
        model = await page.until("model")
        assert model["edit"] == edit
        assert "joints.coupler-pin.clearance" not in model["removable"]
        assert not any(control["key"].endswith("clearance.radial") for control in model["controls"])
        assert (await page.picture()).header["command"] == "tribodyn run case.toml"
        saved = await host.get(f"/download/case.toml?run={model['run']}&{host.secret}")
        assert b"[joints.coupler-pin]" in saved.body
        assert b"coupler-pin.clearance" not in saved.body
        await page.run(2, {}, rest=True)
        assert (await page.until("model"))["removable"] == list(host.state.hello["removable"])


@in_loop
async def test_an_edit_that_is_refused_leaves_the_model_as_it_was() -> None:
    async with hosting(case="four-bar") as host:
        page = await host.greeted()
        await page.run(1, {}, rest=True, edit={"removed": ["joints.main"]})
        (fault,) = (await page.until("refused"))["faults"]
        assert fault["key"] == "drives.motor.joint"
        await page.run(2, {"joints.coupler-pin.clearance.radial": "25 um"}, rest=True)
        assert (await page.picture()).number == 2
        assert [said["type"] for said in page.heard].count("model") == 0


@in_loop
async def test_what_would_take_long_is_asked_before_and_too_long_is_refused() -> None:
    pool = Pretending(seconds=0.05)
    async with hosting(pool, rules=Rules(dragged=1.0, unasked=5.0, longest=60.0)) as host:
        page = await host.greeted()
        made = len(pool.made)
        # Two cycles on 96 by 16 nodes take 0.05 s: on 4096 nodes around 2 s, on 256 across too 34 s.
        many = {"solver.grid.theta": 4096, "solver.grid.z": 256}
        await page.run(1, many, rest=True)
        asked = await page.until("ask")
        assert 30.0 < asked["seconds"] < 40.0
        await page.run(2, {**many, "run.cycles": 10}, rest=True, agreed=True)
        assert "the most that a run may take here is 60 s" in (await page.until("refused"))["message"]
        await page.run(3, {"solver.grid.theta": 4096})
        assert (await page.until("state"))["state"] == "waiting"
        assert len(pool.made) == made
        # Each request is read anew: a slider that is dragged on must not keep the server busy. Requests are
        # read four times a second at most, however long this loop takes on a machine that has other work.
        began = asyncio.get_running_loop().time()
        for place in range(30):
            await page.run(3, {"solver.grid.theta": 4066 + place})
            await asyncio.sleep(0.002)
        await page.run(4, many, rest=True, agreed=True)
        looks = 0
        while (said := await page.until("state"))["number"] == 3:
            looks += 1
        assert said["state"] == "running"
        assert looks <= 1 + (asyncio.get_running_loop().time() - began) / UNHURRIED
        assert (await page.picture()).number == 4
        await page.run(5, {"run.cycles": 5000}, rest=True)
        assert (await page.until("refused"))["faults"][0]["key"] == "run.output_interval"


@in_loop
async def test_the_case_that_the_workbench_opens_is_run_without_a_question() -> None:
    pool = Pretending(seconds=0.05)
    async with hosting(pool, rules=Rules(dragged=1e-6, unasked=1e-6, longest=60.0)) as host:
        page = await host.greeted()
        await page.run(1, {}, rest=True)
        assert (await page.picture()).number == 1
        await page.run(2, wide(30), rest=True)
        assert (await page.until("ask"))["number"] == 2


@in_loop
async def test_a_wear_campaign_is_asked_about() -> None:
    pool = Pretending()
    async with hosting(pool) as host:
        page = await host.greeted()
        await page.run(1, {"wear.cycles": "100000"}, rest=True)
        assert "wear campaign" in (await page.until("ask"))["message"]


@in_loop
async def test_when_the_hand_rests_the_next_steps_of_its_slider_are_computed_ahead() -> None:
    pool = Pretending()
    async with hosting(pool) as host:
        page = await host.greeted()
        await page.run(1, {}, rest=True)
        await page.picture()
        # Dragged there, and let go.
        await page.run(12, wide(25))
        await page.picture()
        await page.run(2, wide(25), rest=True)
        await page.picture()
        await asyncio.sleep(1.0)
        await page.run(3, wide(26), rest=True)
        ahead = await page.picture()
        await page.run(4, wide(24), rest=True)
        assert [ahead.flags, (await page.picture()).flags] == [KEPT, KEPT]


@in_loop
async def test_a_sweep_tells_each_point_and_its_runs_are_there_at_once() -> None:
    async with hosting() as host:
        page = await host.greeted()
        await page.say(
            "sweep", number=5, key=CLEARANCE, values={}, **{"from": "10 um", "to": "50 um"}, points=9
        )
        told = [await page.until("sweep") for _ in range(9)]
        assert [len(message["points"]) for message in told] == list(range(1, 10))
        assert [point["value"] for point in told[-1]["points"]] == [10, 15, 20, 25, 30, 35, 40, 45, 50]
        assert told[-1]["finished"]
        await page.run(6, wide(35))
        answer = await page.picture()
        assert answer.flags == KEPT
        assert answer.header["run"] == told[-1]["points"][5]["run"]


@in_loop
async def test_a_sweep_over_names_takes_them_all_and_can_be_cancelled() -> None:
    pool = Pretending(seconds=0.1)
    async with hosting(pool) as host:
        page = await host.greeted()
        await page.say("sweep", number=5, key="contact.law", values={})
        first = await page.until("sweep")
        assert first["of"] == 7
        await page.say("cancel", number=5)
        await page.run(6, wide(30), rest=True)
        await page.picture()
        made = len(pool.made)
        await asyncio.sleep(0.5)
        # The neighbours of the new value are the only runs since.
        assert len(pool.made) <= made + 2


@in_loop
async def test_a_slope_is_that_of_five_runs_around_the_value() -> None:
    pool = Pretending()
    async with hosting(pool) as host:
        page = await host.greeted()
        await page.say("slope", number=3, key=CLEARANCE, values=wide(40))
        while not (told := await page.until("slope"))["finished"]:
            pass
        assert told["of"] == 5
        runs = {order["header"]["values"].get(CLEARANCE) for order in pool.made}
        assert {"36 um", "38 um", "40 um", "42 um", "44 um"} <= runs
        # The pretended number is always the same.
        assert told["results"]["a"] == {"slope": 0.0, "scatter": 0.0}
        await page.say("slope", number=4, key="joint.form.crown", values={})
        assert "other than zero" in (await page.until("refused"))["message"]


@in_loop
async def test_pins_are_limited_and_their_runs_stay() -> None:
    async with hosting(rules=Rules(pins=2, room=1)) as host:
        page = await host.greeted()
        runs = []
        for number in range(4):
            await page.run(number, wide(20 + number), rest=True)
            runs.append((await page.picture()).header["run"])
            await page.say("pin", run=runs[-1])
        assert "at most 2" in (await page.until("error"))["message"]
        await page.run(9, wide(20), rest=True)
        assert (await page.picture()).flags == KEPT
        await page.run(10, wide(22), rest=True)
        assert (await page.picture()).flags == 0, "there is no room for more than the last and the pinned"


@in_loop
async def test_a_socket_that_ends_takes_its_runs_along() -> None:
    pool = Pretending(seconds=5.0)
    async with hosting(pool) as host:
        page = await host.open()
        await page.until("hello")
        host.state.ready.set()
        await page.run(1, wide(30), rest=True)
        await asyncio.sleep(0.2)
        await page.leave()
        await asyncio.sleep(0.2)
        assert [order["header"]["values"] for order in pool.given_up] == [wide(30)]
        assert host.context.sockets == 0


@in_loop
async def test_every_message_of_the_greeting_is_what_the_page_needs() -> None:
    async with hosting() as host:
        page = await host.open()
        hello = await page.until("hello")
        first = [control for control in hello["controls"] if control["first"]]
        assert [control["key"] for control in first] == list(MECHANISMS["vsv"].controls)
        clearance = first[0]
        assert (clearance["text"], clearance["number"], clearance["unit"]) == ("20 um", 20.0, "um")
        assert (clearance["least"], clearance["greatest"], clearance["step"]) == (5.0, 50.0, 1.0)
        robust = [number["robust"] for number in hello["results"]]
        assert robust == sorted(robust, reverse=True)
        assert {section["chapter"] for section in hello["sections"]} == {c["name"] for c in hello["chapters"]}
        assert not isinstance(await page.hear(), Answer)


def test_a_page_waits_for_no_other_whose_case_takes_long_to_read(monkeypatch: pytest.MonkeyPatch) -> None:
    varied, begun, done = Origin.varied, threading.Event(), threading.Event()

    def slow(origin: Origin, values: dict[str, str]) -> object:
        if values.get("title") == "slow":
            begun.set()
            assert done.wait(20.0)
        return varied(origin, values)

    @in_loop
    async def test() -> None:
        async with hosting(Pretending()) as host:
            hog = await host.greeted()
            other = await host.greeted()
            for kind in ("run", "sweep", "slope"):
                begun.clear()
                done.clear()
                more = {"key": "joint.clearance", "from": "20 um", "to": "40 um"} if kind == "sweep" else {}
                more |= {"key": "joint.clearance"} if kind == "slope" else {}
                await hog.say(kind, number=1, values={"title": "slow"}, **more)
                await asyncio.to_thread(begun.wait, 20.0)
                await other.run(2, {"joint.clearance": f"{30 + len(kind)} um"}, rest=True)
                assert (await other.picture()).number == 2, "before the first one is read"
                done.set()

    monkeypatch.setattr(Origin, "varied", slow)
    test()
