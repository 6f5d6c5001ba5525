"""Edges that a minimum spanning tree may have beside the short ones."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from estimator.engine.blocks import BLOCK, Blocks, blocks_near
from estimator.engine.compiled import compiled
from estimator.engine.lanes import beyond, boxes_near, lowest_set, near
from estimator.engine.prim import Edges, Tree
from estimator.engine.range_maximum import maximum_between, range_maxima

_SLACK = 1.0 + 1e-15
"""Factor of a squared length, so that rounding never loses an edge; the length itself decides."""


@compiled
def edges_of(size: int, ends: NDArray[np.int32], weight: NDArray[np.float64]) -> Edges:
    """Put edges (E, 2) into the rows of both their ends."""
    begin = np.zeros(size + 1, np.int64)
    for edge in range(len(weight)):
        begin[ends[edge, 0] + 1] += 1
        begin[ends[edge, 1] + 1] += 1
    begin = np.cumsum(begin)
    point, weights = np.empty(begin[-1], np.int32), np.empty(begin[-1])
    filled = begin[:-1].copy()
    for edge in range(len(weight)):
        for end in range(2):
            row = ends[edge, end]
            point[filled[row]], weights[filled[row]] = ends[edge, 1 - end], weight[edge]
            filled[row] += 1
    return Edges(begin, point, weights)


@compiled
def components(tree: Tree) -> NDArray[np.int32]:
    """Number (N,) of each point's component in a tree that spans several."""
    component = np.empty(len(tree.point), np.int32)
    number = -1
    for step in range(len(tree.point)):
        number += tree.weight[step] == np.inf
        component[tree.point[step]] = number
    return component


@compiled
def leaving_edges(
    blocks: Blocks, squared_core: NDArray[np.float64], component: NDArray[np.int32]
) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
    """Shortest edge that leaves each component but the largest.

    Args:
        blocks: of N points.
        squared_core: (P,) in the order of the blocks.
        component: (N,) number of each point's component, in the cloud's order.

    Returns:
        Both ends (C - 1, 2) of the edges in the cloud's numbers, and their lengths in metres.
    """
    number, size = blocks.number, len(blocks.number)
    own = component[number]
    only = _only_component(own)
    sizes = np.bincount(own)
    largest = int(np.argmax(sizes))
    ends, weight = _any_leaving_edges(blocks, squared_core, own, largest)
    candidates = np.empty(blocks.boxes.shape[1] + BLOCK, np.int32)
    for i in range(size):
        part = own[i]
        if part == largest or squared_core[i] >= weight[part]:
            continue
        x, y, z = blocks.points[0, i], blocks.points[1, i], blocks.points[2, i]
        corner, limit = (x, y, z), float(weight[part])
        found = blocks_near(blocks, corner, corner, limit, candidates)
        for candidate in range(found):
            block = np.int64(candidates[candidate])
            if only[block] == part:
                continue
            mask = near(blocks.points, block * BLOCK, x, y, z, weight[part])
            while mask:
                j = block * BLOCK + lowest_set(mask)
                mask &= mask - 1
                if own[j] != part:
                    length = _squared_length(blocks, squared_core, i, j)
                    if length < weight[part]:
                        weight[part], ends[part, 0], ends[part, 1] = length, i, j
    kept = np.flatnonzero(np.arange(len(sizes)) != largest)
    numbers = np.empty((len(kept), 2), np.int32)
    for edge in range(len(kept)):
        for end in range(2):
            numbers[edge, end] = number[ends[kept[edge], end]]
    return numbers, np.sqrt(weight[kept])


@compiled
def _any_leaving_edges(
    blocks: Blocks, squared_core: NDArray[np.float64], own: NDArray[np.int32], largest: int
) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
    """Some edge out of each component but the largest, in the order of the blocks, length squared.

    Searches begin with their length, which is finite.
    """
    count = own.max() + 1
    ends, weight = np.empty((count, 2), np.int32), np.full(count, np.inf)
    for i in range(len(own)):
        part = own[i]
        if part != largest and weight[part] == np.inf:
            outside = 0
            while own[outside] == part:
                outside += 1
            weight[part] = _squared_length(blocks, squared_core, i, outside)
            ends[part, 0], ends[part, 1] = i, outside
    return ends, weight


@compiled
def longer_edges(
    blocks: Blocks, squared_core: NDArray[np.float64], tree: Tree, room: int
) -> tuple[NDArray[np.int32], NDArray[np.float64], bool]:
    """All edges, short ones aside, that some minimum spanning tree may have.

    Such an edge joins two points that no path of shorter edges joins. In the order of Prim's
    algorithm the longest edge of a tree's path between two points is the longest of those added
    between them, so the range maximum over a tree of part of the edges bounds the edges to look
    for; over two blocks of points it bounds them all.

    Args:
        blocks: of N points.
        squared_core: (P,) in the order of the blocks.
        tree: that spans the cloud with the short edges, and any others where those do not suffice.
        room: most edges.

    Returns:
        Both ends (E, 2) in the cloud's numbers, lengths in metres, and whether there was room.
    """
    size = len(blocks.number)
    table, position = range_maxima(tree.weight), _positions(blocks, tree)
    search = _Search(blocks, squared_core, table, position)
    block_steps = _extremes(position, BLOCK, blocks.boxes.shape[1])
    superblock_steps = _extremes(position, BLOCK * BLOCK, blocks.superboxes.shape[1])
    superblocks = (size + BLOCK * BLOCK - 1) // (BLOCK * BLOCK)
    ends, weight, found = np.empty((room, 2), np.int32), np.empty(room), 0
    for first in range(superblocks):
        for second in range(first, superblocks):
            limit = _limit(table, superblock_steps, first, second)
            if _squared_gap(blocks.superboxes, first, second) > limit:
                continue
            for block in range(first * BLOCK, first * BLOCK + BLOCK):
                mask = _boxes_near_box(blocks.boxes, second * BLOCK, block, limit)
                while mask:
                    partner = second * BLOCK + lowest_set(mask)
                    mask &= mask - 1
                    inner = _limit(table, block_steps, block, partner)
                    if partner < block or _squared_gap(blocks.boxes, block, partner) > inner:
                        continue
                    found = _put_edges(search, block, partner, inner, ends, weight, found)
                    if found > room:
                        return ends, weight, False
    return ends[:found], weight[:found], True


class _Search(NamedTuple):
    """What the search for longer edges looks at.

    Attributes:
        blocks: of N points.
        squared_core: (P,) in the order of the blocks.
        table: range maxima of the tree's edges, in the order of its steps.
        position: (N,) step at which each point, in the order of the blocks, was added.
    """

    blocks: Blocks
    squared_core: NDArray[np.float64]
    table: NDArray[np.float64]
    position: NDArray[np.int32]


@compiled
def _put_edges(
    search: _Search,
    block: int,
    partner: int,
    limit: float,
    ends: NDArray[np.int32],
    weight: NDArray[np.float64],
    found: int,
) -> int:
    """Append the edges between two blocks; return their new number, one too many without room."""
    blocks, cores, position = search.blocks, search.squared_core, search.position
    for i in range(block * BLOCK, min(block * BLOCK + BLOCK, len(position))):
        x, y, z = blocks.points[0, i], blocks.points[1, i], blocks.points[2, i]
        mask = beyond(blocks.points, cores, partner * BLOCK, x, y, z, cores[i], limit)
        if partner == block:
            mask &= -2 << (i - block * BLOCK)  # each pair once
        while mask:
            j = partner * BLOCK + lowest_set(mask)
            mask &= mask - 1
            length = np.sqrt(_squared_length(blocks, cores, i, j))
            first, last = min(position[i], position[j]), max(position[i], position[j])
            if length > maximum_between(search.table, first, last):
                continue
            if found == len(weight):
                return found + 1
            ends[found, 0], ends[found, 1] = blocks.number[i], blocks.number[j]
            weight[found] = length
            found += 1
    return found


@compiled
def _limit(
    table: NDArray[np.float64],
    steps: tuple[NDArray[np.int32], NDArray[np.int32]],
    first: int,
    second: int,
) -> float:
    """Bound of the squared lengths of the edges between two groups of points."""
    begin, end = min(steps[0][first], steps[0][second]), max(steps[1][first], steps[1][second])
    return maximum_between(table, begin, end) ** 2 * _SLACK if end > begin else -1.0


@compiled
def _boxes_near_box(boxes: NDArray[np.float64], at: int, box: int, limit: float) -> int:
    """Mask of the eight boxes from `at` within a squared distance of one of them."""
    return boxes_near(
        boxes, at, boxes[0, box], boxes[1, box], boxes[2, box],
        boxes[3, box], boxes[4, box], boxes[5, box], limit,
    )  # fmt: skip


@compiled
def _squared_length(blocks: Blocks, squared_core: NDArray[np.float64], i: int, j: int) -> float:
    """Squared mutual reachability of two points."""
    points = blocks.points
    dx, dy, dz = (
        points[0, i] - points[0, j],
        points[1, i] - points[1, j],
        points[2, i] - points[2, j],
    )
    return max(squared_core[i], squared_core[j], (dx * dx + dy * dy) + dz * dz)


@compiled
def _squared_gap(boxes: NDArray[np.float64], a: int, b: int) -> float:
    total = 0.0
    for axis in range(3):
        gap = max(boxes[axis, a] - boxes[3 + axis, b], boxes[axis, b] - boxes[3 + axis, a])
        total += max(gap, 0.0) ** 2
    return total


@compiled
def _positions(blocks: Blocks, tree: Tree) -> NDArray[np.int32]:
    """Step (N,) at which each point, in the order of the blocks, was added to the tree."""
    step_of, size = np.empty(len(tree.point), np.int32), len(tree.point)
    for step in range(size):
        step_of[tree.point[step]] = step
    position = np.empty(size, np.int32)
    for i in range(size):
        position[i] = step_of[blocks.number[i]]
    return position


@compiled
def _extremes(
    values: NDArray[np.int32], width: int, count: int
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Smallest and largest (count,) of each `width` values."""
    first, last = np.full(count, len(values), np.int32), np.full(count, -1, np.int32)
    for i in range(len(values)):
        first[i // width] = min(first[i // width], values[i])
        last[i // width] = max(last[i // width], values[i])
    return first, last


@compiled
def _only_component(own: NDArray[np.int32]) -> NDArray[np.int32]:
    """Component of each block whose points are all of it, else -1."""
    only = own[::BLOCK].copy()
    for i in range(len(own)):
        if own[i] != only[i // BLOCK]:
            only[i // BLOCK] = -1
    return only
