"""Validation set ``journal_peak_pressure``."""
