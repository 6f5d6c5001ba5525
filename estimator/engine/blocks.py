"""Points in blocks of eight neighbours, each with its box: what the engine searches in."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from estimator.engine.compiled import compiled
from estimator.engine.lanes import boxes_near, put

BLOCK = 8
"""Points of a block, and blocks of a superblock: as many as `lanes` looks at in one step."""


class Blocks(NamedTuple):
    """Points in the order of a k-d tree, whose leaves are blocks of eight.

    Places beyond the N points, up to a multiple of 64, hold points at infinity, and boxes beyond
    the last are empty: nothing is ever near them.

    Attributes:
        points: (3, P) metres, one row an axis.
        number: (N,) row of each point in the given cloud.
        boxes: (6, B) lowest corner, then highest corner, of each block of eight.
        superboxes: (6, S) of each superblock of eight blocks.
    """

    points: NDArray[np.float64]
    number: NDArray[np.int32]
    boxes: NDArray[np.float64]
    superboxes: NDArray[np.float64]


@compiled
def in_blocks(cloud: NDArray[np.float64]) -> Blocks:
    """Sort finite points (N, 3), N > 0, into blocks."""
    size = len(cloud)
    superblocks = (size + BLOCK * BLOCK - 1) // (BLOCK * BLOCK)
    points = np.full((3, superblocks * BLOCK * BLOCK), np.inf)
    for axis in range(3):
        for i in range(size):
            points[axis, i] = cloud[i, axis]
    number = np.arange(size).astype(np.int32)
    _sort(points, number, size)
    boxes = _boxes(points, size, BLOCK, superblocks * BLOCK)
    padded = (superblocks + BLOCK - 1) // BLOCK * BLOCK
    superboxes = _boxes(points, size, BLOCK * BLOCK, padded)
    return Blocks(points, number, boxes, superboxes)


@compiled
def blocks_near(
    blocks: Blocks,
    low: tuple[float, float, float],
    high: tuple[float, float, float],
    limit: float,
    out: NDArray[np.int32],
) -> int:
    """List the blocks whose box is within a distance of another box.

    Args:
        blocks: to search.
        low: lowest corner of the other box.
        high: its highest corner.
        limit: squared distance, finite.
        out: receives the numbers of the blocks, ascending; eight places longer than there are.

    Returns:
        Number of blocks found.
    """
    found = 0
    for at in range(0, blocks.superboxes.shape[1], BLOCK):
        mask = boxes_near(
            blocks.superboxes, at, low[0], low[1], low[2], high[0], high[1], high[2], limit
        )
        superblock = at
        while mask:
            if mask & 1:
                first = superblock * BLOCK
                inner = boxes_near(
                    blocks.boxes, first, low[0], low[1], low[2], high[0], high[1], high[2], limit
                )
                found = put(out, found, first, inner)
            mask >>= 1
            superblock += 1
    return found


@compiled
def _sort(points: NDArray[np.float64], number: NDArray[np.int32], size: int) -> None:
    """Split along the longest side until a part is a block."""
    begins, ends, depth = np.empty(128, np.int64), np.empty(128, np.int64), 1
    begins[0], ends[0] = 0, size
    while depth:
        depth -= 1
        begin, end = begins[depth], ends[depth]
        count = end - begin
        if count <= BLOCK:
            continue
        # Superblocks of eight whole blocks stay together.
        unit = BLOCK if count <= BLOCK * BLOCK else BLOCK * BLOCK
        middle = begin + (count // unit + 1) // 2 * unit
        _select(points, number, _longest_side(points, begin, end), begin, end, middle)
        begins[depth], ends[depth] = begin, middle
        begins[depth + 1], ends[depth + 1] = middle, end
        depth += 2


@compiled
def _longest_side(points: NDArray[np.float64], begin: int, end: int) -> int:
    longest, widest = 0, -1.0
    for axis in range(3):
        low = high = points[axis, begin]
        for i in range(begin + 1, end):
            value = points[axis, i]
            low = min(low, value)
            high = max(high, value)
        if high - low > widest:
            longest, widest = axis, high - low
    return longest


@compiled
def _select(
    points: NDArray[np.float64],
    number: NDArray[np.int32],
    axis: int,
    begin: int,
    end: int,
    middle: int,
) -> None:
    """Hoare's selection: nothing before `middle` is beyond what is at or after it."""
    low, high = begin, end - 1
    while low < high:
        first, last, between = (
            points[axis, low],
            points[axis, high],
            points[axis, (low + high) // 2],
        )
        pivot = max(min(first, last), min(max(first, last), between))
        i, j = low, high
        while i <= j:
            while points[axis, i] < pivot:
                i += 1
            while points[axis, j] > pivot:
                j -= 1
            if i <= j:
                for row in range(3):
                    points[row, i], points[row, j] = points[row, j], points[row, i]
                number[i], number[j] = number[j], number[i]
                i += 1
                j -= 1
        if middle <= j:
            high = j
        elif middle >= i:
            low = i
        else:
            return


@compiled
def _boxes(points: NDArray[np.float64], size: int, width: int, padded: int) -> NDArray[np.float64]:
    """Boxes (6, padded) around each `width` points, empty ones at the end."""
    boxes = np.empty((6, padded))
    boxes[:3], boxes[3:] = np.inf, -np.inf
    for axis in range(3):
        for i in range(size):
            box = i // width
            value = points[axis, i]
            boxes[axis, box] = min(boxes[axis, box], value)
            boxes[3 + axis, box] = max(boxes[3 + axis, box], value)
    return boxes
