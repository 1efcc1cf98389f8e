"""The paper reproduced: its reduced model, its figures 8 to 19 from our own runs, and its claims judged."""
