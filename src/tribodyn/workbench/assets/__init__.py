"""Parts of the workbench's page beside those that it shares with the report."""
