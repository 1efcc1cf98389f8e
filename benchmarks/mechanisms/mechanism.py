"""A drawn mechanism against the multibody code Exudyn: a slider-crank of ideal joints that runs freely.

python -m benchmarks.mechanisms.mechanism

Crank 50 mm, rod 120 mm, started at 5000 rpm without a drive, some eight turns: the crank slows down and
speeds up as the slider takes its energy and gives it back. Both have rigid bodies in space; Exudyn's joints
leave out what a flat mechanism has twice. Exudyn takes its default, the generalised-α method, with steps of
fixed length; we our default at falling tolerances, and keep balances and reactions besides. Errors are the
largest ones of the slider's place, against our own run at 1e-11: that Exudyn comes closer to it with every
shorter step is the agreement of both. Times are of the thread, rows 0.2 ms apart, without compilation and
without making the model; the least of five, which others disturb least.
"""

from __future__ import annotations

import time
from importlib.util import find_spec
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

import tribodyn as td
from tribodyn.integrate import integrate
from tribodyn.mechanism.mechanism_variables import observed
from tribodyn.mechanism.system import MechanismSystem

FloatArray = NDArray[np.float64]

DURATION: Final = 0.096
EVERY: Final = 2e-4  #: Time between rows [s], a multiple of Exudyn's steps.
TOLERANCES: Final = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
EXACT: Final = 1e-11
STEPS: Final = (1e-4, 4e-5, 2e-5, 1e-5, 5e-6)  #: Of Exudyn [s].
PAIRS: Final = 5
SPECTRAL_RADIUS: Final = 0.9  #: Of the generalised-α method, Exudyn's default.
SPEED: Final = 2.0 * np.pi * 5000.0 / 60.0


def run(quick: bool = False) -> dict[str, Any]:
    """Measure, print ratios and return everything; ``quick``: over a moment, for nothing but a trial."""
    duration = DURATION / 10.0 if quick else DURATION
    exact = ours(EXACT, duration)[0]
    found: dict[str, Any] = {"ours": [], "exudyn": []}
    for rtol in TOLERANCES[:2] if quick else TOLERANCES:
        found["ours"].append(_row("tribodyn", f"rtol {rtol:.0e}", rtol, ours, duration, exact, quick))
    if find_spec("exudyn") is None:
        print("without Exudyn: pip install tribodyn[bench]")
        return found
    for step in STEPS[:1] if quick else STEPS:
        found["exudyn"].append(
            _row("Exudyn", f"{step * 1e6:g} µs", step, with_exudyn, duration, exact, quick)
        )
    found["ratios"] = _ratios(found)
    for ratio in found["ratios"]:
        print(f"at {ratio['error'] * 1e6:.2g} µm Exudyn takes {ratio['ratio']:.2g} times as long as we")
    return found


def _row(
    name: str, setting: str, value: float, solve: Any, duration: float, exact: FloatArray, quick: bool
) -> dict[str, Any]:
    """Return and print cost and error of a setting; the least of some times, which others disturb."""
    done = [solve(value, duration) for _ in range(1 if quick else PAIRS)]
    seconds = min(one[1] for one in done)
    error = float(np.max(np.abs(done[0][0] - exact)))
    print(f"{name:10s} {setting:12s} {seconds:8.4f} s {error:9.2e} m", flush=True)
    return {"setting": setting, "seconds": seconds, "error": error}


def _ratios(found: dict[str, Any]) -> list[dict[str, float]]:
    """Return Exudyn's times over ours at its errors, ours on a logarithmic line between tolerances."""
    error, seconds = (np.log([row[key] for row in found["ours"]])[::-1] for key in ("error", "seconds"))
    return [
        {
            "error": row["error"],
            "ratio": row["seconds"] / float(np.exp(np.interp(np.log(row["error"]), error, seconds))),
        }
        for row in found["exudyn"]
    ]


#: Mass [kg], place of the centre on the line that all lie on as drawn [m], principal moments [kg m²].
BODIES: Final = {
    "crank": (0.3, 0.0, (1e-4, 1e-4, 1e-4)),
    "rod": (0.21, 0.11, (2e-5, 2.5e-4, 2.5e-4)),
    "slider": (0.14, 0.17, (1e-4, 1e-4, 1e-4)),
}
#: Name, type, bodies, place [m], and the axes that Exudyn holds: of a flat mechanism each once.
JOINTS: Final = (
    ("main", "revolute", "ground", "crank", 0.0, (1, 1, 1, 1, 1, 0)),
    ("crankpin", "revolute", "crank", "rod", 0.05, (1, 1, 1, 1, 1, 0)),
    ("wrist", "revolute", "rod", "slider", 0.17, (1, 1, 0, 0, 0, 0)),
    ("guide", "prismatic", "ground", "slider", 0.17, (0, 1, 1, 1, 1, 1)),
)


def times(duration: float) -> FloatArray:
    """Return the times of rows [s], shape (n_t,)."""
    return np.linspace(0.0, duration, round(duration / EVERY) + 1)


def ours(rtol: float, duration: float) -> tuple[FloatArray, float]:
    """Return the places of the slider [m], shape (n_t,), and the seconds of the thread."""
    drawn = td.Mechanism("Slider-crank", run={"duration": f"{duration} s"}, solver={"rtol": rtol})
    for name, (mass, place, inertia) in BODIES.items():
        moments = [f"{moment} kg m^2" for moment in inertia]
        drawn.body(name, mass=f"{mass} kg", centre=[f"{place} m", "0 m", "0 m"], inertia=moments)
    for name, kind, first, second, place, _ in JOINTS:
        axis = [0, 0, 1] if kind == "revolute" else [1, 0, 0]
        speed = {"start_speed": f"{SPEED} rad/s"} if name == "main" else {}
        getattr(drawn, kind)(name, first, second, point=[f"{place} m", "0 m", "0 m"], axis=axis, **speed)
    problem = MechanismSystem(drawn.case()).problem(duration)
    begin = time.thread_time()
    solution = integrate(problem, rtol=rtol, output_times=times(duration))
    seconds = time.thread_time() - begin
    assert solution.failure is None
    return observed(solution.rows, len(BODIES)).bodies["position"][:, 2, 0], seconds


def with_exudyn(step: float, duration: float) -> tuple[FloatArray, float]:
    """Return the same from Exudyn."""
    import exudyn as exu
    import exudyn.itemInterface as items

    container = exu.SystemContainer()
    mbs = container.AddSystem()
    bodies = {"ground": (mbs.AddObject(items.ObjectGround()), 0.0)}
    # The crank turns, the rod swings about the wrist, the slider is at rest.
    speeds = {
        "crank": (0.0, SPEED),
        "rod": (0.05 * SPEED * 0.06 / 0.12, -0.05 * SPEED / 0.12),
        "slider": (0.0, 0.0),
    }
    for name, (mass, place, inertia) in BODIES.items():
        across, turning = speeds[name]
        node = mbs.AddNode(
            items.NodeRigidBodyRxyz(
                referenceCoordinates=[place, 0.0, 0.0, 0.0, 0.0, 0.0],
                initialVelocities=[0.0, across, 0.0, 0.0, 0.0, turning],
            )
        )
        moments = [*inertia, 0.0, 0.0, 0.0]
        body = items.ObjectRigidBody(mass=mass, inertia=moments, nodeNumber=node)
        bodies[name] = mbs.AddObject(body), place
    for _, _, first, second, place, held in JOINTS:
        markers = [
            mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=number, localPosition=[place - at, 0.0, 0.0]))
            for number, at in (bodies[first], bodies[second])
        ]
        mbs.AddObject(items.ObjectJointGeneric(markerNumbers=markers, constrainedAxes=list(held)))
    kind = exu.OutputVariableType.Position
    sensor = mbs.AddSensor(
        items.SensorBody(bodyNumber=bodies["slider"][0], storeInternal=True, outputVariableType=kind)
    )
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps = round(duration / step)
    settings.timeIntegration.endTime = duration
    settings.timeIntegration.generalizedAlpha.spectralRadius = SPECTRAL_RADIUS
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = EVERY
    begin = time.thread_time()
    mbs.SolveDynamic(settings)
    seconds = time.thread_time() - begin
    rows = mbs.GetSensorStoredData(sensor)
    np.testing.assert_allclose(rows[:, 0], times(duration), atol=1e-9 * duration)
    return np.asarray(rows[:, 1]), seconds


if __name__ == "__main__":
    run()
