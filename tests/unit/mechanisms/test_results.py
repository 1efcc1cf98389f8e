"""Which key results of a kind of results come first."""

from tribodyn.mechanisms.results import key_numbers_of


def test_errors_of_outputs_come_before_forces() -> None:
    names = [
        "peak_pressure_MPa",
        "joint_force_sustained_N",
        "error_max_um_slider",
        "error_sustained_um_slider",
    ]
    assert key_numbers_of("mechanism", names) == [
        "error_sustained_um_slider",
        "joint_force_sustained_N",
        "peak_pressure_MPa",
    ]


def test_a_kind_that_is_not_known_has_none() -> None:
    assert key_numbers_of("sweep", ["peak_pressure_MPa"]) == []
