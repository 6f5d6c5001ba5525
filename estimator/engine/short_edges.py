"""Edges between points of which one is within the other's core distance."""

import numpy as np

from estimator.engine.blocks import Blocks
from estimator.engine.compiled import compiled
from estimator.engine.neighbours import Neighbours
from estimator.engine.prim import Edges


@compiled
def short_edges(blocks: Blocks, near: Neighbours) -> Edges:
    """Edges of all such pairs, in the given cloud's numbers and without weights.

    An edge is as long as the larger of the two core distances.
    """
    number, size = blocks.number, len(blocks.number)
    begin = np.zeros(size + 1, np.int64)
    for i in range(size):
        begin[number[i] + 1] += near.begin[i + 1] - near.begin[i]
        for at in range(near.begin[i], near.begin[i + 1]):
            j = near.other[at]
            if near.squared[at] > near.squared_core[j]:  # i is not in the row of j
                begin[number[j] + 1] += 1
    begin = np.cumsum(begin)
    point, filled = np.empty(begin[-1], np.int32), begin[:-1].copy()
    for i in range(size):
        own = number[i]
        for at in range(near.begin[i], near.begin[i + 1]):
            j = near.other[at]
            other = number[j]
            point[filled[own]] = other
            filled[own] += 1
            if near.squared[at] > near.squared_core[j]:
                point[filled[other]] = own
                filled[other] += 1
    return Edges(begin, point, np.empty(0))
