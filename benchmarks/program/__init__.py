"""What a user waits for: commands, sweeps, the workbench; memory and time beside the estimate."""
