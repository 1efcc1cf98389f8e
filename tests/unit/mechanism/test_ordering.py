"""The order of elimination: cost linear in bodies, and pivots that are regular."""

import numpy as np
import pytest
from tests.unit.mechanism.drawings import chain, joint, mechanism, rod, with_springs

from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.assembly.records import mechanism_data


def star(n: int) -> Model:
    """Return a ring that turns about the ground, with n bodies hinged to it."""
    ways = [np.array([np.cos(a), np.sin(a), 0.0]) for a in 2.0 * np.pi * np.arange(n) / n]
    vanes = {f"vane {k}": rod(0.5 * way, way) for k, way in enumerate(ways)}
    ring = {"ring": rod((-0.5, 0.0, 0.0), (0.5, 0.0, 0.0))}
    hinges = {
        f"hinge {k}": joint("spherical", ("ring", f"vane {k}"), 0.5 * way) for k, way in enumerate(ways)
    }
    main = {"main": joint("revolute", ("ground", "ring"), (0.0, 0.0, 0.0))}
    return mechanism(ring | vanes, main | hinges)


def softened(model: Model) -> Model:
    """Return a mechanism whose joints are springs, so that nothing but bodies is eliminated."""
    return with_springs(model, 1.0, 1.0, 1.0)


@pytest.mark.parametrize("make", [chain, star])
@pytest.mark.parametrize("change", [lambda d: d, softened], ids=["ideal", "springs"])
def test_operations_grow_linearly(make: object, change: object) -> None:
    for which in ("mass", "newton"):
        counts = [
            [len(operations) for operations in getattr(mechanism_data(change(make(n))), which)[:3]]
            for n in (16, 32, 64)
        ]
        first, second = np.diff(counts, axis=0)
        assert np.all(second == 2 * first), (which, counts)
