"""Validation set ``servo_gear_friction``."""
