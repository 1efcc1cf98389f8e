"""Kernels of any mechanism: bodies and couplings are data."""
