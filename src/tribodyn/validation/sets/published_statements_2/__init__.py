"""Validation set ``published_statements_2``."""
