"""What a result means: series, events, charts over time, pictures of the bushing. Nothing here draws."""
