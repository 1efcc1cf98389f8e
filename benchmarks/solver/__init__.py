"""The solver, beside Cash's own codes, SUNDIALS and SciPy."""
