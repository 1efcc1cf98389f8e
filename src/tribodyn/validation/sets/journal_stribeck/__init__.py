"""Validation set ``journal_stribeck``."""
