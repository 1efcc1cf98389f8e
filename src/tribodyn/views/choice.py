"""One of several figures of the same kind: which one is shown, a reader chooses."""

from __future__ import annotations

from collections.abc import Mapping

from tribodyn.views.section import Payload


def choice(widget: str, label: str, parts: Mapping[str, Payload | None]) -> Payload | None:
    """Return what the script ``choice`` reads; nothing where there is nothing to choose.

    Parameters
    ----------
    widget
        Script that draws each of them.
    label
        What is chosen.
    parts
        What that script reads, by name.
    """
    there = {name: part for name, part in parts.items() if part is not None}
    if not there:
        return None
    return {"widget": widget, "label": label, "names": list(there), "parts": list(there.values())}
