"""Scripts of a page share one scope: each declares names of its own."""

import re
from collections import Counter
from importlib.resources import files

#: A report has scripts of the first alone; the workbench has those of both in one page.
FOLDERS = ("tribodyn.report.assets", "tribodyn.workbench.assets")
_DECLARED = re.compile(r"^(?:async\s+)?(?:function\*?|const|let|var|class)\s+(\w+)", re.M)


def test_no_name_is_declared_twice() -> None:
    scripts = [path for folder in FOLDERS for path in files(folder).iterdir() if path.name.endswith(".js")]
    names = Counter(name for path in scripts for name in _DECLARED.findall(path.read_text("utf-8")))
    assert len(names) > 5 * len(scripts)
    assert {name: number for name, number in names.items() if number > 1} == {}
    assert len({path.name for path in scripts}) == len(scripts)
