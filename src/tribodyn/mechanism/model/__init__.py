"""Keys of a mechanism: bodies, pairs of surfaces, drives, loads, outputs."""
