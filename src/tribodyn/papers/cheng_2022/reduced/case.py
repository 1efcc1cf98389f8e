"""The variable stator vane mechanism with one clearance joint: its keys and its cross-checks."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, ClassVar, Final, Literal, Self

from tribodyn.cases.case import Group, demand
from tribodyn.cases.fields import choice, count, number, quantity, tables, text
from tribodyn.cases.followed_tables import FollowedTable, followed
from tribodyn.cases.groups import Solver, check_output_interval
from tribodyn.cases.joint_keys import CONFORMAL, Wear
from tribodyn.cases.keys import ASSUMED, Value
from tribodyn.cases.loads import Doors
from tribodyn.cases.rough import BushingCase
from tribodyn.cases.temperature import OVER_TIME, cold_geometry, time_followed, times_of
from tribodyn.core.errors import Faults
from tribodyn.mechanisms.bushing import grid_of
from tribodyn.mechanisms.output_keys import ERROR_LIMIT_OF, instants_of, wear_limits_of
from tribodyn.papers.cheng_2022.reduced.actions import (
    COMPONENTS,
    DRIVE_TABLES,
    CrankKeys,
    Surge,
    VaneLoad,
    VanePassing,
)
from tribodyn.papers.cheng_2022.reduced.key_results import DEFAULT, VaneOutput

if TYPE_CHECKING:
    from tribodyn.papers.cheng_2022.reduced.parameters import AnyDrive, Lengths

TABLE_2 = "paper, Table 2"
TABLE_3 = "paper, Table 3"


class MechanismKeys(Group):
    """Crank, drag link, unison ring, lever with vane."""

    formulation: Literal["exact", "paper", "printed"] = choice(
        "exact",
        "one consistent set of equations, the paper's with mended entries, or the paper's as printed",
        "manual, the mechanism",
    )
    crank_length: float = quantity("47.7 mm", "length of the crank l_1", TABLE_2, gt=0)
    drag_link_length: float = quantity("142.4 mm", "length of the drag link l_2", TABLE_2, gt=0)
    ring_radius: float = quantity("400 mm", "radius of the unison ring l_3", TABLE_2, gt=0)
    lever_length: float = quantity("50 mm", "length of the lever arm l_4", TABLE_2, gt=0)
    vane_length: float = quantity("160 mm", "length of the vane with trunnion l_v", TABLE_2, gt=0)
    pivot_distance: float = quantity(
        "500 mm", "distance of the crank pivot from the casing axis l_m", TABLE_2, gt=0
    )
    pivot_angle: float = quantity(
        "20 deg", "direction of the crank pivot gamma", TABLE_2, ge="-180 deg", le="180 deg"
    )
    ring_angle: float = quantity(
        "55 deg", "drag link's joint on the ring phi", TABLE_2, ge="-180 deg", le="180 deg"
    )
    crank_mass: float = quantity("0.82 kg", "mass of the crank m_1", TABLE_2, gt=0)
    drag_link_mass: float = quantity("0.1232 kg", "mass of the drag link m_2", TABLE_2, gt=0)
    ring_mass: float = quantity("0.6744 kg", "mass of the unison ring m_3", TABLE_2, gt=0)
    vane_mass: float = quantity(
        "0.253 kg", "mass of the vane with lever and trunnion m_v", "paper, Table 1 and section 4.1", gt=0
    )
    crank_inertia: float = quantity(
        "6.22e-4 kg m^2", "crank, about its end J_1; m l^2/3 where mass or length is given", TABLE_2, gt=0
    )
    drag_link_inertia: float = quantity(
        "8.33e-4 kg m^2", "drag link, about its end J_2; as for the crank", TABLE_2, gt=0
    )
    ring_inertia: float = quantity("7.20e-2 kg m^2", "unison ring, about the casing axis J_3", TABLE_2, gt=0)
    vane_inertia: float = quantity(
        "2.16e-3 kg m^2", "vane across its axis, about its end J_v; as for the crank", TABLE_2, gt=0
    )
    vane_spin_inertia: float = quantity(
        "2.16e-3 kg m^2", "vane about its axis; as printed, though it breaks I_z <= I_x + I_y", TABLE_2, gt=0
    )
    gravity: float = quantity("9.81 m/s^2", "acceleration of gravity", ASSUMED, ge=0)


_RODS: Final = ("crank", "drag_link", "vane")


def _rod_inertias(given: Mapping[str, Value]) -> dict[str, Value]:
    """Return m l²/3 of every rod whose mass or length is given; Table 2 has it so, rounded."""
    found: dict[str, Value] = {}
    for rod in _RODS:
        keys = [f"{rod}_mass", f"{rod}_length"]
        mass, length = (
            given.get(f"mechanism.{key}", MechanismKeys.model_fields[key].default) for key in keys
        )
        assert isinstance(mass, float)
        assert isinstance(length, float)
        if any(f"mechanism.{key}" in given for key in keys) and mass > 0.0 and length > 0.0:
            found[f"mechanism.{rod}_inertia"] = mass * length * length / 3.0
    return found


class VsvLoadKeys(Group):
    """Aerodynamic loads on the vane."""

    air_force_x: float = quantity(
        "0.4 N", "aerodynamic force along X, F_airx; its sign follows the vane angle", TABLE_3
    )
    air_force_y: float = quantity("1.2 N", "aerodynamic force along Y, F_airy", TABLE_3)
    air_moment: float = quantity(
        "0.84 N m", "aerodynamic moment M_air; it opposes the motion of the vane", TABLE_3
    )
    switch_angle: float = quantity("90 deg", "vane angle at which F_airx changes sign", TABLE_3)
    switch_width: float = quantity("0.01 rad", "width of that change", ASSUMED, gt=0)
    more: Mapping[str, VaneLoad] = tables("loads from tables, beside these")
    passing: Mapping[str, VanePassing] = tables("excitation by blades that pass")
    pulses: Mapping[str, Surge] = tables("pulses of the flow")


class VaneWear(Wear):
    """Wear of the bushing."""

    LIMIT_OF: ClassVar[Mapping[str, str]] = {
        **Wear.LIMIT_OF,
        "wear_angle_error_max": "wear.angle_error_limit",
        **ERROR_LIMIT_OF,
    }
    angle_error_limit: float | None = quantity(
        None,
        "vane-angle error, largest in a cycle, at which the joint is worn out: a campaign ends there",
        ASSUMED,
        gt=0,
        example="0.05 deg",
    )


class VsvRunKeys(Group):
    """Duration, start and outputs."""

    cycles: float | None = number(
        None, "drive cycles; give this or duration", "paper, section 5.2", gt=0, le=10000, example="2"
    )
    duration: float | None = quantity(
        None, "simulated time; give this or cycles", ASSUMED, gt=0, example="3 s"
    )
    start: Literal["equilibrium", "centred"] = choice(
        "equilibrium", "attitude of the trunnion at the start", "depends on mechanism.formulation"
    )
    output_interval: float = quantity("5 ms", "time between rows of the result", ASSUMED, gt=0)
    impact_window: float = quantity(
        "50 ms", "time after each reversal in which rows follow the steps", ASSUMED, ge=0
    )
    impact_rows: int = count(
        1000, "rows kept of each such window, at most: those with the peaks", ASSUMED, ge=50, le=1_000_000
    )


class VsvCase(BushingCase):
    """The built-in mechanism of Tables 1 to 3 unless keys say otherwise."""

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = (("run.cycles", "run.duration"),)

    case: Literal["vsv"] = choice("vsv", "the kind of system")
    title: str = text(
        "Variable stator vane mechanism, dry rough trunnion joint", "heading of figures and report"
    )
    mechanism: MechanismKeys = MechanismKeys()
    drive: CrankKeys = CrankKeys()
    loads: VsvLoadKeys = VsvLoadKeys()
    outputs: Mapping[str, VaneOutput] = tables(
        "what is compared with the motion without clearance", lambda: {"vane": VaneOutput()}
    )
    wear: VaneWear = VaneWear()
    solver: Solver = Solver()
    run: VsvRunKeys = VsvRunKeys(cycles=2.0)

    @classmethod
    def resolve(cls, given: Mapping[str, Value]) -> dict[str, Value]:
        """Return the defaults that follow from the contact law and the formulation, and the length."""
        defaults = super().resolve(given) | _rod_inertias(given) | DEFAULT
        if given.get("mechanism.formulation", "exact") != "exact":
            defaults |= {"joint.friction": "moment", "run.start": "centred"}
        if "run.duration" not in given:
            tabulated = any(f"drive.{name}.values" in given for name in DRIVE_TABLES)
            defaults["run.cycles"] = 1.0 if tabulated else 2.0
        return defaults

    @property
    def period(self) -> float:
        """Time of one drive cycle [s]: that of the sinusoid, or all of a table."""
        found = self.drive.table
        return 2.0 * math.pi / self.drive.angular_frequency if found is None else found[1].knots[-1]

    @property
    def duration(self) -> float:
        """Simulated time of the whole run [s]."""
        if self.run.duration is not None:
            return self.run.duration
        assert self.run.cycles is not None
        return self.run.cycles * self.period

    @property
    def campaign_cycles(self) -> int:
        """Drive cycles of a wear campaign; 0 where the case asks for none."""
        return self.wear.cycles

    @property
    def wear_limits(self) -> dict[str, float]:
        """The limits of the vane-angle error [rad] and of outputs, by what a campaign calls them."""
        limit = self.wear.angle_error_limit
        own = {} if limit is None else {"wear_angle_error_max": limit}
        return own | wear_limits_of(self.outputs)

    @property
    def instants(self) -> tuple[str, ...]:
        """Names of what reads the errors of outputs at angles of the crank or times."""
        return tuple(instant.name for instant in instants_of(self.outputs))

    @property
    def temperature_times(self) -> tuple[float, ...]:
        """Times of the rows of all temperatures that follow time [s], increasing."""
        return times_of(self.temperature.tables.values())

    @property
    def settling_cycles(self) -> int:
        """Cycles simulated before the first one whose wear counts."""
        return int(self.run.cycles or 1.0) - 1

    @property
    def lengths(self) -> Lengths:
        """Lengths and angles of the mechanism in the symbols of the paper."""
        # Imported here: the mechanism brings compiled code along, which reading the models does not need.
        from tribodyn.papers.cheng_2022.reduced.parameters import Lengths

        m = self.mechanism
        return Lengths(
            l_1=m.crank_length,
            l_2=m.drag_link_length,
            l_3=m.ring_radius,
            l_4=m.lever_length,
            l_v=m.vane_length,
            l_m=m.pivot_distance,
            gamma=m.pivot_angle,
            phi=m.ring_angle,
        )

    @property
    def crank(self) -> AnyDrive:
        """Motion of the crank in the symbols of the paper."""
        from tribodyn.papers.cheng_2022.reduced.drives import drive_of

        return drive_of(self.drive, self.duration, again=self.wear.cycles > 0)

    def followed(self) -> Iterable[FollowedTable]:
        """Return the tables that loads and temperatures follow; that of the drive holds the whole run."""
        loads = {
            f"loads.more.{name}.{key}": signal
            for name, load in self.loads.more.items()
            for key, signal in load.given.items()
        }
        along = {path: f"the {self.loads.more[path.split('.')[2]].along}" for path in loads}
        warm = {f"{OVER_TIME}.{part}": table for part, table in self.temperature.tables.items()}
        yield from followed(loads, self.duration, cycle=self.period, follows=along)
        yield from followed(warm, time_followed(self))

    def yielding(self) -> Self | None:
        """Return the case with elastic bodies under its asperities, in the formulation that keeps energy."""
        return super().yielding() if self.mechanism.formulation == "exact" else None

    def idle(self) -> tuple[str, ...]:
        """Return the keys of the sinusoid that a table takes the place of."""
        if self.drive.table is None:
            return ()
        start = ("drive.start_angle",) if self.drive.angle is not None else ()
        return ("drive.speed_amplitude", "drive.angular_frequency", *start)

    def doors(self) -> Doors:
        """Return the keys for functions of drive and loads."""
        from tribodyn.papers.cheng_2022.reduced.drives import ideal_range

        crank = self.crank.crank_range(self.duration)
        span = self.period if self.run.cycles is not None else self.duration
        return Doors(
            drive=("drive.angle", "rad"),
            loads={name: (f"loads.more.function-{name}.{name}", unit) for name, unit in COMPONENTS.items()},
            overridden={
                "force_x": ("loads.air_force_x", "0 N"),
                "force_y": ("loads.air_force_y", "0 N"),
                "moment": ("loads.air_moment", "0 N m"),
            },
            arguments={
                "t": ("times", (0.0, span)),
                "theta_v": ("angles", ideal_range(self.lengths, self.crank, self.duration)),
                "theta_a": ("angles", crank),
            },
            beside={"theta_a": {"along": "crank"}},
        )

    def checks(self) -> tuple[Callable[[], object], ...]:
        """Return the cross-checks of keys."""
        own = (
            self._check_run,
            self._check_campaign,
            self._check_inertias,
            self._check_bulk,
            self._check_reach,
            self._check_loads,
            self._check_running_in,
            self._check_temperature,
        )
        return (*super().checks(), *own)

    def _check_run(self) -> None:
        words = "give either run.cycles or run.duration"
        demand((self.run.cycles is None) != (self.run.duration is None), "run.duration", words)
        check_output_interval(self.run.output_interval, self.duration)

    def _check_campaign(self) -> None:
        """Check that a campaign can begin: after whole cycles, in a contact that has a pressure."""
        if self.wear.cycles == 0:
            return
        cycles = self.run.cycles or 0.5
        demand(
            cycles == int(cycles),
            "run.cycles",
            "a wear campaign needs a whole number of cycles here: the last of them is the first whose wear "
            "counts, those before let the start die away",
        )
        words = 'a contact at points has no pressure that could wear: joint.contact = "surface" is needed'
        demand(self.joint.contact == "surface", "wear.cycles", words)

    def _check_inertias(self) -> None:
        """Check that the inertias about rod ends and casing axis leave something about the mass centres."""
        m = self.mechanism
        if m.formulation != "exact":
            return
        ring_arm = 0.5 * m.ring_radius * math.cos(0.5 * m.ring_angle)
        faults = Faults()
        for body, inertia, mass, arm in (
            ("crank", m.crank_inertia, m.crank_mass, 0.5 * m.crank_length),
            ("drag_link", m.drag_link_inertia, m.drag_link_mass, 0.5 * m.drag_link_length),
            ("ring", m.ring_inertia, m.ring_mass, ring_arm),
            ("vane", m.vane_inertia, m.vane_mass, 0.5 * m.vane_length),
        ):
            least = mass * arm**2
            message = f"with this mass and size the body needs more than {least:.4g} kg m^2"
            with faults.noted():
                demand(inertia > least, f"mechanism.{body}_inertia", message)
        faults.raise_any()

    def _check_bulk(self) -> None:
        """Check that elastic bodies are those of the formulation that keeps energy."""
        exact = self.mechanism.formulation == "exact"
        words = 'elastic bodies need mechanism.formulation = "exact"'
        demand(self.joint.bulk != CONFORMAL or exact, "joint.bulk", words)

    def _check_running_in(self) -> None:
        """Check that there is a roughness to run in to."""
        if self.wear.running_in:
            self.surfaces.check_running_in(self.wear.final_roughness)

    def run_in(self, depth: float) -> Self:
        """Return the case with the roughness of a bushing that is worn by a mean depth [m], on its grid."""
        worn = self.surfaces.run_in(depth, self.wear.final_roughness)
        theta, z = grid_of(self)
        grid = self.solver.grid.model_copy(update={"theta": theta, "z": z})
        solver = self.solver.model_copy(update={"grid": grid})
        return self.model_copy(update={"surfaces": worn, "solver": solver})

    def _check_loads(self) -> None:
        """Check that forces act on the vane."""
        longest = self.mechanism.vane_length
        for name, load in self.loads.more.items():
            place = "centre_of_pressure" if load.point is None else "point"
            arm, key = load.arm, place if load.span is None else "span.positions"
            words = f"the vane is {longest * 1e3:g} mm long, the force would act at {(arm or 0) * 1e3:.4g} mm"
            demand(arm is None or 0.0 <= arm <= longest, f"loads.more.{name}.{key}", words)

    def _check_temperature(self) -> None:
        """Check that temperatures over time leave a clearance."""
        geometry, liner = cold_geometry(self.joint), self.joint.liner
        self.temperature.check(geometry, self.surfaces, liner, time_followed(self))

    def _check_reach(self) -> None:
        """Check that the loop closes at every crank angle of the drive."""
        from tribodyn.papers.cheng_2022.reduced.parameters import LEAST_SWING
        from tribodyn.papers.cheng_2022.reduced.reach import check_reach

        moves = abs(self.drive.speed_amplitude) > LEAST_SWING * self.drive.angular_frequency
        demand(moves, "drive.speed_amplitude", f"the crank must move, by more than {LEAST_SWING:g} rad")
        check_reach(self.lengths, *self.crank.crank_range(self.duration))
