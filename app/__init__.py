"""The viser app and the command line."""
