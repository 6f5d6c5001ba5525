"""Output for people: tables and progress at a terminal, plain lines elsewhere."""
