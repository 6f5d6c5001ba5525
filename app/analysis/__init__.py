"""Recordings and parameters in; pairs, flows and numbers out."""

from app.analysis.pair_estimator import flows

__all__ = ["flows"]
