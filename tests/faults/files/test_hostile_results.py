"""Results from strangers whose every text is markup: no page takes any of it for its own."""

import base64
import gzip
import json
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.report import ComparedRun, write, write_comparison
from tribodyn.simulation import simulate
from tribodyn.studies import sweep

MARKUP = '</script></style></title><script>alert(1)</script><img src="x" onerror="alert(1)">{{ 7*7 }}\u2028'
NEEDED = {"kind"}  #: Texts that choose what a page is made of; another one would only choose another page.


class Page(HTMLParser):
    """Elements of a page with the names of their attributes, and what its scripts hold."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.elements: list[tuple[str, ...]] = []
        self.scripts: list[str] = []
        self._in_script = False
        self.feed(path.read_text(encoding="utf-8"))
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, *sorted(name for name, _ in attrs)))
        self._in_script = tag == "script"
        if self._in_script:
            self.scripts.append("")

    def handle_endtag(self, tag: str) -> None:
        self._in_script = self._in_script and tag != "script"

    def handle_data(self, data: str) -> None:
        if self._in_script:
            self.scripts[-1] += data


def spoiled_text(text: str) -> str:
    """Return markup in the place of a text; JSON stays JSON, with markup in all its texts."""
    try:
        return json.dumps(spoiled_json(json.loads(text)))
    except ValueError:
        return MARKUP


def spoiled_json(value: object) -> object:
    if isinstance(value, dict):
        return value | {MARKUP: MARKUP}
    if isinstance(value, list):
        return [MARKUP]
    return MARKUP if isinstance(value, str) else value


def spoiled(dataset: xr.Dataset) -> xr.Dataset:
    """Return a result with markup in each of its texts: attributes, their names, coordinates, units."""
    other = dataset.copy(deep=True)
    for name, value in dataset.attrs.items():
        if isinstance(value, str) and name not in NEEDED:
            other.attrs[name] = spoiled_text(value)
    other.attrs[f"{MARKUP}_version"] = MARKUP
    for name in dataset.variables:
        texts = [key for key, value in dataset[name].attrs.items() if isinstance(value, str)]
        other[name].attrs.update(dict.fromkeys(texts, MARKUP))
        if dataset[name].dtype.kind in "UO":
            other[name] = (dataset[name].dims, np.full(dataset[name].shape, MARKUP), other[name].attrs)
    return other


@pytest.fixture(scope="module")
def each() -> dict[str, xr.Dataset]:
    """Return one brief result of each kind."""
    brief = {"run.duration": "2 ms", "run.output_interval": "0.1 ms"}
    vsv = load_case("vsv").replace(brief)
    return {
        "vsv": simulate(vsv),
        "mechanism": simulate(load_case("slider-crank").replace({"run.cycles": 0.01})),
        "sweep": sweep(vsv, {"joint.clearance": "20,30 um", "contact.law": "ke,rsdc"}, workers=0),
    }


def assert_harmless(path: Path, innocent: Path) -> None:
    """Assert that a page has the elements of an innocent one, and scripts but no new ones."""
    page, other = Page(path), Page(innocent)
    new = set(page.elements) - set(other.elements)
    assert not [element for element in new if element[0] in {"script", "img", "iframe", "object", "base"}]
    assert not [name for element in page.elements for name in element[1:] if name.startswith("on")]
    assert len(page.scripts) == len(other.scripts)
    # Data first, then ours: those are the same to the byte, or the content policy would not run them.
    assert page.scripts[1:] == other.scripts[1:]
    if page.scripts:
        content = gzip.decompress(base64.b64decode(page.scripts[0], validate=True))
        json.loads(content[8 : 8 + int.from_bytes(content[:8], "little")])


@pytest.mark.parametrize("kind", ["vsv", "mechanism", "sweep"])
def test_no_text_of_a_result_becomes_part_of_its_page(kind, each, tmp_path):
    (tmp_path / "good").mkdir()
    (tmp_path / "bad").mkdir()
    innocent = write(each[kind], tmp_path / "good", figures=())
    assert_harmless(write(spoiled(each[kind]), tmp_path / "bad", figures=()), innocent)


@pytest.mark.parametrize(
    ("kind", "name"),
    [
        *(("mechanism", name) for name in ("row_place", "column_angle", "reaction_force", "clearance")),
        *(("vsv", name) for name in ("snapshot_theta_v", "theta_v", "pressure_cycle")),
    ],
)
def test_a_result_that_lacks_a_variable_is_refused_by_its_name_or_does_without(kind, name, each, tmp_path):
    try:
        write(each[kind].drop_vars(name), tmp_path, figures=())
    except InputError as error:
        assert f"lacks the variable {name}; it is damaged" in str(error)  # noqa: PT017


def test_no_text_of_two_results_becomes_part_of_their_comparison(each, tmp_path):
    good = [ComparedRun("one", each["vsv"]), ComparedRun("two", each["vsv"])]
    bad = [ComparedRun("one", spoiled(each["vsv"])), ComparedRun(MARKUP, each["vsv"])]
    innocent = write_comparison(good, tmp_path / "good.html")
    assert_harmless(write_comparison(bad, tmp_path / "bad.html"), innocent)
