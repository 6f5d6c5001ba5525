"""Analysis of recordings: pairs, flows, metrics and timelines, cached for all sessions."""

from app.analysis.pair_estimator import flows

__all__ = ["flows"]
