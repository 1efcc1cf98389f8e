"""What the page of the workbench is made of, beside what it shares with the report."""
