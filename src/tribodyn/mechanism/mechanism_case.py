"""A mechanism that a user describes: bodies, joints, drives, loads and springs by their names.

One file because the checks compare tables that the class declares.
"""

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, ClassVar, Final, Literal, Self

from pydantic import PrivateAttr, create_model

from tribodyn.cases import materials
from tribodyn.cases.case import Case, demand, demand_known, with_entries
from tribodyn.cases.fields import Vector, choice, tables, text, vector
from tribodyn.cases.followed_tables import FollowedTable, followed, of_tables
from tribodyn.cases.groups import Contact, check_output_interval
from tribodyn.cases.joint_keys import CONFORMAL, FilmGridKeys, Wear
from tribodyn.cases.keys import ASSUMED, Value, keys_of
from tribodyn.cases.loads import Doors, OwnFunction
from tribodyn.cases.messages import Remarks
from tribodyn.cases.rough import RoughCase, has_wear_rate, of_choice, of_loss, of_surfaces, wear_scatter
from tribodyn.cases.tables import keys_at
from tribodyn.cases.temperature import Temperature, time_followed, times_of
from tribodyn.core.errors import below
from tribodyn.joints.rows import FEWEST
from tribodyn.mechanism.elements import ELEMENTS
from tribodyn.mechanism.elements.bristle import RestKeys
from tribodyn.mechanism.elements.controller import Controller, check_functions
from tribodyn.mechanism.elements.element import ElementKeys
from tribodyn.mechanism.elements.joint_friction import JointFriction, regularised
from tribodyn.mechanism.frames import GROUND
from tribodyn.mechanism.model import solids
from tribodyn.mechanism.model.beam_nodes import elastic_keys, of_rigid, with_nodes
from tribodyn.mechanism.model.body import BodyKeys
from tribodyn.mechanism.model.drives_and_loads import (
    COORDINATE_OF,
    GIVEN,
    DriveKeys,
    LoadKeys,
    doors_of,
    given_of,
)
from tribodyn.mechanism.model.output_declarations import JointInstants, OutputKeys
from tribodyn.mechanism.model.parts import ClearanceKeys, JointKeys, PairKeys, SpringKeys, friction_of
from tribodyn.mechanism.model.patterns import PATTERN, PatternKeys, ScatterKeys, of_copy, scatter_in
from tribodyn.mechanism.model.repetition import with_copies
from tribodyn.mechanism.plausible import of_mechanism
from tribodyn.mechanism.run_keys import ROWS, Integration, ResultKeys, RunKeys
from tribodyn.mechanisms.mechanism_protocol import plain
from tribodyn.mechanisms.output_keys import ERROR_LIMIT_OF, instants_of, wear_limits_of

if TYPE_CHECKING:
    import xarray as xr

_PAIRS: Final = "pairs"
_FRICTION: Final = "friction_coefficient"
_OF_WEAR: Final = ("wear.specific_wear_rate", "wear.partner_wear_rate", "wear.final_roughness")
_CLEARANCE: Final = re.compile(r"(joints\.[^.]+\.clearance\.).+")


def _tables_of(values: Iterable[str]) -> set[str]:
    """Return the paths of all tables that hold some values."""
    return {path[:place] for path in values for place, sign in enumerate(path) if sign == "."}


class _Parts(RoughCase):
    """The parts of a mechanism that are no elements."""

    case: Literal["mechanism"] = choice("mechanism", "the kind of system")
    title: str = text("Mechanism", "heading of figures and report")
    friction_coefficient: float = friction_of("all joints without a pair")
    gravity: Vector = vector(
        "0, 0, 0 m/s^2",
        "acceleration of gravity",
        ASSUMED,
        unit="m/s^2",
        example='["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]',
    )
    bodies: Mapping[str, BodyKeys] = tables("the bodies")
    joints: Mapping[str, JointKeys] = tables("their joints")
    drives: Mapping[str, DriveKeys] = tables("what moves them")
    loads: Mapping[str, LoadKeys] = tables("what acts on them")
    springs: Mapping[str, SpringKeys] = tables("springs between them")
    outputs: Mapping[str, OutputKeys] = tables("what is compared with the motion of ideal joints")
    pattern: Mapping[str, PatternKeys] = tables("bodies that stand several times")
    scatter: Mapping[str, ScatterKeys] = tables("values that differ from copy to copy of a pattern")
    pairs: Mapping[str, PairKeys] = tables("surfaces of joints that name them")


if TYPE_CHECKING:
    _WithElements = _Parts
else:
    _WithElements = create_model(
        "_WithElements",
        __base__=_Parts,
        __module__=__name__,
        **{kind.TABLE: (Mapping[str, kind], tables(kind.__doc__)) for kind in ELEMENTS},
    )


class MechanismWear(Wear):
    """Wear of the joints with clearance."""

    LIMIT_OF: ClassVar[Mapping[str, str]] = {**Wear.LIMIT_OF, **ERROR_LIMIT_OF}


class MechanismCase(_WithElements):
    """Bodies, joints and what moves them, in one drawing."""

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = (("run.cycles", "run.duration"),)

    wear: MechanismWear = MechanismWear()
    friction: RestKeys = RestKeys()
    solver: Integration = Integration()
    run: RunKeys = RunKeys()
    results: ResultKeys = ResultKeys()

    _functions: Mapping[str, OwnFunction] = PrivateAttr(default_factory=dict)

    @classmethod
    def expanded(cls, values: dict[str, Value], tables: list[str]) -> tuple[dict[str, Value], list[str]]:
        """Return values with copies of patterns, nodes for elastic bodies, and the tables that are there."""
        if any(path.startswith(f"{PATTERN}.") for path in values):
            values, tables = with_copies(values, tables, keys_at(cls, [*values, *tables]))
        found = with_nodes(values)
        if found is values:
            return values, tables
        gone = _tables_of(values) - _tables_of(found)
        return found, [table for table in tables if table not in gone]

    @classmethod
    def resolve(cls, given: Mapping[str, Value]) -> dict[str, Value]:
        """Return the defaults that follow from shapes, materials and contact laws, also of named pairs."""
        found = super().resolve(given) | solids.of_bodies(given) | of_rigid(given)
        for name in {path.split(".")[1] for path in given if path.startswith(f"{_PAIRS}.")}:
            prefix = f"{_PAIRS}.{name}."
            own = {
                path.removeprefix(prefix): value for path, value in given.items() if path.startswith(prefix)
            }
            found |= materials.resolve(given, keys_of(PairKeys, prefix), prefix)
            found |= {prefix + path: value for path, value in Contact.resolve(own).items()}
        return found | cls._of_pairs({**found, **given})

    @staticmethod
    def _of_pairs(known: Mapping[str, Value]) -> dict[str, Value]:
        """Return friction and wear rates of pairs that follow from the case, and friction of joints."""
        found: dict[str, Value] = {}
        for name in {path.split(".")[1] for path in known if path.startswith(f"{_PAIRS}.")}:
            prefix = f"{_PAIRS}.{name}."
            if f"{prefix}surfaces.bushing.{materials.MATERIAL}" not in known:
                taken = {path: known[path] for path in (_FRICTION, *_OF_WEAR) if path in known}
                found |= {prefix + path: value for path, value in taken.items() if prefix + path not in known}
        for joint in {match[1] for path in known if (match := _CLEARANCE.fullmatch(path))}:
            hot = Temperature.resolve(known, f"{joint}temperature.")
            at = next((value for path, value in hot.items() if path.endswith(_FRICTION)), None)
            pair = known.get(f"{joint}pair")
            path = _FRICTION if pair is None else f"{_PAIRS}.{pair}.{_FRICTION}"
            value = known.get(path, found.get(path)) if at is None else at
            if value is not None and joint + _FRICTION not in known:
                found[joint + _FRICTION] = value
        return found

    def with_coarse_grids(self) -> Self:
        """Return the case with few nodes on all surfaces and in all films."""

        def coarse(joint: JointKeys) -> JointKeys:
            clearance = joint.clearance and joint.clearance.with_nodes(*FEWEST)
            film = joint.film and joint.film.model_copy(update={"grid": FilmGridKeys(theta=8, z=4)})
            return joint.model_copy(update={"clearance": clearance, "film": film})

        return self.model_copy(update={"joints": {name: coarse(one) for name, one in self.joints.items()}})

    @property
    def real(self) -> dict[str, ClearanceKeys]:
        """Clearances of the joints that are not ideal, by name."""
        return {name: joint.real for name, joint in self.joints.items() if joint.real is not None}

    @property
    def oiled(self) -> list[str]:
        """Names of the joints with an oil film."""
        return [name for name in self.real if self.joints[name].film is not None]

    def of_pair(self, clearance: ClearanceKeys) -> PairKeys | Self:
        """Return surfaces, contact law, friction and wear of a joint: its pair, or those of the case."""
        return self if clearance.pair is None else self.pairs[clearance.pair]

    def remarks(self) -> Remarks:
        """Return remarks on the surfaces of all joints and on tables."""
        of_pairs = (of_surfaces(self, f"{_PAIRS}.{name}.", self._beside(name)) for name in self.pairs)
        own = of_surfaces(self, "", self._beside(None)) + of_tables(self.followed())
        prefixes = self._surfaces_of_joints()
        elastic = (prefixes[name] for name, keys in self.real.items() if keys.under == CONFORMAL)
        bodies = of_loss(self, dict.fromkeys(elastic))
        chosen = of_choice(self, dict.fromkeys(prefixes.values()))
        return sum(of_pairs, Case.remarks(self) + own + of_mechanism(self) + bodies + chosen)

    def assumed_wear(self) -> tuple[str, ...]:
        """Return the joints, as in names of numbers, whose wear rate nobody chose."""
        return tuple(
            plain(name)
            for name, prefix in self._surfaces_of_joints().items()
            if not has_wear_rate(self, prefix)
        )

    def wear_scatter(self) -> dict[str, tuple[float, float]]:
        """Return the interval of the wear of equal joints over that at the rate; the widest for all."""
        found = {
            plain(name): wear_scatter(self, prefix) for name, prefix in self._surfaces_of_joints().items()
        }
        lows, highs = zip(*found.values(), (1.0, 1.0), strict=True)
        return {"": (min(lows), max(highs)), **found}

    def _surfaces_of_joints(self) -> dict[str, str]:
        """Return the prefix of the surfaces' keys of each joint with clearance, by its name."""
        pairs = {name: keys.pair for name, keys in self.real.items()}
        return {name: "" if pair is None else f"{_PAIRS}.{pair}." for name, pair in pairs.items()}

    def _beside(self, pair: str | None) -> dict[str, list[str]]:
        """Return the friction of joints of a pair, or of none, that differs from that of the pair."""
        own = [
            f"joints.{name}.clearance.{_FRICTION}"
            for name, clearance in self.real.items()
            if clearance.pair == pair
            and clearance.friction_coefficient != self.of_pair(clearance).friction_coefficient
        ]
        return {_FRICTION: own}

    def followed(self) -> Iterable[FollowedTable]:
        """Return the tables that drives and loads follow."""
        drives = {f"drives.{name}.{drive.gives}": drive.signal for name, drive in self.drives.items()}
        loads = {
            f"loads.{name}.{key}": signal
            for name, load in self.loads.items()
            for key, signal in load.given.items()
        }
        along = {path: self.loads[path.split(".")[1]].along or "" for path in loads}
        warm = {
            f"joints.{name}.clearance.temperature.over_time.{part}": table
            for name, clearance in self.real.items()
            for part, table in clearance.temperature.tables.items()
        }
        yield from followed(drives, self.span)
        yield from followed(warm, self.span if self.wear.cycles == 0 else time_followed(self))
        yield from followed(loads, self.span, cycle=self.period, follows=along)

    def idle(self) -> tuple[str, ...]:
        """Return the keys that follow from the shapes of bodies."""
        return solids.following(self._given)

    def without_effect(self) -> tuple[str, ...]:
        """Return surfaces that no joint has, and clearances of joints that are ideal all the same."""
        used = {clearance.pair for clearance in self.real.values()}
        tables = ("surfaces", "asperities", "contact")
        ideal = (
            name for name, joint in self.joints.items() if joint.clearance is not None and not joint.real
        )
        return (
            *(() if None in used else tables),
            *(f"{_PAIRS}.{name}" for name in self.pairs if name not in used),
            *(
                f"joints.{name}.clearance.{key}"
                for name in ideal
                for key in ClearanceKeys.model_fields
                if key != "ideal"
            ),
        )

    def rough_clearances(self) -> dict[str, float]:
        """Return the combined rms roughness σ of the surfaces of joints with a radial clearance [m]."""
        return {
            f"joints.{name}.clearance.radial": self.of_pair(clearance).surface_pair.roughness_rms
            for name, clearance in self.real.items()
            if clearance.radial is not None
        }

    def doors(self) -> Doors:
        """Return the keys for functions of the drive and of loads."""
        return doors_of(self.drives, self.loads, self.span)

    def one_copy(self, together: "xr.Dataset", instants: Sequence[float]) -> Case:
        """Return the case with one copy of its pattern, see :mod:`tribodyn.mechanism.one_copy`."""
        from tribodyn.mechanism.one_copy import one_copy

        return one_copy(self, together, instants)

    def yielding(self) -> Self | None:
        """Return the case with elastic bodies under all asperities of which it says nothing, if any."""
        rigid = [name for name, keys in self.real.items() if keys.bulk is None and keys.may_yield]
        return self.replace({f"joints.{name}.clearance.bulk": CONFORMAL for name in rigid}) if rigid else None

    @property
    def scattered(self) -> Mapping[str, ScatterKeys]:
        """Distributions and lists of what differs from copy to copy; :attr:`scatter` has none once drawn."""
        return scatter_in(self.written)

    @property
    def functions(self) -> Mapping[str, OwnFunction]:
        """Python functions in the place of controllers, by name."""
        return self._functions

    def with_controllers(self, functions: Mapping[str, OwnFunction]) -> Self:
        """Return the case with functions in the place of controllers, of those without a gain at least."""
        controllers = {name: keys for _, name, keys in self.elements() if isinstance(keys, Controller)}
        check_functions(controllers, functions, self.joints, map(plain, self.outputs))
        copied = self.model_copy()
        copied._functions = dict(functions)
        return copied

    @property
    def period(self) -> float | None:
        """Time of one cycle [s]; None where nothing says it."""
        if self.run.period is not None:
            return self.run.period
        return next(filter(None, (drive.period for drive in self.drives.values())), None)

    @property
    def span(self) -> float:
        """Time that the drives run forward [s]: one cycle at most where the run is not dynamic."""
        if self.run.duration is not None:
            return self.run.duration
        assert self.run.cycles is not None
        assert self.period is not None
        cycles = self.run.cycles if self.run.analysis == "dynamic" else min(self.run.cycles, 1.0)
        return cycles * self.period

    @property
    def turn(self) -> float:
        """Time at which the drives turn back [s]; infinite where they do not."""
        return self.span if self.run.directions == "both" else math.inf

    @property
    def duration(self) -> float:
        """Simulated time of the whole run [s]."""
        return self.span if math.isinf(self.turn) else 2.0 * self.span

    @property
    def output_interval(self) -> float:
        """Time between rows [s]."""
        longest = min(self.span, self.period or self.span)
        chosen = self.run.analysis == "kinematic" and self.given("run.positions") is not None
        if chosen or self.run.analysis in ("static", "vibrations"):
            return longest / self.run.positions
        return self.run.output_interval or longest / ROWS

    @property
    def wear_limits(self) -> dict[str, float]:
        """The limits of output errors, by what a campaign calls them."""
        return wear_limits_of(self.outputs)

    @property
    def instants(self) -> tuple[str, ...]:
        """Names of what reads the errors of outputs at angles, positions or times."""
        return tuple(instant.name for instant in instants_of(self.outputs))

    @property
    def moves(self) -> bool:
        """Whether a drive prescribes a motion."""
        return any(GIVEN[drive.gives][1] < 2 for drive in self.drives.values())

    @property
    def modes(self) -> tuple[str, ...]:
        """Names of the modes of a vibration analysis: their numbers."""
        return tuple(map(str, range(1, self.run.modes + 1))) if self.run.analysis == "vibrations" else ()

    @property
    def campaign_cycles(self) -> int:
        """Cycles of a wear campaign; 0 where the case asks for none."""
        return self.wear.cycles

    @property
    def temperature_times(self) -> tuple[float, ...]:
        """Times of the rows of all temperatures that follow time [s], increasing."""
        real = self.real.values()
        return times_of(table for clearance in real for table in clearance.temperature.tables.values())

    @property
    def settling_cycles(self) -> int:
        """Cycles simulated before the first one whose wear counts."""
        return int(self.run.cycles or 1.0) - 1

    def model_post_init(self, context: object, /) -> None:
        """Check tables against each other."""
        super().model_post_init(context)
        demand(bool(self.bodies), "bodies", "a mechanism needs a body: write a table [bodies.NAME]")
        demand(
            GROUND not in self.bodies,
            f"bodies.{GROUND}",
            f"{GROUND} is what never moves; choose another name",
        )
        self._check_names()
        self._check_drives()
        self._check_loads()
        self._check_elements()
        self._check_friction()
        self._check_run()
        self.results.check()
        self._check_running_in()
        self._check_campaign()

    def _check_names(self) -> None:
        bodies = (GROUND, *self.bodies)
        for table in ("joints", "springs"):
            for name, part in getattr(self, table).items():
                for body in part.between:
                    demand_known(body, bodies, f"{table}.{name}.between", "body")
        for name, output in self.outputs.items():
            demand_known(output.body, bodies, f"outputs.{name}.body", "body")
            demand_known(output.reference, bodies, f"outputs.{name}.reference", "body")
            self._check_instants(f"outputs.{name}.at", output.at)
            if output.follows is not None:
                key = f"outputs.{name}.follows"
                demand_known(output.follows, self.joints, key, "joint")
                words = "it neither turns nor slides; name another joint"
                demand(bool(self.joints[output.follows].kind.COORDINATES), key, words)
        for name, joint in self.joints.items():
            if joint.clearance is not None and joint.clearance.pair is not None:
                demand_known(joint.clearance.pair, self.pairs, f"joints.{name}.clearance.pair", "pair")

    def _check_instants(self, path: str, at: JointInstants) -> None:
        """Check that there is a joint with the coordinate at whose values an error is read."""
        if at.joint is not None:
            demand_known(at.joint, self.joints, f"{path}.joint", "joint")
        joint = self.joint_of(at)
        words = "no drive says whose these are; name a joint"
        demand(joint is not None or not (at.angles or at.positions), f"{path}.joint", words)
        if joint is None or joint not in self.joints:
            return
        kind = self.joints[joint].kind
        for key, coordinate in (("angles", "angle"), ("positions", "position")):
            words = f"{joint} is {kind.named}: it has no {coordinate}"
            demand(not getattr(at, key) or coordinate in kind.COORDINATES, f"{path}.{key}", words)

    def joint_of(self, at: JointInstants) -> str | None:
        """Return the joint whose coordinate instants count: that of the first drive by default."""
        return at.joint or next((drive.joint for drive in self.drives.values()), None)

    def _check_drives(self) -> None:
        driven: dict[tuple[str, str], str] = {}
        for name, drive in self.drives.items():
            demand_known(drive.joint, self.joints, f"drives.{name}.joint", "joint")
            joint, (coordinate, level) = self.joints[drive.joint], GIVEN[drive.gives]
            free = joint.kind.COORDINATES
            own = (f"the {of} (give {given_of(of)})" for of in free)
            can = f"it has {' and '.join(own)}" if free else "it has nothing to drive"
            words = f"{drive.joint} is {joint.kind.named}: {can}, and {drive.gives} drives the {coordinate}"
            demand(coordinate in free, f"drives.{name}.joint", words)
            if level < 2:
                other = driven.setdefault((drive.joint, coordinate), name)
                words = f"drive {other} has the {coordinate} of {drive.joint} already; keep {name} or {other}"
                demand(other == name, f"drives.{name}.joint", words)

    @property
    def pushed(self) -> list[str]:
        """Joints of motors, controllers and drives by a torque or a force, which prescribe no motion."""
        drives = [drive.joint for drive in self.drives.values() if GIVEN[drive.gives][1] == 2]
        elements = [keys.named_joints["joint"][0] for _, _, keys in self.elements() if keys.IS_DRIVE]
        return list(dict.fromkeys([*drives, *elements]))

    def _check_loads(self) -> None:
        for name, load in self.loads.items():
            words = f"{GROUND} never moves, no load does anything to it; bodies: {', '.join(self.bodies)}"
            demand(load.body != GROUND, f"loads.{name}.body", words)
            demand_known(load.body, tuple(self.bodies), f"loads.{name}.body", "body")
            if load.along is None:
                continue
            key = f"loads.{name}.along"
            demand_known(load.along, self.joints, key, "joint")
            free = self.joints[load.along].kind.COORDINATES
            for over in load.joint_axes:
                coordinate = COORDINATE_OF[over]
                demand(coordinate in free, key, f"this joint has no {coordinate} that a table could follow")
            words = "its tables follow both the angle and the position of this joint: write two loads"
            demand(len({COORDINATE_OF[over] for over in load.joint_axes}) < 2, key, words)

    def at(self, path: str) -> Value | None:
        """Return the value at a dotted path; of what is repeated as written, else that of the first copy."""
        found, (table, name, *_) = super().at(path), f"{path}.".split(".")
        repeated = found is None and f"{name}[1]" in (getattr(self, table, None) or ())
        return super().at(of_copy(path, 1)) if repeated else found

    def rigid(self) -> Self | None:
        """Return the case with rigid bodies; None where no body is elastic."""
        elastic = elastic_keys(self.written)
        return with_entries(self, {}, "rigid bodies", elastic) if elastic else None

    def without_play(self) -> Self:
        """Return the case with elements as the ideal counterpart has them: without play."""
        if not any(keys.has_play for _, _, keys in self.elements()):
            return self
        return self.with_elements(lambda keys: keys.without_play)

    def without_deviations(self) -> Self:
        """Return the case with all joints where their points are, and along their axes."""
        off = {name: dict.fromkeys(joint.off_drawing, (0.0,) * 3) for name, joint in self.joints.items()}
        made = {name: self.joints[name].model_copy(update=keys) for name, keys in off.items() if keys}
        return self.model_copy(update={"joints": {**self.joints, **made}}) if made else self

    def with_elements(self, change: Callable[[ElementKeys], ElementKeys]) -> Self:
        """Return the case with each element as ``change`` returns it."""
        tables: dict[str, dict[str, ElementKeys]] = {}
        for table, name, keys in self.elements():
            tables.setdefault(table, {})[name] = change(keys)
        return self.model_copy(update=tables)

    @property
    def has_drives(self) -> bool:
        """Whether anything drives a joint: a drive, a motor or a controller."""
        return bool(self.drives) or any(keys.IS_DRIVE for _, _, keys in self.elements())

    def elements(self) -> Iterator[tuple[str, str, ElementKeys]]:
        """Yield table, name and keys of all elements."""
        for kind in ELEMENTS:
            for name, keys in getattr(self, kind.TABLE).items():
                yield kind.TABLE, name, keys

    def _check_elements(self) -> None:
        tables_of: dict[str, str] = {}
        for table, name, keys in self.elements():
            path = f"{table}.{name}"
            other = tables_of.setdefault(name, table)
            words = f"{other}.{name} has this name already; results name elements, so give each its own"
            demand(other == table, path, words)
            for key, joints in keys.named_joints.items():
                for joint in joints:
                    demand_known(joint, self.joints, f"{path}.{key}", "joint")
            for key, bodies in keys.named_bodies.items():
                for body in bodies:
                    demand_known(body, (GROUND, *self.bodies), f"{path}.{key}", "body")
            with below(path):
                equations = keys.equations(self.joints)
            words = "a wear campaign counts angles anew in each cycle; leave out gears with backlash"
            coupled = any(len(one.legs) > 1 and one.law is not None for one in equations)
            demand(not coupled or self.wear.cycles == 0, path, words)

    def _check_friction(self) -> None:
        """Check that friction which holds at rest has surfaces and a load."""
        if not self.friction.rest:
            return
        laws = (one.law for _, _, keys in self.elements() for one in keys.equations(self.joints))
        words = "nothing here has friction that could hold: give it to a joint, or to an element"
        rubs = any(clearance.friction_coefficient > 0.0 for clearance in self.real.values())
        rubs = rubs or any(law is not None and law.function is regularised for law in laws)
        demand(rubs, "friction.rest", words)
        for name, keys in getattr(self, JointFriction.TABLE).items():
            words = "friction holds by its load: give one above 0, or leave it out for that of the joint"
            demand(keys.normal_load != 0.0, f"{JointFriction.TABLE}.{name}.normal_load", words)

    def _check_run(self) -> None:
        run = self.run
        words = "say how long: give run.duration, or run.cycles"
        demand(run.duration is not None or run.cycles is not None, "run.duration", words)
        words = "nothing says how long a cycle is; give run.period, or run.duration instead"
        demand(run.cycles is None or self.period is not None, "run.cycles", words)
        check_output_interval(self.output_interval, self.duration)
        words = "a kinematic analysis has ideal joints in their places; leave it out, or run another analysis"
        for name, joint in self.joints.items() if run.analysis == "kinematic" else ():
            for key in joint.off_drawing:
                demand(False, f"joints.{name}.{key}", words)
        words = 'only a static analysis passes its positions in both directions; give run.analysis = "static"'
        demand(run.directions == "forward" or run.analysis == "static", "run.directions", words)
        for table, name, keys in self.elements():
            with below(f"{table}.{name}"):
                keys.check_run(self.span, dynamic=run.analysis == "dynamic", campaign=self.wear.cycles > 0)
        for name, drive in self.drives.items():
            knots = drive.signal.knots
            if knots and GIVEN[drive.gives][1] == 0 and not drive.signal.cyclic:
                words = f"the table holds {knots[0]:g} s to {knots[-1]:g} s, the run takes {self.span:g} s"
                inside = knots[0] <= 0.0 and knots[-1] >= self.span
                demand(inside, f"drives.{name}.{drive.gives}.times", words)

    def _check_running_in(self) -> None:
        """Check that there is a roughness to run in to."""
        pairs = {clearance.pair for clearance in self.real.values()}
        for name in sorted(pairs, key=str) if self.wear.running_in else ():
            pair, prefix = (self, "") if name is None else (self.pairs[name], f"{_PAIRS}.{name}.")
            pair.surfaces.check_running_in(pair.wear.final_roughness, f"{prefix}wear.")

    def _check_campaign(self) -> None:
        if self.wear.cycles == 0:
            return
        words = f"a wear campaign simulates cycles, and a {self.run.analysis} analysis none; choose dynamic"
        demand(self.run.analysis == "dynamic", "run.analysis", words)
        words = 'a wear campaign needs a joint with clearance whose contact is "surface"'
        demand(any(clearance.contact == "surface" for clearance in self.real.values()), "wear.cycles", words)
        cycles = self.run.cycles or 0.5
        words = "a wear campaign needs whole cycles here: the last of them is the first whose wear counts"
        demand(cycles == int(cycles), "run.cycles", words)
        for name, joint in self.joints.items():
            grooved = joint.film is not None and joint.film.boundary == "groove" and self.wear.feedback
            words = 'the film of a bore that wears goes around it: give "periodic", or wear.feedback = false'
            demand(not grooved, f"joints.{name}.film.boundary", words)
