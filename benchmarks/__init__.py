"""Speed and accuracy against other solvers."""
