"""How much a run of the disc computes and keeps."""

from falling_disc.case import DiscCase

from tribodyn.mechanisms.workload import Workload


def workload(case: DiscCase) -> Workload:
    """Return the counts of a case."""
    return Workload(
        steps=200.0,
        states=2.0,
        nodes=0.0,
        joints=0.0,
        fields=0.0,
        samples=201.0,
        followed=0.0,
        quantities=3.0,
    )


WORKLOAD = workload
