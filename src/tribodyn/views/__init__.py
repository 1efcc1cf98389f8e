"""Interpretation of results without drawing: series, events, charts over time, pictures of the bushing."""
