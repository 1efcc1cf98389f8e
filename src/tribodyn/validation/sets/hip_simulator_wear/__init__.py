"""Validation set ``hip_simulator_wear``."""
