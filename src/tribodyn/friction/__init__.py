"""Friction laws of drives and guides: limits of friction over speed and transmitted load.

They are plain functions of arrays, for fits and for comparison with measured data. Friction in the contact of
two surfaces is part of the joints, see ``kernels.joints``.
"""

from tribodyn.friction.limit import FrictionLimit, stribeck_share

__all__ = ["FrictionLimit", "stribeck_share"]
