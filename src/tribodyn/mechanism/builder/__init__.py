"""The builder ``td.Mechanism``: a mechanism put together in Python."""
