"""The validation sets, one folder each."""
