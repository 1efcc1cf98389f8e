"""The command ``tribodyn``: thin, parses, calls and prints. Heavy imports stand inside functions."""
