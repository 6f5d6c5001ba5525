"""Blocks of points, their boxes, and the search for those that are near."""

import numpy as np
import pytest

from estimator.engine.blocks import BLOCK, blocks_near, in_blocks
from tests.estimator.engine.clouds import KINDS, cloud_of

SIZES = [1, 2, 7, 8, 9, 63, 64, 65, 127, 128, 129, 511, 512, 513, 1000]


def cloud_of_size(size: int) -> np.ndarray:
    return np.random.default_rng(size).normal(size=(size, 3))


CLOUDS = {str(size): cloud_of_size(size) for size in SIZES} | {
    kind: cloud_of(kind, np.random.default_rng(1)) for kind in KINDS
}


@pytest.fixture(params=CLOUDS)
def cloud(request) -> np.ndarray:
    return CLOUDS[request.param]


def test_points_are_put_into_another_order(cloud):
    before = cloud.copy()
    blocks = in_blocks(cloud)
    size = len(cloud)
    assert cloud.tolist() == before.tolist()
    assert sorted(blocks.number.tolist()) == list(range(size))
    assert blocks.points[:, :size].T.tolist() == cloud[blocks.number].tolist()
    assert (blocks.points[:, size:] == np.inf).all()


def test_lengths_are_padded_for_the_vector_instructions(cloud):
    blocks = in_blocks(cloud)
    superblocks = -(-len(cloud) // 64)
    assert blocks.points.shape[1] == superblocks * 64
    assert blocks.boxes.shape[1] == superblocks * 8
    assert blocks.superboxes.shape[1] == -(-superblocks // 8) * 8


@pytest.mark.parametrize(("name", "width"), [("boxes", 8), ("superboxes", 64)])
def test_boxes_are_those_of_their_points(cloud, name, width):
    blocks = in_blocks(cloud)
    boxes, points = getattr(blocks, name), blocks.points[:, : len(cloud)]
    used = -(-len(cloud) // width)
    for box in range(used):
        inside = points[:, box * width : (box + 1) * width]
        assert boxes[:3, box].tolist() == inside.min(axis=1).tolist()
        assert boxes[3:, box].tolist() == inside.max(axis=1).tolist()
    assert (boxes[:3, used:] == np.inf).all()
    assert (boxes[3:, used:] == -np.inf).all()


def test_blocks_near_a_box_are_those_of_all_boxes(cloud):
    rng = np.random.default_rng(0)
    blocks = in_blocks(cloud)
    out = np.empty(blocks.boxes.shape[1] + BLOCK, np.int32)
    width = max(np.ptp(cloud, axis=0).max(), 1e-3)
    for _ in range(20):
        ends = cloud[rng.integers(0, len(cloud), 2)] + rng.normal(size=(2, 3)) * width * 0.1
        low, high = ends.min(axis=0), ends.max(axis=0)
        gaps = np.maximum(blocks.boxes[:3] - high[:, None], low[:, None] - blocks.boxes[3:])
        x, y, z = np.maximum(gaps, 0.0)
        distances = (x * x + y * y) + z * z
        finite = distances[np.isfinite(distances)]
        for limit in (0.0, rng.choice(finite), finite.max()):
            found = blocks_near(blocks, tuple(low), tuple(high), float(limit), out)
            assert out[:found].tolist() == np.flatnonzero(distances <= limit).tolist()
