"""Validation set ``friction_damper_backlash``."""
