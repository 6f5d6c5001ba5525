"""Minimum spanning tree of a cloud over mutual reachability, the same as scikit-learn's.

Nearly all its edges are short: one end is within the core distance of the other. So Prim's
algorithm runs over those first. What they leave apart is joined; the tree so found bounds the
longer edges that can belong to a minimum spanning tree, and with all of these it runs again.
Every edge that it takes, or that is as long as one that it takes, is then in the graph, so the
result has scikit-learn's order, edges and lengths.
"""

import numpy as np
from numpy.typing import NDArray

from estimator.engine.blocks import in_blocks
from estimator.engine.compiled import compiled
from estimator.engine.longer_edges import components, edges_of, leaving_edges, longer_edges
from estimator.engine.neighbours import neighbours
from estimator.engine.prim import Tree, dense_prim, sparse_prim
from estimator.engine.short_edges import short_edges

_COMPONENTS = 100
_LONGER = 16  # edges a point
_MORE = 16  # neighbours a point above k


@compiled
def spanning_tree(cloud: NDArray[np.float64], k: int) -> Tree:
    """Span a cloud over mutual reachability.

    Args:
        cloud: (N, 3) metres, finite, N > 0.
        k: neighbours of a core point, itself included, at most N.
    """
    size = len(cloud)
    blocks = in_blocks(cloud)
    near = neighbours(blocks, k, size * (k + _MORE))
    core = np.empty(size)
    for i in range(size):
        core[blocks.number[i]] = np.sqrt(near.squared_core[i])
    if not near.complete:
        return dense_prim(cloud.T.copy(), core)
    short = short_edges(blocks, near)
    ends, weight = np.empty((0, 2), np.int32), np.empty(0)
    tree = sparse_prim(core, short, edges_of(size, ends, weight))
    while True:
        component = components(tree)
        parts = component[tree.point[-1]] + 1
        if parts > _COMPONENTS:
            return dense_prim(cloud.T.copy(), core)
        if parts == 1:
            break
        more_ends, more_weight = leaving_edges(blocks, near.squared_core, component)
        ends = np.concatenate((ends, more_ends))
        weight = np.concatenate((weight, more_weight))
        tree = sparse_prim(core, short, edges_of(size, ends, weight))
    ends, weight, complete = longer_edges(blocks, near.squared_core, tree, size * _LONGER)
    if not complete:
        return dense_prim(cloud.T.copy(), core)
    if len(weight) == 0:
        return tree
    return sparse_prim(core, short, edges_of(size, ends, weight))
