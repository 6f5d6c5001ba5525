"""What people use: the viser app and the command line."""
