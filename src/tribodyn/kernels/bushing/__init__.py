"""Kernels of the bushing joint."""
