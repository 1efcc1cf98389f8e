"""Compiled functions of SI floats and arrays: joints, films, mechanisms, integrator; no classes, no I/O."""
