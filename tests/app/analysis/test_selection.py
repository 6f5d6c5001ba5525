from dataclasses import replace

import pytest

from app.analysis.estimates import Estimates
from app.analysis.selection import Selection, cluster_of
from estimator import Label, Parameters, SceneFlow
from tests.app.fake_recordings import fake_opened


@pytest.fixture(scope="module")
def pair():
    return Estimates().estimated(fake_opened(), 20, Parameters())


def moving(pair):
    (index,) = [c.index for c in pair.flow.clusters if c.label == Label.MOVING]
    return index


def renumbered(pair, order):
    """The pair with its clusters in another order, their numbers following it."""
    clusters = tuple(replace(pair.flow.clusters[i], index=n) for n, i in enumerate(order))
    flow = pair.flow
    return replace(pair, flow=SceneFlow(flow.label, flow.velocity, flow.cluster, clusters))


def test_nothing_is_picked_at_first(pair):
    assert Selection().follow(pair) is None


def test_a_picked_cluster_is_followed_by_its_points_and_not_by_its_number(pair):
    selection, index = Selection(), moving(pair)
    selection.pick(pair, index)
    assert selection.follow(pair) == index
    order = [(i + 1) % 5 for i in range(5)]
    assert order.index(index) != index
    assert selection.follow(renumbered(pair, order)) == order.index(index)


def test_the_cluster_of_a_link_is_picked_in_the_first_pair_with_a_flow(pair):
    selection, index = Selection(), moving(pair)
    selection.await_cluster(index)
    assert selection.follow(replace(pair, flow=None)) is None
    assert selection.follow(pair) == index
    selection.pick(pair, None)
    assert selection.follow(pair) is None
    selection.await_cluster(999)
    assert selection.follow(pair) is None
    selection.await_cluster(index)
    selection.drop()
    assert selection.follow(pair) is None


def test_a_cluster_that_moves_is_followed_from_frame_to_frame():
    estimates, opened, selection = Estimates(), fake_opened(), Selection()
    pair = estimates.estimated(opened, 10, Parameters())
    selection.pick(pair, moving(pair))
    for k in range(11, 35):
        pair = estimates.estimated(opened, k, Parameters())
        assert selection.follow(pair) == moving(pair)


def test_a_cluster_that_is_gone_for_a_while_is_found_again(pair):
    selection, index = Selection(), moving(pair)
    selection.pick(pair, index)
    others = [i for i in range(5) if i != index]
    assert selection.follow(renumbered(pair, others)) is None
    assert selection.follow(replace(pair, flow=None)) is None
    assert selection.follow(pair) == index
    selection.drop()
    assert selection.follow(pair) is None


def test_picking_none_or_a_number_that_is_not_there_picks_none(pair):
    for wrong in (None, 17):
        selection = Selection()
        selection.pick(pair, 0)
        selection.pick(pair, wrong)
        assert selection.follow(pair) is None
        assert cluster_of(pair, wrong) is None
