"""What the plots say in words: progress, means, and which pairs count in them."""

from collections.abc import Mapping

import numpy as np

from app.analysis.comparison import A
from app.analysis.survey import Survey
from app.panels.tables import PLOTTED, framed
from estimator import METRIC_INFO

HOLLOW = "Hollow: the object rests at one or both frames, so the pair does not count."


def summary(surveys: Mapping[str, Survey | None], *, has_truth: bool) -> str:
    """The progress, or why points are hollow or errors are missing, in a sentence.

    Args:
        surveys: {A or B: its survey, None before its first update}.
        has_truth: whether the recording has.
    """
    share, frames = progress(surveys)
    if share < 1:
        return f"Computing the whole recording: {frames}"
    if not has_truth:
        return "No truth in this recording: no errors, coverage and precision."
    return " ".join([HOLLOW, *_none_counts(surveys)])


def summary_html(sentence: str, share: float) -> str:
    """HTML of a summary, and of the share of the frames that are computed as a bar."""
    bar = (
        '<div style="height: 3px; border-radius: 2px; background: currentColor;'
        f' width: {100 * share:.0f}%; opacity: {0.5 if share < 1 else 0}"></div>'
    )
    # Room for two lines, so that the plots below stay in place.
    return framed(f'<div style="min-height: 2.9em">{sentence}</div>{bar}')


def progress(surveys: Mapping[str, Survey | None]) -> tuple[float, str]:
    """Share of the frames that are computed, and their number in words, "" before any is."""
    known = [survey for survey in surveys.values() if survey is not None]
    if not known:
        return 0.0, ""
    done = sum(int(np.count_nonzero(survey.done)) for survey in known)
    total = len(known[0]) * len(surveys)
    share = 1.0 if all(s is not None and s.complete for s in surveys.values()) else done / total
    return min(share, 1.0), f"{done} of {total} frames"


def pairs_that_count(survey: Survey) -> str:
    """Number of the pairs that count among all, in words."""
    pairs = "pair counts" if survey.pairs == 1 else "pairs count"
    return f"{np.count_nonzero(survey.counts)} of {survey.pairs} {pairs}"


def means(surveys: Mapping[str, Survey | None]) -> dict[str, str]:
    """{metric: its mean over the pairs that count, and how many do} of the complete surveys."""
    known = {side: s for side, s in surveys.items() if s is not None and s.complete}
    found = {side: survey.summary() for side, survey in known.items()}
    counts = {side: pairs_that_count(survey) for side, survey in known.items()}
    said: dict[str, str] = {}
    if not known:
        return dict.fromkeys(PLOTTED, "Mean –")  # so that nothing moves once they are known
    for name in PLOTTED:
        values = {side: METRIC_INFO[name].text(getattr(m, name)) for side, m in found.items()}
        if list(surveys) == [A]:
            said[name] = f"Mean {values[A]}, {counts[A]}"
        elif len(set(counts.values())) == 1:
            both = ", ".join(f"{side} {value}" for side, value in values.items())
            said[name] = f"Mean {both}; {next(iter(counts.values()))}"
        else:
            both = "; ".join(f"{side} {value}, {counts[side]}" for side, value in values.items())
            said[name] = f"Mean {both}"
    return said


def _none_counts(surveys: Mapping[str, Survey | None]) -> list[str]:
    """False flow where no pair counts, so that it is the only number."""
    known = [survey for survey in surveys.values() if survey is not None]
    if any(survey.counts.any() for survey in known):
        return []
    flows = [survey.summary().false_flow for survey in known]
    info = METRIC_INFO["false_flow"]
    texts = [info.text(value) for value in flows if not np.isnan(value)]
    return [
        "No pair counts.",
        *([f"{info.title.capitalize()}: {', '.join(texts)}."] if texts else []),
    ]
