"""The joint kernels against the same integral written with NumPy: nanoseconds for a node in contact.

python -m benchmarks.vane.joint_kernel
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from benchmarks.vane.numpy_joint import arrays_of, numpy_wrench
from benchmarks.vane.repeated import many_jacobians, many_wrenches
from tribodyn.joints import BushingJoint, Grid
from tribodyn.joints.bushing import joint_wrench, new_memory, pose_at
from tribodyn.kernels.joints.bushing import pressure_field, update_entry_velocity
from tribodyn.kernels.joints.pose import N_MOTION, N_WRENCH
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.papers.cheng_2022.reduced.system import vsv_of

#: Attitude and rates while the vane turns under load, a tilted trunnion [m, rad, m/s, rad/s].
STATE = np.array([-3.9e-6, 6.57e-6, 6.46e-4, 1.31e-3, 3.6e-6, -2.4e-6, -2.8e-4, 3.8e-4])
OMEGA = 0.3
GRIDS = ((48, 8), (96, 16), (192, 16), (256, 32), (512, 64))
PAIRS, CALLS = 7, 50


def microseconds(call: Callable[[], object], calls: int = CALLS) -> float:
    """Return the time of the thread for one call [µs]."""
    begin = time.thread_time()
    for _ in range(calls):
        call()
    return 1e6 * (time.thread_time() - begin) / calls


def measure(joint: BushingJoint) -> dict[str, float]:
    """Return nodes in contact and times of a call on one grid, medians of alternated runs."""
    data, field = joint.data(), np.empty(joint.field_shape)
    arrays = arrays_of(joint)
    memory, pose = new_memory(data), pose_at(STATE, omega=OMEGA)
    update_entry_velocity(data, memory, pose, 1.0)
    pressure_field(data, memory, pose, field)
    entry, out, jacobian = memory.entry_velocity, np.empty(N_WRENCH), np.empty((N_WRENCH, N_MOTION))
    # Called from Python, a kernel first takes its arguments apart: 25 µs that a compiled caller does not see.
    many_wrenches(data, memory, pose, out, 1)
    many_jacobians(data, memory, pose, out, jacobian, 1)
    alone = joint_wrench(data, STATE, omega=OMEGA, entry_velocity=entry)
    np.testing.assert_allclose(numpy_wrench(arrays, entry, STATE, OMEGA)[0], alone, rtol=1e-9)
    times: dict[str, list[float]] = {"wrench": [], "with Jacobian": [], "numpy": []}
    for _ in range(PAIRS):
        once = microseconds(lambda: many_wrenches(data, memory, pose, out, 200), 1)
        times["wrench"].append(once / 200)
        once = microseconds(lambda: many_jacobians(data, memory, pose, out, jacobian, 200), 1)
        times["with Jacobian"].append(once / 200)
        times["numpy"].append(microseconds(lambda: numpy_wrench(arrays, entry, STATE, OMEGA)))
    result = {name: float(np.median(values)) for name, values in times.items()}
    nodes = int(np.count_nonzero(field[1:-1]))
    return {"all nodes": float(field[1:-1].size), "nodes in contact": float(nodes), **result}


def run(quick: bool = False) -> dict[str, Any]:
    """Measure on all grids and print; ``quick``: on the coarsest alone."""
    joint = vsv_of(load_case("vsv")).joint
    results = {}
    print("grid       in contact   wrench [ns/node]   with Jacobian   numpy/wrench")
    for theta, z in GRIDS[: 1 if quick else None]:
        found = measure(replace(joint, grid=Grid(theta, z)))
        results[f"{theta} × {z}"] = found
        nodes = found["nodes in contact"]
        per_node = [1e3 * found[name] / nodes for name in ("wrench", "with Jacobian")]
        ratio = found["numpy"] / found["wrench"]
        print(f"{theta:4d} x {z:<3d} {nodes:9.0f} {per_node[0]:16.1f} {per_node[1]:16.1f} {ratio:14.1f}")
    return results


if __name__ == "__main__":
    run()
