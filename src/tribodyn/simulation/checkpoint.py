"""A wear campaign on disk between two jumps.

One NumPy archive, without pickled objects, written beside its place and then renamed: a campaign that is
killed finds the last complete one.
"""

import json
import zipfile
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np

from tribodyn.core.errors import InputError
from tribodyn.core.files import open_regular
from tribodyn.core.platforms import provenance
from tribodyn.core.quoting import LONGEST, brief
from tribodyn.mechanisms.bushing import Carried
from tribodyn.results.store import replacing
from tribodyn.simulation.campaign import Campaign, columns

FORMAT: Final = 2
LARGEST: Final = 1_000_000_000  #: Size of a checkpoint that is read, at most [bytes].
_ARRAYS: Final = ("depth", "load", "stage_cycles", "stage_depth")


def write(path: Path, worn: Campaign, case: str) -> None:
    """Write a checkpoint whole or not at all.

    ``path``: the file; its folder must exist; ``worn``: what the campaign continues from; ``case``: text of
    the case, by which the campaign is known again.
    """
    assert worn.carried is not None
    facts = {
        "format": FORMAT,
        "case": case,
        "versions": provenance(),
        "cycles": worn.cycles,
        "statistics": worn.statistics,
    }
    arrays: dict[str, Any] = {name: getattr(worn, name) for name in _ARRAYS}
    arrays |= {"state": worn.carried.state, "entry_velocity": worn.carried.entry_velocity}
    arrays |= {"gain": worn.gain, "life": worn.life, "facts": json.dumps(facts)}
    arrays |= {f"history_{name}": values for name, values in worn.history.items()}
    with replacing(path) as part, part.open("wb") as stream:
        np.savez(stream, **arrays)


def read(
    path: Path, case: str, field_shape: tuple[int, ...], n_states: int, of_cycle: Iterable[str]
) -> tuple[Campaign, list[str]] | None:
    """Read a checkpoint, if there is one.

    Parameters
    ----------
    path
        The file.
    case
        Text of the case that is to be gone on with.
    field_shape, n_states
        Shape of a field over the nodes of that case, and length of its state. Compiled code looks at no
        shape: what reaches it must have the right one, whoever made the file.
    of_cycle
        What the mechanism writes down about each cycle, by name.

    Returns
    -------
    tuple or None
        What the campaign continues from, and warnings about it.

    Raises
    ------
    InputError
        If the file is of another case or cannot be read.
    """
    try:
        arrays, facts = _opened(path)
        known = facts["format"] == FORMAT
        worn = (
            _worn(arrays, facts, (field_shape, (n_states,)), columns(of_cycle))
            if known and facts["case"] == case
            else None
        )
        warnings = _changed(facts["versions"]) if known else []
    except FileNotFoundError:
        return None
    # A damaged archive makes its readers raise what they like, NotImplementedError among it.
    except Exception as error:
        raise _refused(path, f"it cannot be read ({brief(error, 2 * LONGEST)})") from error
    if not known:
        raise _refused(path, "it was written by another version of tribodyn")
    if worn is None:
        raise _refused(path, f"it holds {brief(facts['cycles'])} cycles of a campaign of another case")
    return worn, warnings


def is_of(path: Path, case: str) -> bool:
    """Return whether there is a checkpoint that can be read, of the case with this text."""
    try:
        return bool(_opened(path)[1]["case"] == case)
    except Exception:  # as in reading it
        return False


def _opened(path: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the arrays of a file, and what it says about itself."""
    with open_regular(path, LARGEST) as stream:
        with zipfile.ZipFile(stream) as archive:
            if any(member.compress_type != zipfile.ZIP_STORED for member in archive.infolist()):
                raise ValueError("it is compressed, which a checkpoint never is")
        stream.seek(0)
        with np.load(stream, allow_pickle=False) as loaded:
            arrays = dict(loaded)
    return arrays, dict(json.loads(str(arrays["facts"])))


def _worn(
    arrays: Mapping[str, Any],
    facts: Mapping[str, Any],
    of_case: tuple[tuple[int, ...], tuple[int, ...]],
    names: tuple[str, ...],
) -> Campaign:
    field_shape, state_shape = of_case
    jumps, stages = arrays[f"history_{names[0]}"].size, arrays["stage_cycles"].size
    shapes = {"depth": field_shape, "load": field_shape, "entry_velocity": field_shape, "state": state_shape}
    shapes |= {"stage_cycles": (stages,), "stage_depth": (stages, *field_shape)}
    shapes |= {f"history_{name}": (jumps,) for name in names}
    for name, shape in shapes.items():
        if arrays[name].shape != shape or arrays[name].dtype != np.float64:
            raise ValueError(f"{name} is no array of {shape} numbers")
        if not np.isfinite(arrays[name]).all():
            raise ValueError(f"{name} holds numbers that are not finite")
    return Campaign(
        cycles=int(facts["cycles"]),
        carried=Carried(arrays["state"], arrays["entry_velocity"]),
        gain=float(arrays["gain"]),
        life=float(arrays["life"]),
        history={name: arrays[f"history_{name}"] for name in names},
        statistics=facts["statistics"],
        **{name: arrays[name] for name in _ARRAYS},
    )


def _changed(versions: Mapping[str, str]) -> list[str]:
    """Say with which packages the campaign was begun, if they are others now."""
    begun = [
        f"{name.removesuffix('_version')} {old}"
        for name, old in versions.items()
        if provenance()[name] != old
    ]
    if not begun:
        return []
    names = brief(", ".join(begun), 3 * LONGEST)
    return [f"The campaign was begun with {names}: its later cycles were computed with others."]


def _refused(path: Path, reason: str) -> InputError:
    name = brief(path)
    return InputError(
        f"a wear campaign cannot continue from {name}: {reason}; choose another directory, or remove the "
        "file to begin anew",
        key="wear.cycles",
    )
