"""The loop that integrates a compiled problem with the core of the solver."""
