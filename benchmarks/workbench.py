"""What a person waits for at the workbench: the first picture, and each one while a slider is dragged.

python -m benchmarks.workbench [quick | memory]

A client stands in for the page: it says at once that it has drawn, so what a browser draws with comes on top;
the tests in tests/browser measure that. What the server keeps of runs it may keep, up to a limit: whether its
memory grows beyond is told by a line through the time after this limit was reached.
"""

from __future__ import annotations

import asyncio
import json
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Final
from urllib.parse import urlsplit

import numpy as np
import psutil
from numpy.typing import NDArray
from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.websocket import WebSocketClientConnection, websocket_connect

from tribodyn.workbench.bench import Rules

KEY: Final = "joint.clearance"
PER_SECOND: Final = 30
"""Positions of a slider that a page sends in a second."""
DRAG: Final = 20.0
"""How long it is dragged [s]."""
SOCKETS: Final = 20
MINUTES: Final = 6.0
WATCHED: Final = 5.0
"""Time between two looks at the memory [s]."""
ROOM: Final = Rules().room
"""Size of the pictures that the server keeps [bytes]."""
LARGEST: Final = 100_000_000


def run(quick: bool = False, seconds: float = DRAG) -> dict[str, Any]:
    """Measure, print and return; ``quick``: a short drag on one socket."""
    with workbench() as (process, address):
        found = asyncio.run(_measured(process, address, quick, seconds))
    for name, row in found.items():
        print(f"{name:14s} " + ", ".join(f"{key} {value:.3g}" for key, value in row.items()), flush=True)
    return found


@contextmanager
def workbench() -> Iterator[tuple[psutil.Process, str]]:
    """Have a workbench, and its address with the key."""
    command = [sys.executable, "-m", "tribodyn", "workbench", "--json", "--quiet"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        told = "".join(process.stdout.readline() for _ in range(3))
        try:
            yield psutil.Process(process.pid), str(json.loads(told)["address"])
        finally:
            process.terminate()


async def _measured(
    process: psutil.Process, address: str, quick: bool, seconds: float
) -> dict[str, dict[str, float]]:
    # Whose name only browsers know, and which may be called by its number, too.
    address = address.replace(str(urlsplit(address).hostname), "127.0.0.1", 1)
    answer = await AsyncHTTPClient().fetch(address)
    base, cookie = address.partition("?")[0], answer.headers["Set-Cookie"].partition(";")[0]
    first = await Hand.at(base, cookie)
    await first.wish({}, rest=True)
    await first.picture()
    found = {"first picture": {"seconds": time.time() - process.create_time()}}
    found["drag"] = await first.dragged(0.5 if quick else seconds)
    if not quick:
        found[f"{SOCKETS} sockets"] = await _many(process, base, cookie)
    first.socket.close()
    return found


async def _many(process: psutil.Process, base: str, cookie: str) -> dict[str, float]:
    """Ask on many sockets, and see what the memory does once all that may be kept is kept."""
    hands = [await Hand.at(base, cookie) for _ in range(SOCKETS)]
    seconds = 60.0 * MINUTES
    tasks = [asyncio.create_task(hand.released(seconds, seed)) for seed, hand in enumerate(hands)]
    rows, begin = [], time.perf_counter()
    while not all(task.done() for task in tasks):
        await asyncio.sleep(WATCHED)
        sent = sum(hand.received for hand in hands)
        rows.append((time.perf_counter() - begin, sent, *_megabytes(process)))
    rates = [await task / seconds for task in tasks]
    for hand in hands:
        hand.socket.close()
    return {
        "pictures a second each": float(np.mean(rates)),
        "least": min(rates),
        **_growth(np.array(rows)),
        "processes": 1.0 + len(process.children(recursive=True)),
    }


def _megabytes(process: psutil.Process) -> tuple[float, float]:
    """Return what the server and its other processes have of the memory for themselves."""
    mine, *others = (one.memory_full_info().pss / 1e6 for one in _family(process))
    return mine, sum(others)


def _family(process: psutil.Process) -> list[psutil.Process]:
    return [process, *process.children(recursive=True)]


def _growth(rows: NDArray[np.float64]) -> dict[str, float]:
    """Tell what memory does from the time on when twice as much was sent as is kept.

    Parameters
    ----------
    rows
        Time [s], what was sent [bytes], memory of the server and of the others [MB].
    """
    full = rows[rows[:, 1] > 2 * ROOM]
    told = {"MB kept of runs": ROOM / 1e6, "MB sent": rows[-1, 1] / 1e6, "full after [s]": full[0, 0]}
    for name, column in (("server", 2), ("workers", 3)):
        (slope, _), spread = np.polyfit(full[:, 0] / 3600.0, full[:, column], 1, cov=True)
        told |= {
            f"{name}, MB at first": rows[0, column],
            f"{name}, MB when full": full[0, column],
            f"{name}, MB at last": rows[-1, column],
            f"{name}, MB an hour": slope,
            f"{name}, its standard error": float(np.sqrt(spread[0, 0])),
        }
    return {name: float(value) for name, value in told.items()}


class Hand:
    """Somebody at a slider."""

    def __init__(self, socket: WebSocketClientConnection) -> None:
        self.socket, self.number, self.answered = socket, 0, 0
        self.sent: dict[int, float] = {}
        self.received = 0

    @classmethod
    async def at(cls, base: str, cookie: str) -> Hand:
        """Open a socket."""
        headers = {"Cookie": cookie, "Origin": base.rstrip("/")}
        request = HTTPRequest(base.replace("http", "ws", 1) + "socket", headers=headers)
        return cls(await websocket_connect(request, max_message_size=LARGEST))

    async def wish(self, values: dict[str, str], *, rest: bool = False) -> None:
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
                _, self.answered, length, _ = (int(word) for word in np.frombuffer(said, "<u4", 4))
                took = time.perf_counter() - self.sent[self.answered]
                await self.socket.write_message(json.dumps({"type": "drawn", "number": self.answered}))
                header = json.loads(said[16 : 16 + length])
                return {
                    "whole": took,
                    "run": header["seconds"],
                    "integration": header["headlines"]["wall_time_s"],
                }

    async def released(self, seconds: float, seed: int) -> int:
        """Let go at places of which hardly any comes twice, each once there is a picture; return how many."""
        chance, begin = np.random.default_rng(seed), time.perf_counter()
        pictures = 0
        while time.perf_counter() - begin < seconds:
            await self.wish({KEY: f"{chance.uniform(20.0, 50.0):.4f} um"}, rest=True)
            await self.picture()
            pictures += 1
        return pictures

    async def dragged(self, seconds: float) -> dict[str, float]:
        """Move the slider so that hardly any value comes twice, and tell how pictures followed."""
        begin = time.perf_counter()
        moving = asyncio.create_task(self._moved(begin, seconds))
        pictures = []
        while not moving.done() or self.answered != self.number:
            pictures.append(await self.picture())
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

    async def _moved(self, begin: float, seconds: float) -> None:
        while (now := time.perf_counter() - begin) < seconds:
            place = 35.0 + 15.0 * np.sin(0.7 * now)
            await self.wish({KEY: f"{place:.3f} um"})
            await asyncio.sleep(1.0 / PER_SECOND)
        await self.wish({}, rest=True)


if __name__ == "__main__":
    run(quick="quick" in sys.argv[1:], seconds=1.0 if "memory" in sys.argv[1:] else DRAG)
