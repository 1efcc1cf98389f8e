"""The manual without a network: formulas are drawn, no other origin is asked, no page is too wide."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Request

pytest.importorskip("sphinx", reason="the manual needs the extra docs")
pytestmark = pytest.mark.long  # `make check` runs it

DOCS = Path(__file__).parents[2] / "docs"
PAGES = ("index", "theory/contact", "guide/materials")
DRAWN = """() => {
  const below = [...document.querySelectorAll('msub')].filter((one) => {
    const [base, index] = [...one.children].map((child) => child.getBoundingClientRect());
    return index.bottom > base.bottom + 1;
  });
  const flat = [...document.querySelectorAll('math')].filter((one) => one.getBoundingClientRect().height < 5);
  return {below: below.length, all: document.querySelectorAll('msub').length, flat: flat.length};
}"""


@pytest.fixture(scope="module")
def manual(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build three pages as they stand, without running what is in them; the rest of the manual is missing."""
    source, target = (tmp_path_factory.mktemp(name) for name in ("docs", "html"))
    for name in ("conf.py", "_ext", "_static"):
        copy = shutil.copytree if (DOCS / name).is_dir() else shutil.copy
        copy(DOCS / name, source / name)
    for page in PAGES:
        (source / page).parent.mkdir(exist_ok=True)
        shutil.copy(DOCS / f"{page}.md", source / f"{page}.md")
    options = ["-q", "-b", "html", "-D", "nb_execution_mode=off", "-D", "exclude_patterns=reference"]
    subprocess.run(
        [sys.executable, "-m", "sphinx", *options, source, target], check=True, capture_output=True
    )
    return target


@pytest.mark.parametrize("width", [1280, 400])
@pytest.mark.parametrize("page", PAGES)
def test_a_page_needs_no_network(page: str, width: int, manual: Path, browser: Browser) -> None:
    asked: list[str] = []
    with browser.new_context(viewport={"width": width, "height": 900}, offline=True) as context:
        opened = context.new_page()

        def note(request: Request) -> None:
            asked.append(request.url)

        opened.on("request", note)
        opened.goto((manual / f"{page}.html").as_uri())
        drawn = opened.evaluate(DRAWN)
        text = opened.inner_text("body")
        overflow = opened.evaluate("document.documentElement.scrollWidth - window.innerWidth")
    assert [url for url in asked if not url.startswith(("file:", "data:"))] == []
    assert overflow <= 0
    assert "\\frac" not in text
    assert drawn["flat"] == 0
    if page.startswith("theory"):
        # A few indices hang from tall bases.
        assert drawn["below"] > 0.9 * drawn["all"] > 20
