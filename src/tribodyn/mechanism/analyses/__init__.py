"""Analyses of a mechanism beside the integration over time."""
