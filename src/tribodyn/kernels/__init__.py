"""Compiled functions on plain arrays, numbers and records."""
