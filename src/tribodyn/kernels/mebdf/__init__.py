"""Kernels of the modified extended backward differentiation formulae."""
