"""Measurements of the numbers on pages of the manual, a module for each subject.

Each module has ``NUMBERS``: names, each with the function that returns the number as text from shared runs.
"""
