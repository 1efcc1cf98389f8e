"""Type aliases, errors, constants, the problem protocol, named tuples of arrays; no other room below."""
