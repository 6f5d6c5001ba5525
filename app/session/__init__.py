"""State of one browser client, the commands that change it, and the snapshot of it."""
