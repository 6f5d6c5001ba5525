"""Recordings and parameters in; pairs, flows and numbers out."""
