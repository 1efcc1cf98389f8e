"""The vane mechanism and its kernels, beside other integrators, NumPy and Exudyn."""
