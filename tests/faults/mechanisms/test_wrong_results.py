"""Results that are whole files, but wrong ones: refused with the reason, or used without an internal error.

Each mutation changes one thing about one variable or attribute of a real result. The command that reads it
runs in a process of its own, which is watched.
"""

import random
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from tests.faults.trial import Watched, tolerable

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.mechanisms.results import write_run
from tribodyn.results import netcdf_content
from tribodyn.simulation import simulate
from tribodyn.studies import sweep

FEW, PARTS, EACH = 5, 14, 143
DRAWN = 0.2  #: Share of the runs whose figures are drawn too, which takes thirty times as long as all else.
Mutation = Callable[[xr.Dataset, str], xr.Dataset]


def with_values(dataset: xr.Dataset, name: str, values: Any, dims: Any = None) -> xr.Dataset:
    """Return a dataset with other values of a variable, over other dimensions if asked."""
    old = dataset.variables[name]
    new = xr.Variable(old.dims if dims is None else dims, values, old.attrs)
    return _rebuilt(dataset, {**dict(dataset.variables), name: new})


def _rebuilt(dataset: xr.Dataset, variables: dict[Any, xr.Variable]) -> xr.Dataset:
    """Return a dataset of any variables: what was a coordinate stays one where it can."""
    coords = [name for name in dataset.coords if name in variables and name not in variables[name].dims]
    return xr.Dataset({k: v.copy(deep=False) for k, v in variables.items()}, attrs=dataset.attrs).set_coords(
        [name for name in coords if name in variables]
    )


def filled(value: Any) -> Mutation:
    return lambda d, name: with_values(d, name, np.full(d[name].shape, value))


def one_place(value: float) -> Mutation:
    def mutate(dataset: xr.Dataset, name: str) -> xr.Dataset:
        values = np.array(dataset[name].values)
        values.reshape(-1)[values.size // 2 : values.size // 2 + 1] = value
        return with_values(dataset, name, values)

    return mutate


def transposed(dataset: xr.Dataset, name: str) -> xr.Dataset:
    return with_values(dataset, name, dataset[name].values.T, dataset[name].dims[::-1])


def other_dims(dataset: xr.Dataset, name: str) -> xr.Dataset:
    return with_values(dataset, name, dataset[name].values, [f"other_{d}" for d in dataset[name].dims])


VARIABLES: dict[str, Mutation] = {
    "dropped": lambda d, name: d.drop_vars(name),
    "scalar": lambda d, name: with_values(d, name, np.float64(1.0), ()),
    "empty": lambda d, name: with_values(d, name, np.empty(0), (f"none_of_{name.replace('.', '_')}",)),
    "transposed": transposed,
    "other dimensions": other_dims,
    "renamed": lambda d, name: d.rename({name: f"{name}_new"}),
    "texts": filled("many"),
    "whole numbers": filled(3),
    "truth": filled(True),
    "all nan": filled(np.nan),
    "one nan": one_place(np.nan),
    "one inf": one_place(np.inf),
    "one huge": one_place(1e308),
    "one large": one_place(-1e59),
    "all zero": filled(0.0),
    "all inf": filled(np.inf),
    "one place only": lambda d, name: d.isel({dim: slice(0, 1) for dim in d[name].dims}),
    "no place": lambda d, name: d.isel({dim: slice(0, 0) for dim in d[name].dims}),
    "backwards": lambda d, name: (
        with_values(d, name, np.array(d[name].values)[..., ::-1].copy()) if d[name].ndim else d
    ),
    "another unit": lambda d, name: d.assign({name: d[name].assign_attrs(units="furlong")}),
    "a number as name": lambda d, name: d.assign({name: d[name].assign_attrs(long_name=1e308)}),
    "scale 0": lambda d, name: d.assign({name: d[name].assign_attrs(shown_scale=0.0)}),
}
ATTRIBUTES: dict[str, Any] = {
    "huge": 1e308,
    "nan": np.nan,
    "inf": np.inf,
    "zero": 0,
    "below zero": -1.0,
    "empty": "",
    "text": "many",
    "long": "x" * 2_000_000,
    "numbers": np.array([1.0, 2.0, 3.0]),
    "texts": ["a", "b"],
    "deep JSON": "[" * 100_000,
    "JSON": '{"a": [1]}',
    "JSON list": "[1, null]",
    "JSON table": '{"steps": null, "wall_time": "long"}',
    "sweep": "sweep",
    "mechanism": "mechanism",
    "vsv": "vsv",
}


def without(dataset: xr.Dataset, name: str) -> xr.Dataset:
    other = dataset.copy(deep=False)
    other.attrs = {key: value for key, value in dataset.attrs.items() if key != name}
    return other


def mutants(dataset: xr.Dataset) -> Iterator[tuple[str, Callable[[], xr.Dataset]]]:
    """Give what can be done to a result, with its name."""
    for name in map(str, dataset.variables):
        for what, mutation in VARIABLES.items():
            yield f"{name}: {what}", lambda mutation=mutation, name=name: mutation(dataset, name)
    for name in (*map(str, dataset.attrs), "kind", "cycle_period", "never_heard_of"):
        yield f"{name}: dropped", lambda name=name: without(dataset, name)
        for what, value in ATTRIBUTES.items():
            yield f"{name}: {what}", lambda name=name, value=value: dataset.assign_attrs({name: value})


@pytest.fixture(scope="module")
def originals(tmp_path_factory: pytest.TempPathFactory) -> dict[str, xr.Dataset]:
    """Return one brief result of each kind."""
    brief = {"run.duration": "2 ms", "run.output_interval": "0.2 ms"}
    vsv, mechanism = (load_case(name).replace(brief) for name in ("vsv", "slider-crank"))
    kept = {"joint.clearance": "20,30 um", "contact.law": "ke,rsdc"}
    return {"vsv": simulate(vsv), "mechanism": simulate(mechanism), "sweep": sweep(vsv, kept, workers=0)}


def written(dataset: xr.Dataset, kind: str, folder: Path) -> bool:
    """Write a mutant where the commands look for it; False where no file can hold it."""
    try:
        content = netcdf_content(dataset)
    except Exception:
        return False
    (folder / ("sweep.nc" if kind == "sweep" else "result.nc")).write_bytes(content)
    return True


def commands(kind: str, folder: Path, drawn: bool) -> list[list[str]]:
    report = ["report", str(folder), "--quiet", "--json"]
    compare = ["compare", str(folder), str(folder.parent / "good"), "-o", str(folder.parent / "c.html")]
    if kind == "sweep":
        return [report]
    return [compare, report] if drawn else [compare]


def try_mutants(
    chosen: list[tuple[str, str, Callable[[], xr.Dataset]]],
    chance: random.Random,
    folder: Path,
    process: Watched,
) -> dict:
    statuses: dict[tuple[str, int], int] = {}
    worst = {"seconds": 0.0, "megabytes": 0.0}
    failed = []
    for kind, name, make in chosen:
        try:
            mutant = make()
        except Exception:
            continue
        inner = folder / kind
        inner.mkdir(exist_ok=True)
        if not written(mutant, kind, inner):
            continue
        for command in commands(kind, inner, chance.random() < DRAWN):
            outcome = process.run(command)
            what = (command[0], outcome.status)
            statuses[what] = statuses.get(what, 0) + 1
            worst = {key: max(value, getattr(outcome, key)) for key, value in worst.items()}
            if not tolerable(outcome):
                failed.append((kind, name, command[0], outcome))
            if outcome.status:
                break
    return {"statuses": statuses, **worst, "failed": failed}


# In parts, each a test: what takes an hour shows how far it is.
@pytest.mark.parametrize(
    ("part", "count"),
    [(-1, FEW), *(pytest.param(part, EACH, marks=pytest.mark.long(minutes=4.5)) for part in range(PARTS))],
)
def test_wrong_results_are_refused_or_harmless(part, count, originals, tmp_path, process):
    every = [(kind, name, make) for kind, whole in originals.items() for name, make in mutants(whole)]
    shuffled = random.Random(0).sample(every, len(every))
    chosen, chance = shuffled[part * EACH :][:count], random.Random(part)
    write_run(originals["vsv"], tmp_path / "good")
    found = try_mutants(chosen, chance, tmp_path, process)
    print(found)
    assert not found["failed"], found
    refused = sum(number for (_, status), number in found["statuses"].items() if status == 2)
    assert refused > count // 4, found
