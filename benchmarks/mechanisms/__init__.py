"""Mechanisms of users: random ones, rings of vanes, chains."""
