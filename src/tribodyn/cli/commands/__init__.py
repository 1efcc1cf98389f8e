"""Sub-commands of ``tribodyn``: a module each, named in :data:`tribodyn.cli.main.COMMANDS`."""
