"""Mechanisms led through their cycle: what clearance takes is allowed with a warning, the rest is refused."""

import pytest
from tests.unit.mechanism.four_bar import four_bar

from tribodyn.core.errors import InputError
from tribodyn.core.remembered import Remembered
from tribodyn.mechanism.assembly import passage as cycle
from tribodyn.mechanism.system import MechanismSystem


def test_mechanisms_are_led_through_again_where_ideal_joints_or_drives_differ(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    led: list[float] = []
    follow = cycle._stuck

    def counted(system: cycle.System, rank: int, duration: float) -> tuple[float, cycle.ModelError] | None:
        led.append(duration)
        return follow(system, rank, duration)

    monkeypatch.setattr(cycle, "_passed", Remembered(32))
    monkeypatch.setattr(cycle, "_stuck", counted)
    case = four_bar(real=("top",)).case()
    alike: dict[str, object] = {"joints.top.clearance.radial": "60 um", "surfaces.bushing.hardness": "3 GPa"}
    for changes in ({}, alike, {"drives.motor.speed": "500 rpm"}, {"run.duration": "30 ms"}, alike):
        MechanismSystem(case.replace(changes)).check()
    assert led == [0.02, 0.02, 0.03]
    with pytest.raises(InputError, match="motor has nothing to drive"):
        " ".join(MechanismSystem(four_bar(1e-3).case()).check())
