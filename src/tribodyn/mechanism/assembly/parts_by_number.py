"""A mechanism between its keys and its equations: parts by number, and the surfaces of its joints.

Pieces, which are bodies or several in one, and joints are counted from 0 in the order of the case.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain

from tribodyn.joints.clearances import Clearance
from tribodyn.joints.point_contact import SURFACE
from tribodyn.mechanism.assembly.clearance_surfaces import clearances_of
from tribodyn.mechanism.assembly.pieces import RigidPieces, ends_of, pieces_of
from tribodyn.mechanism.elements.bristle import resting
from tribodyn.mechanism.elements.element import ElementKeys, Equation, Leg
from tribodyn.mechanism.frames import GROUND
from tribodyn.mechanism.joints import JOINTS
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.model.parts import JointKeys
from tribodyn.mechanisms.self_checks import yielding


@dataclass(frozen=True)
class ModelError:
    """Something that forbids a run."""

    key: str  #: What to change, as in a case file: ``joints.wrist``.
    text: str  #: In words.


@dataclass(frozen=True)
class Element:
    """A gear pair or another element: a constraint equation or a force law over coordinates of its legs."""

    name: str  #: Its name, unique among all elements.
    keys: ElementKeys  #: Its table; its class is a member of ``elements.ELEMENTS``.
    equations: tuple[Equation, ...]  #: Its equations, one for most.

    @property
    def legs(self) -> tuple[Leg, ...]:
        """The legs of all its equations."""
        return tuple(leg for equation in self.equations for leg in equation.legs)


@dataclass(frozen=True)
class Model:
    """The keys of a mechanism, and which of its joints have clearance."""

    case: MechanismCase  #: Bodies, joints and all that acts on them, in SI units.
    #: Of the joints that are not ideal, by their names.
    clearances: Mapping[str, Clearance] = field(default_factory=dict)
    #: Kinds of the ideal joints that take the place of joints that yield, by their names.
    held: Mapping[str, str] = field(default_factory=dict)
    apart: frozenset[str] = frozenset()  #: Names of fixed joints that make no piece of their bodies.

    @cached_property
    def pieces(self) -> RigidPieces:
        """The pieces that kernels move as bodies."""
        return pieces_of(self.case, self.apart)

    @cached_property
    def bodies(self) -> tuple[str, ...]:
        """Names of the pieces, each that of its first body."""
        return tuple(self.pieces.members)

    @cached_property
    def joints(self) -> tuple[str, ...]:
        """Names of the joints."""
        return tuple(self.case.joints)

    @cached_property
    def elements(self) -> tuple[Element, ...]:
        """All elements."""
        case, found = self.case, []
        for _, name, keys in case.elements():
            equations = keys.equations(case.joints)
            if case.friction.rest and case.run.analysis == "dynamic":
                laws = [one.law and resting(one.law, case.friction) for one in equations]
                equations = tuple(replace(one, law=law) for one, law in zip(equations, laws, strict=True))
            found.append(Element(name, keys, equations))
        return tuple(found)

    def number(self, body: str) -> int:
        """Return the number of the piece of a body; −1 for the ground."""
        return self.pieces.numbers[body]

    @cached_property
    def ends(self) -> tuple[Sequence[str], ...]:
        """Names of the bodies of socket and shaft of all couplings."""
        return tuple(ends_of(self.case))

    def joint(self, number: int) -> JointKeys:
        """Return the keys of a joint."""
        return self.case.joints[self.joints[number]]

    def kind(self, joint: str) -> str:
        """Return the kind of an ideal joint."""
        return self.held.get(joint, self.case.joints[joint].type)

    @property
    def elastic(self) -> dict[str, str]:
        """Names of the joints that yield by themselves, with the types of the ideal ones in their place."""
        kinds = {name: joint.kind.HELD for name, joint in self.case.joints.items()}
        return {name: held for name, held in kinds.items() if held and name not in self.held}

    @property
    def yields(self) -> bool:
        """Whether any joint is not ideal: it has clearance, or is elastic."""
        return bool(self.clearances or self.elastic)

    def yielding(self, joint: str) -> str:
        """Return the advice to let the bodies of a joint yield; nothing for contacts at points."""
        over_surface = self.clearances[joint].contact == SURFACE
        return yielding(f"joints.{joint}.clearance.bulk") if over_surface else ""

    @property
    def real(self) -> list[int]:
        """Numbers of the joints with clearance."""
        return [number for number, name in enumerate(self.joints) if name in self.clearances]

    @property
    def oiled(self) -> list[int]:
        """Numbers of the joints with an oil film."""
        films = {name: clearance.film for name, clearance in self.clearances.items()}
        return [number for number, name in enumerate(self.joints) if films.get(name) is not None]

    @property
    def first_leg(self) -> int:
        """Number of the coupling that is the first leg of the first element: all legs come last."""
        return len(self.joints) + len(self.case.springs) + len(self.case.loads)

    def element_of(self, coupling: int) -> Element:
        """Return the element whose leg a coupling is."""
        return [element for element in self.elements for _ in element.legs][coupling - self.first_leg]

    def constraint(self, coupling: int) -> tuple[str, tuple[str, ...]]:
        """Return the owner of a coupling's constraint equation, ``joint NAME``, and its bodies."""
        if coupling < len(self.joints):
            return f"joint {self.joints[coupling]}", self.joint(coupling).between
        element = self.element_of(coupling)
        bodies = dict.fromkeys(name for leg in element.legs for name in leg.bodies)
        return f"{element.keys.METHOD} {element.name}", tuple(bodies)

    def owners(self, couplings: set[int]) -> list[str]:
        """Return the owners of constraints, with fixed joints between them, in the order of couplings."""
        passing = self.pieces.passing({body for k in couplings for body in self.constraint(k)[1]})
        every = sorted(couplings | set(map(self.joints.index, passing)))
        return list(dict.fromkeys(self.constraint(k)[0] for k in every))

    @property
    def as_drawn(self) -> "Model":
        """The mechanism in which every joint is the ideal one of its type."""
        return replace(self, clearances={}, held={**self.elastic, **self.held})

    @property
    def counterpart(self) -> "Model":
        """The mechanism as clearances and deviations vanish: joints are the ideal ones that hold the same."""
        return self.in_place._with_ideal(self.joints)

    @property
    def in_place(self) -> "Model":
        """The mechanism whose joints are where their points are."""
        case = self.case.without_deviations()
        off = {name for name, joint in self.case.joints.items() if joint.off_drawing}
        return self if case is self.case else replace(self, case=case, apart=self.apart | off)

    @property
    def without_play(self) -> "Model":
        """The mechanism whose gears have no backlash."""
        return replace(self, case=self.case.without_play())

    @property
    def without_films(self) -> "Model":
        """The mechanism in which joints with an oil film are the ideal ones that hold the same."""
        return self._with_ideal([self.joints[number] for number in self.oiled])

    def _with_ideal(self, names: Sequence[str]) -> "Model":
        """Return the mechanism with the ideal joints that hold the same in the place of some."""
        real = {name: clearance for name, clearance in self.clearances.items() if name not in names}
        held = {name: self.case.joints[name].ideal for name in self.clearances if name in names}
        held |= {name: kind for name, kind in self.elastic.items() if name in names}
        return replace(self, clearances=real, held={**self.held, **held})

    @property
    def held_by_one(self) -> dict[str, str]:
        """Bodies that a single joint holds, each with the name of it."""
        joints: dict[str, list[str]] = {}
        for name, joint in self.case.joints.items():
            for body in joint.between:
                joints.setdefault(body, []).append(name)
        return {body: names[0] for body, names in joints.items() if len(names) == 1 and body != GROUND}

    @property
    def has_loops(self) -> bool:
        """Whether joints close a loop, through the ground or not, or elements do; else all can close."""
        if any(equation.law is None for element in self.elements for equation in element.equations):
            return True
        group = list(range(-1, len(self.bodies)))

        def root(body: int) -> int:
            while group[body + 1] != body:
                body = group[body + 1]
            return body

        for name, joint in self.case.joints.items():
            if name in self.pieces.joints:
                continue
            first, second = (root(self.number(body)) for body in joint.between)
            if JOINTS[self.elastic.get(name, self.kind(name))].ROWS:
                if first == second:
                    return True
                group[first + 1] = second
        return False

    def loose(self) -> Iterator[ModelError]:
        """Yield the bodies that no joint, spring or element names."""
        first_load = self.first_leg - len(self.case.loads)
        held = {*chain(*self.ends[:first_load], *self.ends[self.first_leg :])}
        for body in self.case.bodies:
            if body not in held:
                text = f"nothing holds body {body}: no joint, spring or element names it"
                yield ModelError(f"bodies.{body}", text)


def model_of(case: MechanismCase) -> Model:
    """Return the mechanism of a case, with its contact laws tabulated."""
    return Model(case, clearances_of(case))
