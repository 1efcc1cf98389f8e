"""A server for many: behind a proxy that speaks https, each with a cookie, and nothing in common."""

from __future__ import annotations

import re

import pytest
from tests.unit.workbench.host import PUBLIC, Host, Page, hosting, in_loop
from tests.unit.workbench.test_server import UPGRADE
from tornado.web import HTTPError

from tribodyn.workbench.server_state import Rules
from tribodyn.workbench.sessions import NEW, Sessions

HTTPS = f"https://{PUBLIC}"


async def admitted(host: Host) -> tuple[str, str]:
    """Come as a browser does, and return the cookie and the secret as an address has it."""
    first = await host.get("/", {"Host": PUBLIC})
    assert f"/?token={NEW}".encode() in first.body
    assert "Set-Cookie" not in first.headers
    second = await host.get(f"/?token={NEW}", {"Host": PUBLIC})
    assert b"the page" in second.body
    cookie = second.headers["Set-Cookie"]
    for part in ("__Host-tribodyn=", "Secure", "HttpOnly", "SameSite=Strict", "Path=/"):
        assert part in cookie
    return cookie.partition(";")[0], secret_in(second.body)


def secret_in(page: bytes) -> str:
    """Return the secret that a page was given, as an address has it."""
    found = re.search(rb'name="secret" content="([^"]+)"', page)
    assert found is not None
    return f"secret={found[1].decode()}"


async def opened(host: Host, cookie: str, secret: str) -> Page:
    asked = {"Host": PUBLIC, "Origin": HTTPS, "Cookie": cookie}
    page = await host.open(asked, f"/socket?{secret}")
    await page.until("hello")
    return page


@in_loop
async def test_visitors_have_nothing_in_common() -> None:
    async with hosting(sessions=Sessions(10**6)) as host:
        first, second = await admitted(host), await admitted(host)
        assert not {*first} & {*second}
        page = await opened(host, *first)
        await page.run(1, {"joint.clearance": "31 um"}, rest=True)
        run = (await page.picture()).header["run"]
        for cookie, secret, status in ((*first, 200), (*second, 404), (first[0], second[1], 403)):
            path = f"/download/case.toml?run={run}&{secret}"
            assert (await host.get(path, {"Host": PUBLIC, "Cookie": cookie})).code == status
        other = await opened(host, *second)
        await other.run(1, {"joint.clearance": "31 um"}, rest=True)
        assert (await other.picture()).flags == 0, "what the first visitor had made is not the second one's"


@in_loop
async def test_only_the_public_name_and_https_are_let_in() -> None:
    async with hosting(sessions=Sessions(10**6)) as host:
        cookie, secret = await admitted(host)
        ours = {"Host": PUBLIC, "Cookie": cookie, "Origin": HTTPS}
        assert (await host.get("/", ours)).code == 200
        wrong = (
            {"Host": f"127.0.0.1:{host.port}"},
            {"Host": f"{PUBLIC}:443"},
            {"Host": f"evil.{PUBLIC}"},
            {"Origin": f"http://{PUBLIC}"},
            {"Origin": "null"},
        )
        for change in wrong:
            for path in ("/", "/assets/a.js", f"/socket?{secret}"):
                assert (await host.get(path, {**ours, **change})).code == 403, (path, change)
                assert (await host.get(path, {**ours, **change, **UPGRADE})).code == 403, (path, change)
        for path in ("/assets/a.js", "/socket", "/download/case.toml"):
            assert (await host.get(path, {"Host": PUBLIC})).code == 403
            assert (await host.get(path, {"Host": PUBLIC, "Origin": HTTPS, **UPGRADE})).code == 403
        assert (await host.get("/?token=other", {"Host": PUBLIC})).code == 403


@in_loop
async def test_a_visitor_has_so_many_pages_and_no_more() -> None:
    async with hosting(sessions=Sessions(10**6), rules=Rules(each=2)) as host:
        cookie, secret = await admitted(host)
        for _ in range(2):
            await opened(host, cookie, secret)
        asked = {"Host": PUBLIC, "Origin": HTTPS, "Cookie": cookie, **UPGRADE}
        assert (await host.get(f"/socket?{secret}", asked)).code == 503
        await opened(host, *await admitted(host))


def test_who_is_gone_is_forgotten_and_who_has_a_page_open_is_not():
    now = [0.0]
    sessions = Sessions(1, most=2, stay=60.0, clock=lambda: now[0])
    first, second = sessions.admit(), sessions.admit()
    present = sessions.visitor(first)
    assert present is not None
    present.sockets = 1
    third = sessions.admit()
    assert sessions.visitor(first) is present
    assert sessions.visitor(second) is None, "without room who was seen longest ago has to go"
    gone = sessions.visitor(third)
    assert gone is not None
    gone.sockets = 1
    with pytest.raises(HTTPError, match="503"):
        sessions.admit()
    gone.sockets, now[0] = 0, 61.0
    sessions.admit()
    assert sessions.visitor(third) is None
    assert sessions.visitor("") is None
