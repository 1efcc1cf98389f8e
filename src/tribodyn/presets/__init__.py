"""Presets: models with a name of their own, written as user-defined mechanisms."""
