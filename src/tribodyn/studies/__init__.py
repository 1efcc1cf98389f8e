"""Studies: one case at many values of its parameters, on processes of this machine or on a cluster."""

from tribodyn.studies.allocation import Allocation, allocate
from tribodyn.studies.builds import Builds, builds
from tribodyn.studies.cluster import Tls
from tribodyn.studies.contributions import OutputShares, contributions
from tribodyn.studies.differences import Slope, slopes
from tribodyn.studies.plan import Sampling, SweepPlan, make_plan
from tribodyn.studies.sampling import DISTRIBUTIONS, SAMPLERS
from tribodyn.studies.search import find
from tribodyn.studies.statistics import sensitivities, shares, statistics
from tribodyn.studies.sweep import Arrival, Means, Watcher, run, sweep

__all__ = [
    "DISTRIBUTIONS",
    "SAMPLERS",
    "Allocation",
    "Arrival",
    "Builds",
    "Means",
    "OutputShares",
    "Sampling",
    "Slope",
    "SweepPlan",
    "Tls",
    "Watcher",
    "allocate",
    "builds",
    "contributions",
    "find",
    "make_plan",
    "run",
    "sensitivities",
    "shares",
    "slopes",
    "statistics",
    "sweep",
]
