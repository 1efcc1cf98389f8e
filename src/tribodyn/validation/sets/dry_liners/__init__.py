"""Validation set ``dry_liners``."""
