"""The variable stator vane mechanism with one clearance joint at the vane trunnion."""
