"""Kernels of the variable stator vane mechanism."""
