"""A rigid journal in a bushing under stated loads, dry or lubricated."""
