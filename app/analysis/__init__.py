"""Recordings and parameters in; pairs, flows and numbers out."""

from app.analysis.flows import flows

__all__ = ["flows"]
