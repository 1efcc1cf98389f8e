"""The values that a slider would give next."""

from __future__ import annotations

from collections.abc import Iterator
from decimal import Decimal
from typing import Final

from tribodyn.core.errors import InputError
from tribodyn.workbench.controls import shown_number, turnable
from tribodyn.workbench.messages import Values
from tribodyn.workbench.ranges import track
from tribodyn.workbench.variant import Origin

_SIDES: Final = (1, -1)


def neighbours(origin: Origin, values: Values, before: Values) -> Iterator[dict[str, str]]:
    """Yield the values one step to either side, for the key that was turned last.

    Parameters
    ----------
    origin
        The case of the workbench.
    values, before
        Values of the last request and of the one before.
    """
    turned = [path for path in {**before, **values} if values.get(path) != before.get(path)]
    keys = turnable(origin.case)
    if len(turned) != 1 or turned[0] not in keys:
        return
    path, key = turned[0], keys[turned[0]]
    at_first = origin.case.at(path)
    if isinstance(at_first, bool) or not isinstance(at_first, int | float):
        return
    found = track(key, at_first)
    try:
        now = shown_number(key, origin.varied(values).case.at(path))
    except InputError:
        return
    if found is None or now is None:
        return
    step = Decimal(repr(found.step))
    for side in _SIDES:
        number = (round(Decimal(repr(now)) / step) + side) * step
        if found.least <= number <= found.greatest:
            yield {**values, path: f"{number.normalize():f} {key.unit}".strip()}
