"""Validation set ``oblique_impact``."""
