"""Hostile recordings: mutants of good ones and files made by hand, and how they are tried."""
