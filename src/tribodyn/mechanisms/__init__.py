"""Mechanisms: what the user gives, made into initial value problems."""
