"""Validation set ``screw_drive_friction``."""
