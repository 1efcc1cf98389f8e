"""Measured surfaces: from a file to the roughness and asperities that contact laws need."""

from tribodyn.surfaces.analysis import MeasuredSurface, Treatment, analyse, dependence
from tribodyn.surfaces.generate import SelfAffine, generate
from tribodyn.surfaces.moments import Asperities, Moments, asperities, moments
from tribodyn.surfaces.read import read_scan
from tribodyn.surfaces.scan import Length, Scan
from tribodyn.surfaces.text import Scale, write_text
from tribodyn.surfaces.treatment import FILTERS, LEVELS

__all__ = [
    "FILTERS",
    "LEVELS",
    "Asperities",
    "Length",
    "MeasuredSurface",
    "Moments",
    "Scale",
    "Scan",
    "SelfAffine",
    "Treatment",
    "analyse",
    "asperities",
    "dependence",
    "generate",
    "moments",
    "read_scan",
    "write_text",
]
