"""Mechanisms with clearance joints: parameters, equilibrium, and the initial value problem of each."""
