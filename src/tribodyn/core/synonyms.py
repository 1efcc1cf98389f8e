"""Words of other programs and of everyday language, each with the words of this program for it."""

from typing import Final

#: Probable meanings, the likeliest first; a word that is also one of ours is never looked up.
SYNONYMS: Final[dict[str, tuple[str, ...]]] = {
    # Kinds of joints.
    "hinge": ("revolute",),
    "pin": ("revolute", "pin-slot", "trunnion"),
    "pivot": ("revolute",),
    "rotational": ("revolute",),
    "slider": ("prismatic",),
    "slide": ("prismatic",),
    "translational": ("prismatic",),
    "ball": ("spherical",),
    "ball-joint": ("spherical",),
    "sleeve": ("cylindrical",),
    "cardan": ("universal",),
    "hooke": ("universal",),
    "slot": ("pin-slot",),
    "weld": ("fixed",),
    "rigid": ("fixed",),
    "plane": ("planar",),
    "bushing": ("spring-damper",),
    # The body that does not move.
    "world": ("ground",),
    "base": ("ground",),
    "frame": ("ground",),
    "earth": ("ground",),
    # Tables and keys of user-defined mechanisms.
    "links": ("bodies",),
    "parts": ("bodies",),
    "limit": ("stops", "stop"),
    "limits": ("stops", "stop"),
    "range": ("stops", "stop"),
    "motors": ("drives", "drive"),
    "motor": ("drives", "drive"),
    "actuators": ("drives", "drive"),
    "actuator": ("drives", "drive"),
    "force": ("loads", "load"),
    "forces": ("loads", "load"),
    "friction": ("friction_coefficient",),
    "mu": ("friction_coefficient",),
    "com": ("centre",),
    "cog": ("centre",),
    "inertia_tensor": ("inertia",),
    "moments_of_inertia": ("inertia",),
    "kind": ("type",),
    "g": ("gravity",),
    "k": ("stiffness",),
    "spring_constant": ("stiffness",),
    "c": ("damping",),
    "diameter": ("radius",),
    "material": ("density",),
    "clearance": ("radial", "gap"),
    "radial_clearance": ("radial", "clearance"),
    "diametral": ("radial",),
    "diametral_clearance": ("radial",),
    "tolerance": ("rtol",),
    "bodies": ("between",),
    "location": ("point",),
    "position": ("point",),
    "origin": ("point",),
    "direction": ("axis", "along"),
    "joint": ("joints", "body"),
    "rate": ("specific_wear_rate",),
    "wear_rate": ("specific_wear_rate",),
    "oil": ("viscosity",),
    "shaft": ("trunnion",),
    "bore": ("bushing",),
    "housing": ("bushing",),
    "play": ("radial", "clearance"),
    "gap": ("radial", "clearance"),
    "rpm": ("speed",),
    "velocity": ("speed",),
    "time": ("duration",),
    "end_time": ("duration",),
    # Commands.
    "simulate": ("run",),
    "init": ("new",),
    "create": ("new",),
    "template": ("new",),
    "list": ("cases",),
    "keys": ("show",),
    "plot": ("report",),
    "gui": ("workbench",),
}
#: Words whose values are twice those of the words of this program for them.
OF_DIAMETERS: Final = frozenset({"diameter", "diametral", "diametral_clearance"})


def meanings(word: str) -> tuple[str, ...]:
    """Return the words of this program for a word, none where it is not known.

    Examples
    --------
    >>> meanings("Hinge")
    ('revolute',)
    """
    return SYNONYMS.get(word.casefold().replace(" ", "-"), ())
