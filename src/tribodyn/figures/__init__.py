"""Figures: from a result to what an engineer would look at first, drawn by matplotlib."""
