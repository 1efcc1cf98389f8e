"""Validation set ``published_statements``."""
