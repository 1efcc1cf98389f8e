"""Papers reproduced from our own runs, one folder each."""
