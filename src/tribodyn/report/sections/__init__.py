"""Figures of the page, one a module; which kind of result shows which stands in ``report/kinds.py``."""
