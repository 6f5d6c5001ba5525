"""Histograms as SVG, in the page's light or dark colours."""

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from app.panels.cluster_story import fills
from app.scene.colours import css
from app.scene.palettes import Palette
from estimator import Label

_WIDTH, _HEIGHT = 300, 98
_LEFT, _RIGHT, _TOP, _BOTTOM = 22, 292, 30, 76


@dataclass(frozen=True)
class Histogram:
    """Histogram of values from 0, bars stacked by label, with a threshold as a line.

    Attributes:
        title: quantity, with its unit.
        values: (value, label) each; NaN is left out.
        upper: end of the last bar, which also counts all larger values.
        bars: number of bars.
        threshold: its symbol and its value.
        palette: of the drawing.
        marked: value to mark below the axis, None for none.
    """

    title: str
    values: Sequence[tuple[float, Label]]
    upper: float
    bars: int
    threshold: tuple[str, float]
    palette: Palette
    marked: float | None = None

    def counts(self) -> list[Counter[Label]]:
        """Number of values of each label in each bar."""
        counts = [Counter[Label]() for _ in range(self.bars)]
        for value, label in self.values:
            if not math.isnan(value):
                counts[min(int(value / self.upper * self.bars), self.bars - 1)][label] += 1
        return counts

    def svg(self) -> str:
        """SVG as wide as the panel."""
        symbol, threshold = self.threshold
        counts = self.counts()
        highest = max([1, *(bar.total() for bar in counts)])
        x = self._x(threshold)
        anchor = "end" if x > (_LEFT + _RIGHT) / 2 else "start"
        parts = [
            f'<text x="{_LEFT}" y="11" font-weight="bold">{self.title}</text>',
            *self._bars(counts, highest),
            f'<path d="M{_LEFT} {_BOTTOM}H{_RIGHT}" stroke="currentColor" stroke-opacity="0.6"/>',
            f'<path d="M{x:.1f} {_TOP - 10}V{_BOTTOM}" stroke="currentColor" stroke-width="1.5" '
            'stroke-dasharray="4 2"/>',
            f'<text x="{x + (-4 if anchor == "end" else 4):.1f}" y="{_TOP - 4}" '
            f'text-anchor="{anchor}">{symbol} {threshold:g}</text>',
            f'<text x="{_LEFT - 4}" y="{_TOP + 8}" text-anchor="end">{highest}</text>',
            f'<text x="{_LEFT - 4}" y="{_BOTTOM}" text-anchor="end">0</text>',
            f'<text x="{_LEFT}" y="{_BOTTOM + 18}">0</text>',
            f'<text x="{_RIGHT}" y="{_BOTTOM + 18}" text-anchor="end">{self.upper:g}</text>',
        ]
        if self.marked is not None and not math.isnan(self.marked):
            at = self._x(self.marked)
            parts.append(
                f'<path d="M{at:.1f} {_BOTTOM + 2}l-4 7h8z" fill="{css(self.palette.picked)}"/>'
            )
        return (
            f'<svg viewBox="0 0 {_WIDTH} {_HEIGHT}" width="100%" fill="currentColor" '
            f'font-size="10" role="img" style="padding: 0 0.5em">{"".join(parts)}</svg>'
        )

    def _bars(self, counts: Sequence[Counter[Label]], highest: int) -> list[str]:
        width = (_RIGHT - _LEFT) / self.bars
        drawn: list[str] = []
        for number, bar in enumerate(counts):
            base = float(_BOTTOM)
            for label, fill in fills(self.palette).items():
                height = bar[label] / highest * (_BOTTOM - _TOP)
                base -= height
                if height:
                    drawn.append(
                        f'<rect x="{_LEFT + number * width + 0.5:.1f}" y="{base:.1f}" '
                        f'width="{width - 1:.1f}" height="{height:.1f}" {fill}/>'
                    )
        return drawn

    def _x(self, value: float) -> float:
        return _LEFT + min(value / self.upper, 1.0) * (_RIGHT - _LEFT)


def upper_limit(values: Iterable[float]) -> float:
    """Least number of 1, 2 or 5 times a power of ten not below any of the values."""
    largest = max((value for value in values if value > 0), default=1.0)
    power = 10.0 ** math.floor(math.log10(largest))
    return next(step * power for step in (1, 2, 5, 10) if step * power >= largest * (1 - 1e-9))
