"""Compiled code: how functions are compiled, and where their machine code is kept."""
