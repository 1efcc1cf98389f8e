"""Kernels of a rigid journal in a bushing."""
