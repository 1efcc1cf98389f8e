"""Results of a mechanism: variables, key results, energy balance, checks, outputs."""
