"""What is printed for people at a terminal, and plainly elsewhere."""
