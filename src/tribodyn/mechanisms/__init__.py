"""The mechanisms, each in one folder and on one line of the list in ``catalogue.py``."""
