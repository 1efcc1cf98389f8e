"""Validation set ``servo_play``."""
