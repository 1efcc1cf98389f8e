"""Problems of the published sets beyond those of ``problems.py`` and ``dae_problems.py``."""
