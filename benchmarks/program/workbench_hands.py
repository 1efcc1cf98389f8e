"""Hands at sliders without a browser: what the server of the workbench takes, and what it keeps."""

from __future__ import annotations

import asyncio
import json
import re
import time
from collections.abc import Sequence
from typing import Final
from urllib.parse import urlsplit

import numpy as np
import psutil
from numpy.typing import NDArray
from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.websocket import WebSocketClientConnection, websocket_connect

from tribodyn.workbench.server_state import MOST_CASES, Rules

KEY: Final = "joint.clearance"
PER_SECOND: Final = 50  #: Positions of a slider that a page sends in a second, as fast as it may.
WATCHED: Final = 5.0  #: Time between two looks at the memory [s].
ROOM: Final = Rules().room  #: Size of the pictures that the server keeps [bytes].
LARGEST: Final = 100_000_000
_LOOK: Final = 0.2  #: How long one looks for who is busy [s].
_LATE: Final = 2.0  #: A picture is late that takes so many times what 95 % of the others do.


class Hand:
    """Somebody at a slider."""

    def __init__(self, socket: WebSocketClientConnection) -> None:
        self.socket, self.number, self.answered = socket, 0, 0
        self.sent: dict[int, float] = {}
        self.received = self.pictures = 0

    @staticmethod
    async def entry(address: str) -> tuple[str, str]:
        """Trade the token in an address; return where sockets are, with the page's secret, and the cookie."""
        # Whose name only browsers know, and which may be called by its number, too.
        address = address.replace(str(urlsplit(address).hostname), "127.0.0.1", 1)
        answer = await AsyncHTTPClient().fetch(address)
        secret = re.search(r'name="secret" content="([^"]+)"', answer.body.decode())
        assert secret is not None
        sockets = f"{address.partition('?')[0]}socket?secret={secret[1]}".replace("http", "ws", 1)
        return sockets, answer.headers["Set-Cookie"].partition(";")[0]

    @classmethod
    async def at(cls, sockets: str, cookie: str) -> Hand:
        """Open a socket."""
        headers = {"Cookie": cookie, "Origin": f"http://{urlsplit(sockets).netloc}"}
        request = HTTPRequest(sockets, headers=headers)
        return cls(await websocket_connect(request, max_message_size=LARGEST))

    async def request(self, values: dict[str, str], *, rest: bool = False) -> None:
        """Ask for a run."""
        self.number += 1
        self.sent[self.number] = time.perf_counter()
        said = {"type": "run", "number": self.number, "values": values, "rest": rest, "agreed": rest}
        await self.socket.write_message(json.dumps(said))

    async def picture(self) -> dict[str, float]:
        """Return what the next picture took since it was asked for, and what of that its run [s]."""
        while True:
            said = await self.socket.read_message()
            assert said is not None, "the workbench has ended"
            if isinstance(said, bytes):
                self.received += len(said)
                self.pictures += 1
                _, self.answered, length, _ = (int(word) for word in np.frombuffer(said, "<u4", 4))
                took = time.perf_counter() - self.sent[self.answered]
                await self.socket.write_message(json.dumps({"type": "drawn", "number": self.answered}))
                header = json.loads(said[16 : 16 + length])
                return {
                    "whole": took,
                    "run": header["seconds"],
                    "integration": header["results"]["wall_time_s"],
                }

    async def released(self, seconds: float, seed: int) -> None:
        """Let go at places of which hardly any comes twice, each once there is a picture."""
        chance, begin = np.random.default_rng(seed), time.perf_counter()
        while time.perf_counter() - begin < seconds:
            await self.request({KEY: f"{chance.uniform(20.0, 50.0):.4f} um"}, rest=True)
            await self.picture()

    async def dragged(self, seconds: float) -> dict[str, float]:
        """Move the slider so that hardly any value comes twice, and tell how pictures followed."""
        begin = time.perf_counter()
        pictures = await self.followed(seconds)
        whole = np.array([picture["whole"] for picture in pictures])
        return {
            "median [s]": float(np.median(whole)),
            "95 % [s]": float(np.quantile(whole, 0.95)),
            "pictures a second": whole.size / (time.perf_counter() - begin),
            **{
                f"{part}, median [s]": float(np.median([picture[part] for picture in pictures]))
                for part in ("run", "integration")
            },
        }

    async def followed(self, seconds: float) -> list[dict[str, float]]:
        """Move the slider and return all pictures, the one of where it rests last."""
        moving = asyncio.create_task(self._moved(time.perf_counter(), seconds))
        pictures = []
        while not moving.done() or self.answered != self.number:
            pictures.append(await self.picture())
        return pictures

    async def _moved(self, begin: float, seconds: float) -> None:
        while (now := time.perf_counter() - begin) < seconds:
            place = 35.0 + 15.0 * np.sin(0.7 * now)
            await self.request({KEY: f"{place:.3f} um"})
            await asyncio.sleep(1.0 / PER_SECOND)
        await self.request({}, rest=True)


def family(process: psutil.Process) -> list[psutil.Process]:
    """Return a process and all that came from it."""
    return [process, *process.children(recursive=True)]


async def killed(hand: Hand, process: psutil.Process, seconds: float) -> dict[str, float]:
    """Drag, and kill the worker that is busy in the middle of it."""
    before = hand.number
    following = asyncio.create_task(hand.followed(seconds))
    await asyncio.sleep(0.5 * seconds)
    (await _busiest(family(process)[1:])).kill()
    whole = np.array([picture["whole"] for picture in await following])
    return {
        "late pictures": float(np.count_nonzero(whole > _LATE * np.quantile(whole, 0.95))),
        "longest [s]": float(whole.max()),
        "95 % [s]": float(np.quantile(whole, 0.95)),
        "requests never answered": float(hand.answered != hand.number or hand.number == before),
    }


async def _busiest(some: Sequence[psutil.Process]) -> psutil.Process:
    """Return the process that computes most, just now."""
    before = [one.cpu_times().user for one in some]
    await asyncio.sleep(_LOOK)
    took = [one.cpu_times().user - start for one, start in zip(some, before, strict=True)]
    return some[int(np.argmax(took))]


async def kept_busy(
    process: psutil.Process, place: str, cookie: str, sockets: int, minutes: float
) -> dict[str, float]:
    """Ask on many sockets, and see what the memory does once all that may be kept is kept."""
    hands = [await Hand.at(place, cookie) for _ in range(sockets)]
    seconds = 60.0 * minutes
    tasks = [asyncio.create_task(hand.released(seconds, seed)) for seed, hand in enumerate(hands)]
    rows, begin = [], time.perf_counter()
    while not all(task.done() for task in tasks):
        await asyncio.sleep(WATCHED)
        sent, made = sum(hand.received for hand in hands), sum(hand.pictures for hand in hands)
        rows.append((time.perf_counter() - begin, sent, made, *_megabytes(process)))
    for task in tasks:
        await task
    for hand in hands:
        hand.socket.close()
    rates = [hand.pictures / seconds for hand in hands]
    return {
        "number": float(sockets),
        "minutes": minutes,
        "pictures a second each": float(np.mean(rates)),
        "least": min(rates),
        **_growth(np.array(rows)),
    }


def _megabytes(process: psutil.Process) -> tuple[float, float]:
    """Return what the server and its other processes have of the memory that nobody shares.

    What they share with others on the machine would change whenever one of those begins or ends.
    """
    mine, *others = (one.memory_full_info().uss / 1e6 for one in family(process))
    return mine, sum(others)


def _growth(rows: NDArray[np.float64]) -> dict[str, float]:
    """Tell what memory does from the time on when all is full that is kept: pictures and texts of cases.

    A straight line through the time after that, whose standard error allows for the memory of one look at the
    next: neighbours that resemble each other count as so many fewer.

    Parameters
    ----------
    rows
        Time [s], what was sent [bytes], pictures made, memory of the server and of the others [MB].
    """
    full = (rows[:, 1] > 2 * ROOM) & (rows[:, 2] > MOST_CASES)
    if np.count_nonzero(full) < 10:
        full = np.arange(len(rows)) >= len(rows) // 2
    since = rows[full]
    told = {"pictures": rows[-1, 2], "MB sent": rows[-1, 1] / 1e6, "looked at from [s]": since[0, 0]}
    told["pictures until then"] = since[0, 2]
    for name, column in (("server", 3), ("workers", 4)):
        slope, error = line(since[:, 0] / 3600.0, since[:, column])
        told |= {
            f"{name}, MB at first": rows[0, column],
            f"{name}, MB from then": since[0, column],
            f"{name}, MB at last": rows[-1, column],
            f"{name}, MB an hour": slope,
            f"{name}, its standard error": error,
            f"{name}, growth over its standard error": slope / error,
        }
    return {name: float(value) for name, value in told.items()}


def line(x: NDArray[np.float64], y: NDArray[np.float64]) -> tuple[float, float]:
    """Return the slope of the straight line of least squares, and its standard error."""
    (slope, start), spread = np.polyfit(x, y, 1, cov="unscaled")
    left = y - slope * x - start
    scatter = float(left @ left) / (x.size - 2)
    likeness = max(float(left[1:] @ left[:-1]) / max(float(left @ left), 1e-30), 0.0)
    apart = (1.0 - likeness) / (1.0 + likeness)
    return float(slope), float(np.sqrt(spread[0, 0] * scatter / apart))
