"""The numbers of the ensemble: every claim measured on every member, a piece of work a member."""

import json
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any, Final, TypeAlias

from tribodyn.papers.cheng_2022.claims import CLAIMS
from tribodyn.papers.cheng_2022.claims.base import EARLY, IN, SLOW, Claim, EndedEarly, Trial
from tribodyn.papers.cheng_2022.claims.ensemble import FILE, LEFT_OUT, MEMBERS, SLOW_MEMBERS, Number
from tribodyn.papers.cheng_2022.runs import Runs
from tribodyn.results.store import write_text

#: Numbers and words of a member, each by claim and formulation.
Piece: TypeAlias = dict[str, dict[str, dict[str, Any]]]
_DIGITS: Final = 5


def measured(claim: Claim, trial: Trial) -> tuple[Number, str]:
    """Return the number that a claim measures on a trial, with five digits, and its words."""
    assert claim.measure is not None
    try:
        found = claim.measure(trial)
    except EndedEarly:
        return None, EARLY
    values = [float(f"{value:.{_DIGITS}g}") for value in found.span or (found.value,)]
    return (values[0], values[1]) if found.span else values[0], found.text


def of_member(member: int, slow: bool) -> Piece:
    """Return the numbers of a member by claim and formulation, each with every time left out, and words."""
    runs: dict[tuple[str, ...], Runs] = {}
    piece: Piece = {"numbers": {}, "texts": {}}
    for claim in CLAIMS:
        if claim.measure is None or (claim.leave == SLOW) != slow:
            continue
        own = runs.setdefault(claim.leave, Runs(changes=MEMBERS[member].changes(leave=claim.leave)))
        for name in IN[claim.formulations]:
            found = [measured(claim, Trial(own, name, late)) for late in LEFT_OUT]
            piece["numbers"].setdefault(claim.name, {})[name] = [number for number, _ in found]
            piece["texts"].setdefault(claim.name, {})[name] = found[0][1]
    return piece


def work() -> Iterator[tuple[int, bool]]:
    """Yield every piece of work: a member, and whether its slow claims."""
    yield from ((member, False) for member in range(len(MEMBERS)))
    yield from ((member, True) for member in SLOW_MEMBERS)


def measure(folder: Path, processes: int, note: Callable[[str], None]) -> Path:
    """Measure the members that a folder does not have yet, and write the whole as one file.

    ``folder``: where pieces are kept: what is there is not measured again; ``processes``: how many members
    are measured at once; ``note``: called with what was finished.
    """
    paths = {piece: folder / f"member-{piece[0]}{'-slow' if piece[1] else ''}.json" for piece in work()}
    missing = [piece for piece, path in paths.items() if not path.is_file()]
    with ProcessPoolExecutor(processes, mp_context=get_context("spawn")) as pool:
        running = {pool.submit(partial(of_member, *piece)): piece for piece in missing}
        for done in as_completed(running):
            write_text(paths[running[done]], json.dumps(done.result(), ensure_ascii=False))
            note(f"member {running[done][0]} of the ensemble is measured")
    whole: dict[str, dict[str, dict[str, Any]]] = {}
    for (member, _), path in paths.items():
        piece: Piece = json.loads(path.read_text(encoding="utf-8"))
        for claim, of_claim in piece["numbers"].items():
            for name, row in of_claim.items():
                kept = whole.setdefault(claim, {}).setdefault(name, {"text": "", "numbers": {}})
                kept["numbers"][str(member)] = row
                if member == 0:
                    kept["text"] = piece["texts"][claim][name]
    target = folder / FILE
    write_text(target, _lines(whole))
    return target


def _lines(whole: dict[str, dict[str, dict[str, Any]]]) -> str:
    """Return the whole as JSON, a line a claim and formulation."""
    claims = [
        f"{json.dumps(claim, ensure_ascii=False)}: {{\n"
        + ",\n".join(f'"{name}": {json.dumps(row, ensure_ascii=False)}' for name, row in of_claim.items())
        + "\n}"
        for claim, of_claim in whole.items()
    ]
    return "{\n" + ",\n".join(claims) + "\n}\n"
