"""Validation set ``vsv_practice``."""
