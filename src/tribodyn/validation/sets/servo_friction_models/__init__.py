"""Validation set ``servo_friction_models``."""
