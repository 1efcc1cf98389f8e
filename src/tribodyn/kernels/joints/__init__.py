"""Kernels of clearance joints: all take the joint, its memory and the pose, and fill a wrench."""
