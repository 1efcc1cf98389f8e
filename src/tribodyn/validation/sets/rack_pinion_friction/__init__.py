"""Validation set ``rack_pinion_friction``."""
