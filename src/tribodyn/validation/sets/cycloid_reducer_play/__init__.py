"""Validation set ``cycloid_reducer_play``."""
