"""Validation set ``ball_drop``."""
