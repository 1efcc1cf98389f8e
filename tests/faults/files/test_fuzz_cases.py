"""Random case files and ``--set`` values: a valid case, or exit status 2 and one line that names the key.

``tribodyn check`` reads them all, in this process. Cases it calls valid are simulated for a moment, which
must end in a dataset or in a message about a key: what is checked can be run.
"""

from __future__ import annotations

import contextlib
import io
import time

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tribodyn.cases import keys_of
from tribodyn.cli.main import main
from tribodyn.core.errors import InputError, Stopped
from tribodyn.mechanisms.catalogue import built_in, kinds, load_case
from tribodyn.simulation import simulate

#: Examples of each test in ``make test`` and, five tests of them, in ``make test-long``.
FEW, MANY = 40, 4000
TIME_LIMIT = 5.0  #: No file may keep the reader longer than this, in time of the processor [s].
#: Simulated time of a valid case, and time of the processor when it is told to stop and when it hangs [s].
MOMENT, PATIENCE, HANGS = 2e-3, 0.5, 30.0

KEYS = sorted({path for kind in kinds().values() for path in keys_of(kind)})
UNITS = [
    *("", "um", "mm", "m", "deg", "rad", "rad/s", "deg/s", "N", "N m", "Pa", "GPa", "m^2/N", "kg", "s"),
    *("ms", "1/um^2", "m/s", "Pa s", "K", "m/s^2", "furlong", "m m m", "1/0", "µm", "%", "()", "m**9999"),
]

numbers = st.one_of(
    st.floats(allow_nan=True, allow_infinity=True),
    st.integers(-(10**30), 10**30),
    st.floats(-3.0, 3.0).map(lambda power: 10.0**power),
)
quantities = st.builds(lambda value, unit: f"{value} {unit}", numbers, st.sampled_from(UNITS))
names = st.sampled_from(
    ["exact", "paper", "rsdc", "ke", "traction", "moment", "mebdf", "bdf", "true", "none"]
)
odd_texts = st.one_of(
    st.text(max_size=40),
    st.sampled_from(
        ["../../etc/passwd", "/dev/zero", "x" * 5000, "<script>alert(1)</script>", "\x1b[31m", "nan m"]
    ),
)
scalars = st.one_of(quantities, numbers, st.booleans(), names, odd_texts)
values = st.recursive(
    scalars,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=6,
)
paths = st.one_of(
    st.sampled_from(KEYS),
    st.sampled_from(KEYS).map(lambda key: key[:-1]),
    st.sampled_from(KEYS).map(lambda key: key.rpartition(".")[0] or key),
    st.text(min_size=1, max_size=20),
    st.lists(st.sampled_from("ab"), min_size=100, max_size=2000).map(".".join),
)


def tried(count, *strategies):
    """Return what calls a function with ``count`` examples of what the strategies give."""

    def run(function):
        made = 0

        @settings(max_examples=count, deadline=None, suppress_health_check=list(HealthCheck))
        @given(st.tuples(*strategies))
        def each(drawn):
            nonlocal made
            made += 1
            function(*drawn)

        each()
        assert made >= count

    return run


def outcome(*arguments):
    """Run the command in this process; return its status and what it says on stderr."""
    out, err = io.StringIO(), io.StringIO()
    began = time.process_time()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            status = main(arguments)
        except SystemExit as end:
            status = end.code
    assert time.process_time() - began < TIME_LIMIT
    return status, err.getvalue()


def hold(status, message):
    """Assert that the status is 0, or 2 with printable lines that blame the input."""
    assert status in (0, 2), message
    if status == 2:
        assert message.startswith("tribodyn: ")
        lines = message.splitlines()
        assert 1 <= len(lines) <= 22
        assert all(line.startswith("tribodyn: ") and line.isprintable() for line in lines)
        assert "internal error" not in message
        assert all(len(line) < 3000 for line in lines)


def run_for_a_moment(case, limit=HANGS):
    """Simulate the beginning of a valid case, or be told which key forbids it."""
    began = time.process_time()
    refusal = None
    try:
        brief = case.replace({"run.duration": f"{MOMENT} s", "run.output_interval": f"{MOMENT} s"})
        with contextlib.suppress(Stopped):
            simulate(brief, stop=lambda: time.process_time() - began > PATIENCE)
    except InputError as error:
        refusal = error
    assert refusal is None or refusal.key
    assert time.process_time() - began < limit


def quoted(text):
    """Return a TOML string."""
    escapes = {'"': '\\"', "\\": "\\\\"}
    return '"' + "".join(escapes.get(c, c if c.isprintable() else f"\\U{ord(c):08X}") for c in text) + '"'


def toml(value):
    """Return a value as TOML."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return quoted(value.encode("utf-8", "replace").decode())
    if isinstance(value, list):
        return f"[{', '.join(map(toml, value))}]"
    if isinstance(value, dict):
        return f"{{{', '.join(f'{toml(str(name))} = {toml(entry)}' for name, entry in value.items())}}}"
    return repr(value)


def dotted(path):
    return ".".join(
        part if part.isidentifier() and part.isascii() else toml(part) for part in path.split(".")
    )


entries = st.lists(st.tuples(paths, values), min_size=1, max_size=6)


def write(kind, changes):
    lines = [f"case = {toml(kind)}", *(f"{dotted(path)} = {toml(value)}" for path, value in changes)]
    return "\n".join(lines)


def check_file(folder, content):
    path = folder / "case.toml"
    path.write_bytes(content)
    status, message = outcome("check", str(path))
    hold(status, message)
    if status == 0:
        run_for_a_moment(load_case(path))
    else:
        assert "case.toml" in message
    return status


@pytest.mark.parametrize("count", [FEW, pytest.param(MANY, marks=pytest.mark.long(minutes=0.8))])
class TestFuzz:
    def test_files_with_random_keys_and_values(self, count, tmp_path):
        @tried(count, st.sampled_from([*kinds(), "vvs"]), entries)
        def run(kind, changes):
            check_file(tmp_path, write(kind, changes).encode())

    def test_files_with_real_keys_and_likely_values(self, count, tmp_path):
        @tried(count, st.data(), st.sampled_from(sorted(kinds())))
        def run(data, kind):
            keys = keys_of(kinds()[kind])
            chosen = data.draw(st.lists(st.sampled_from(sorted(keys)), min_size=1, max_size=5, unique=True))
            changes = [(path, data.draw(likely(keys[path]))) for path in chosen if path != "case"]
            check_file(tmp_path, write(kind, changes).encode())

    def test_damaged_files(self, count, tmp_path):
        whole = {name: load_case(name).to_toml(comments=True).encode() for name in built_in()}

        @tried(count, st.sampled_from(sorted(whole)), st.data())
        def run(name, data):
            text = whole[name]
            first = data.draw(st.integers(0, len(text)))
            last = data.draw(st.integers(first, len(text)))
            filling = data.draw(st.binary(max_size=20) | st.sampled_from([b"[" * 3000, b"\xff\xfe", b"\0"]))
            check_file(tmp_path, text[:first] + filling + text[last:])

    def test_random_bytes(self, count, tmp_path):
        @tried(count, st.binary(max_size=300))
        def run(content):
            assert check_file(tmp_path, content) == 2

    def test_set_on_the_command_line(self, count):
        options = st.one_of(
            st.builds(lambda path, value: f"{path}={value}", paths, scalars), st.text(max_size=60)
        )

        @tried(count, st.sampled_from(sorted(built_in())), st.lists(options, min_size=1, max_size=4))
        def run(name, changes):
            hold(*outcome("check", name, *(f"--set={change}" for change in changes)))


def likely(key):
    """Return values that a key might hold."""
    if key.kind == "quantity":
        near = st.floats(-2.0, 2.0).map(lambda power: f"{10.0**power} {key.unit}")
        return st.just(key.example) | near | st.floats(-500, 500).map(lambda v: f"{v} {key.unit}")
    if key.kind == "choice":
        return st.sampled_from(key.choices)
    return {
        "number": st.floats(0.0, 10.0),
        "count": st.integers(-2, 40),
        "switch": st.booleans(),
        "text": st.text(max_size=30),
    }.get(key.kind, odd_texts)
