"""Numbers of long recordings on their way to the page."""

import numpy as np

from app.browser.page_events import PageEvents
from app.browser.plots import LinkedPlots
from tests.app.panels.test_plots import calls, decoded

FRAMES = 54_000  # an hour at 15 Hz


def test_an_hour_is_sent_in_a_few_messages_of_four_bytes_a_number(client):
    plots = LinkedPlots(client, PageEvents(client), lambda _: None)
    client.take_sent()
    values = np.random.default_rng(0).random(FRAMES)
    plots.add("A", np.arange(FRAMES), np.ones(FRAMES, dtype=bool), {"speed": values, "x": values})
    sent = calls(client, "add")
    assert len(sent) < 10
    size = sum(len(message.source) for message in client.take_sent())
    assert size < FRAMES * (4 + 1 + 2 * 4) * 1.4  # base64 takes a third more
    arrived = np.concatenate([decoded(arrays["speed"], "<f4") for _, _, _, arrays in sent])
    np.testing.assert_array_equal(arrived, values.astype(np.float32))
    frames = np.concatenate([decoded(frames, "<u4") for _, frames, _, _ in sent])
    np.testing.assert_array_equal(frames, np.arange(FRAMES))
