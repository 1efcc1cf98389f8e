"""Kernels of a rigid journal in a cylindrical bushing."""
