"""Kernels of a rigid shaft in a cylindrical bushing."""
