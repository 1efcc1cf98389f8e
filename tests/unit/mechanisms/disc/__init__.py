"""A disc falling on the floor of a bushing: the smallest mechanism, for a test that adds it."""
