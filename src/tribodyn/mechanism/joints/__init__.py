"""Types of joints: each says once what it holds, what it takes and how it is described.

A type is one class, in a file of this package whose name is in the list below; types that are only their
constraint equations share one. Allowed types in case files, methods of the builder, messages, equations,
drives, drawings and the tables of the manual follow from the list.
"""

from typing import Final

from tribodyn.mechanism.joints.joint_type import JointType
from tribodyn.mechanism.members import members_of

NAMES: Final = ("ideal", "elastic")  #: Modules of this package.

#: Every type of joint by its name.
JOINTS: Final[dict[str, JointType]] = {kind.NAME: kind() for kind in members_of(__name__, NAMES, JointType)}
