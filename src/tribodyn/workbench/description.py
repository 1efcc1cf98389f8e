"""Description of a case for a page: its controls, key results and charts, and its editable tables."""

from functools import cache
from typing import Any, Final

from tribodyn.core.platforms import version
from tribodyn.mechanisms.catalogue import MECHANISMS, templates
from tribodyn.mechanisms.mechanism_protocol import MechanismDescriptor
from tribodyn.mechanisms.results import key_numbers_of, key_results_of_case
from tribodyn.results import KeyResult
from tribodyn.workbench.controls import controls
from tribodyn.workbench.edits import addable, removable
from tribodyn.workbench.variant import SAVED, Origin

#: Files of a run that a page can save; the last one of cases whose copies scatter.
DOWNLOADS: Final = (SAVED, "result.nc", "report.html", "builds.svg")


def description(origin: Origin) -> dict[str, Any]:
    """Return all that a page needs to know of a case before it is run."""
    case = origin.case
    mechanism = MECHANISMS[case.kind()]
    return {
        "title": case.title,
        "mechanism": case.kind(),
        "case": origin.name,
        "run": origin.varied({}).run,
        "version": version("tribodyn"),
        "controls": controls(case, mechanism.controls),
        "results": _key_results(origin),
        **_charts(mechanism),
        "templates": _templates(),
        "removable": removable(case),
        "addable": addable(case, mechanism),
        "downloads": list(DOWNLOADS if getattr(case, "scattered", None) else DOWNLOADS[:-1]),
    }


@cache
def _templates() -> dict[str, str]:
    """Return the titles of all templates by name."""
    return templates()


def _charts(mechanism: MechanismDescriptor) -> dict[str, Any]:
    """Return the chapters and figures of a report of the mechanism."""
    sections = [
        {
            "name": section.name,
            "title": section.title,
            "caption": section.caption,
            "widget": section.widget,
            "chapter": chapter.name,
            "playback": chapter.playback,
        }
        for chapter in mechanism.chapters
        for section in chapter.sections
    ]
    chapters = [
        {"name": chapter.name, "title": chapter.title, "lead": chapter.lead} for chapter in mechanism.chapters
    ]
    return {"chapters": chapters, "sections": sections}


def _key_results(origin: Origin) -> list[dict[str, Any]]:
    """Return the key results, robust ones first: those of impacts depend on the history."""
    known = key_results_of_case(origin.case)
    key = key_numbers_of(origin.case.case, known)
    place = {name: number for number, name in enumerate(key)}
    found = [_key_result(name, about, name in place) for name, about in known.items()]
    return sorted(found, key=lambda number: (not number["robust"], place.get(number["name"], len(key))))


def _key_result(name: str, about: KeyResult, key: bool) -> dict[str, Any]:
    """Return a key result as the page reads it."""
    return {
        "name": name,
        "label": about.label,
        "unit": about.unit,
        "group": about.group,
        "meaning": about.meaning,
        "digits": about.digits,
        "robust": not about.over,
        "key": key,
    }
