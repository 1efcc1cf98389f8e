"""Tribo-dynamics of mechanisms with dry, rough, worn clearance joints."""
