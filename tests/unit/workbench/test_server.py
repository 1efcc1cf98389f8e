"""Access control and the routes behind it, over real connections."""

import asyncio
import itertools
import json
import re
import stat
import sys
import time

import pytest
from tests.unit.workbench.host import SOON, Host, Pretending, finished, hosting, in_loop
from tornado.httpclient import HTTPClientError

from tribodyn.core.errors import InputError
from tribodyn.workbench.access import same
from tribodyn.workbench.messages import LARGEST
from tribodyn.workbench.server import listening, own_name, pointer
from tribodyn.workbench.server_state import Rules

SHOWN = ("/", "/assets/a.js")  #: What a cookie alone opens: nothing in it is of a person.
ROUTES = (*SHOWN, "/download/case.toml", "/socket", "/nothing")
METHODS = ("GET", "HEAD", "POST", "PUT", "DELETE", "OPTIONS", "TRACE", "CONNECT", "PATCH", "BREW")
EVIL = "http://evil.example"
UPGRADE = {
    "Upgrade": "websocket",
    "Connection": "Upgrade",
    "Sec-WebSocket-Version": "13",
    "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==",
}


def combinations(host):
    """Yield every mixture of right and wrong host, origin and cookie, and whether it may pass."""
    port = host.port
    hosts = (f"127.0.0.1:{port}", f"ours.localhost:{port}", f"localhost:{port}", f"evil.example:{port}")
    origins = (None, "own", "null", EVIL, f"https://127.0.0.1:{port}", f"http://127.0.0.1:{port + 1}")
    name, value = host.cookie.split("=")
    cookies = (None, host.cookie, f"{name}={value[:-1]}", f"tribodyn-{port + 1}={value}")
    for asked, origin, cookie in itertools.product(hosts, origins, cookies):
        headers = {"Host": asked}
        if origin is not None:
            headers["Origin"] = f"http://{asked}" if origin == "own" else origin
        if cookie is not None:
            headers["Cookie"] = cookie
        known = asked in hosts[:2] and cookie == host.cookie
        yield headers, known and origin in (None, "own"), known and origin == "own"


@pytest.mark.parametrize("every", [False, pytest.param(True, marks=pytest.mark.long)])
def test_no_route_answers_who_is_not_our_page(every: bool) -> None:
    finished(asyncio.wait_for(_ask_all_routes(every), 6 * SOON))


async def _ask_all_routes(every: bool) -> None:
    async with hosting() as host:
        for route in ROUTES:
            for headers, plain, socket in combinations(host):
                for secret in (host.secret, host.secret[:-1], f"{host.secret}&{host.secret}", ""):
                    path, right = f"{route}?{secret}", secret == host.secret
                    # Where two things are wrong, one route stands for all, but in the daily seventh.
                    if not (every or plain or right or route == "/socket"):
                        continue
                    status = (await host.get(path, headers)).code
                    assert (status != 403) == (plain and (right or route in SHOWN)), (path, headers)
                    if not (socket and (right or route in SHOWN)):
                        status = (await host.get(path, {**headers, **UPGRADE})).code
                        assert status == 403, (path, headers)


@in_loop
async def test_no_answer_to_a_stranger_names_the_host_that_keeps_the_cookie() -> None:
    async with hosting() as host:
        known, name = f"127.0.0.1:{host.port}", f"ours.localhost:{host.port}"
        right, upgrade = (
            f"Host: {known}\r\n",
            "".join(f"{key}: {value}\r\n" for key, value in UPGRADE.items()),
        )
        others = (
            "",
            "Host:\r\n",
            "Host: localhost\r\n",
            f"{right}Origin: {EVIL}\r\n",
            f"{right}Cookie: x=y\r\n",
        )
        paths = (*ROUTES, "/?token=x", "*", "/%00", f"{EVIL}/")
        lines = [f"{method} {path} HTTP/1.1" for method in METHODS for path in paths]
        lines += ["GET / HTTP/1.0", "GET / HTTP/9", "nonsense", "GET " + 20_000 * "x"]
        for line, headers, more in itertools.product(lines, (right, *others), ("", upgrade)):
            answer = await answer_to(host, f"{line}\r\n{headers}{more}\r\n")
            assert answer[:12] in ("", "HTTP/1.1 403", "HTTP/1.1 400", "HTTP/1.1 431"), (line, headers)
            assert "ours" not in answer, (line, headers)
        for path in ROUTES:
            # A person is told of the host that was asked alone.
            own = (await host.get(f"{path}?{host.secret}", {"Cookie": host.cookie, "Host": name})).headers
            other = (await host.get(f"{path}?{host.secret}")).headers
            assert name in own["Content-Security-Policy"]
            assert known not in own["Content-Security-Policy"]
            assert name not in str(other)


async def answer_to(host: Host, request: str) -> str:
    """Send a request as it is, and return the answer."""
    reader, writer = await asyncio.open_connection("127.0.0.1", host.port)
    writer.write(request.encode())
    writer.write_eof()
    answer = await asyncio.wait_for(reader.read(), SOON)
    writer.close()
    return answer.decode("latin-1")


@in_loop
async def test_a_cookie_that_went_astray_opens_nothing_of_a_person() -> None:
    async with hosting() as host:
        page = await host.greeted()
        await page.run(1, {"joint.clearance": "31 um"}, rest=True)
        run = (await page.picture()).header["run"]
        path = f"/download/case.toml?run={run}"
        assert (await host.get(f"{path}&{host.secret}")).code == 200
        assert (await host.get(path)).code == 403
        for shown in SHOWN:
            assert host.session.secret.encode() not in (await host.get(shown)).body
        with pytest.raises(HTTPClientError, match="403"):
            await host.open(path="/socket")


@in_loop
async def test_our_own_page_opens_its_socket() -> None:
    async with hosting() as host:
        page = await host.open()
        assert (await page.until("hello"))["mechanism"] == "vsv"


@in_loop
async def test_other_methods_are_refused() -> None:
    async with hosting() as host:
        for method in ("POST", "PUT", "DELETE", "OPTIONS", "HEAD", "PATCH"):
            more = {"method": method, "allow_nonstandard_methods": True}
            assert (await host.get("/", **more)).code == 403


@in_loop
async def test_the_token_is_traded_once_for_a_cookie_that_scripts_cannot_read() -> None:
    async with hosting() as host:
        address = f"/?token={host.session.token}"
        assert (await host.get("/?token=wrong", {})).code == 403
        assert (await host.get(f"{address}&token=x", {})).code == 403
        assert (await host.get(address.replace("/", "/assets/a.js", 1), {})).code == 403
        first = await host.get(address, {})
        assert first.code == 200
        cookie = first.headers["Set-Cookie"]
        assert cookie.startswith(host.cookie)
        for part in ("HttpOnly", "SameSite=Strict", "Path=/"):
            assert part in cookie
        assert host.session.token not in first.body.decode()
        assert f'name="secret" content="{host.session.secret}"' in first.body.decode()
        assert (await host.get(address, {})).code == 403
        # Who has the cookie and comes back with the address is sent on.
        assert (await host.get(address)).code == 200
        again = (await host.get("/")).body
        assert b"the page" in again
        assert host.session.secret.encode() not in again


@in_loop
async def test_every_answer_keeps_others_out_and_tells_nothing_of_us() -> None:
    async with hosting() as host:
        for path, headers in (
            ("/", None),
            ("/", {}),
            ("/assets/a.js", None),
            ("/nothing", None),
            ("/socket", None),
        ):
            found = (await host.get(path, headers)).headers
            policy = found["Content-Security-Policy"]
            assert policy.startswith("default-src 'none'; script-src 'self'; style-src 'self';")
            assert "unsafe" not in policy
            assert found["X-Content-Type-Options"] == "nosniff"
            assert found["Cross-Origin-Opener-Policy"] == "same-origin"
            assert found["Cross-Origin-Resource-Policy"] == "same-origin"
            assert found["Referrer-Policy"] == "no-referrer"
            assert not [name for name in found if name.startswith("Access-Control")]
            assert "Server" not in found


@in_loop
async def test_downloads_are_of_runs_that_were_seen_and_paths_lead_nowhere() -> None:
    async with hosting() as host:
        page = await host.greeted()
        await page.run(1, {"joint.clearance": "31 um"}, rest=True)
        run = (await page.picture()).header["run"]
        case = await host.get(f"/download/case.toml?run={run}&{host.secret}")
        assert 'clearance = "31 um"' in case.body.decode()
        assert case.headers["Content-Disposition"] == 'attachment; filename="case.toml"'
        assert (await host.get(f"/download/result.nc?run={run}&{host.secret}")).body == b"a file"
        for path in (
            "/download/case.toml?run=0000000000000000",
            "/download/case.toml",
            f"/download/load?run={run}",
            f"/download/..%2f..%2fetc%2fpasswd?run={run}",
            "/assets/page.html",
            "/assets/%2e%2e%2faccess.py",
            "/assets/..%2faccess.py",
            "/assets//etc/passwd",
        ):
            asked = f"{path}{'&' if '?' in path else '?'}{host.secret}"
            assert (await host.get(asked)).code == 404, path


@in_loop
async def test_messages_are_read_at_sixty_a_second_and_not_beyond_their_length() -> None:
    async with hosting(rules=Rules(messages=100)) as host:
        page = await host.greeted()
        began = time.monotonic()
        for _ in range(250):
            await page.socket.write_message("{}")
        for _ in range(250):
            await page.until("error")
        # A second of them may come at once, the others take theirs.
        assert time.monotonic() - began > 1.3
        await page.socket.write_message(json.dumps({"type": "drawn", "number": 1, "x": "x" * LARGEST}))
        assert await page.hear() is None


@in_loop
async def test_there_are_only_so_many_sockets() -> None:
    async with hosting(rules=Rules(sockets=3)) as host:
        pages = [await host.open() for _ in range(3)]
        ours = {"Origin": host.origin, "Cookie": host.cookie}
        assert (await host.get(f"/socket?{host.secret}", {**ours, **UPGRADE})).code == 503
        await pages[0].leave()
        await asyncio.sleep(0.1)
        await host.open()


@in_loop
async def test_who_does_not_read_is_left() -> None:
    async with hosting() as host:
        page = await host.greeted()
        handler = host.state.listeners[0].__self__.send.__self__  # type: ignore[attr-defined]
        handler.backlog = 2 * 10**8
        await page.run(1, rest=True)
        while await page.hear() is not None:
            pass


@in_loop
async def test_errors_of_our_own_are_told_without_the_address() -> None:
    class Broken(Pretending):
        async def do(self, job):
            if job.order["work"] == "result.nc":
                raise RuntimeError("broken")
            return await super().do(job)

    async with hosting(Broken()) as host:
        page = await host.greeted()
        await page.run(1, rest=True)
        run = (await page.picture()).header["run"]
        assert (await host.get(f"/download/result.nc?run={run}&{host.secret}")).code == 500
        (told,) = host.complaints
        assert "RuntimeError: broken" in told
        assert "secret" not in told
        assert host.session.secret not in told
        host.complaints.clear()


def test_it_listens_to_this_machine_only_at_one_port_of_both_kinds_of_address():
    found = listening(0)
    try:
        assert {listener.getsockname()[0] for listener in found} <= {"127.0.0.1", "::1"}
        port = found[0].getsockname()[1]
        assert {listener.getsockname()[1] for listener in found} == {port}
        with pytest.raises(InputError, match=f"port {port} cannot be had"):
            listening(port)
    finally:
        for listener in found:
            listener.close()


def test_the_browser_is_pointed_by_a_file_for_the_eyes_of_this_user():
    with pointer("http://127.0.0.1:1/?token=x") as path:
        assert stat.S_IMODE(path.stat().st_mode) == 0o600
        assert "http://127.0.0.1:1/?token=x" in path.read_text()
    assert not path.exists()


@pytest.mark.skipif(sys.platform == "darwin", reason="browsers do not find such names there")
def test_it_has_a_name_that_nobody_can_guess():
    names = {own_name() for _ in range(10)}
    assert len(names) == 10
    assert all(re.fullmatch(r"[0-9a-f]{32}\.localhost", name) for name in names)


def test_secrets_are_compared_whole():
    assert same("abc", "abc")
    assert not same("abc", "abd")
    assert not same("", "abc")
