"""Validation set ``pin_on_disc_pps``."""
