"""The names of two sets of parameters that are compared."""

A, B = "A", "B"
