"""What its results hold."""

from tribodyn.results.variables import Variable

VARIABLES = {
    "height": Variable("m", "height of the disc over the floor"),
    "floor_force": Variable("N", "force of the floor on the disc"),
    "energy_lost": Variable("J", "what the energy of the disc misses"),
}
