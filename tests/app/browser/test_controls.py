import asyncio
import threading

from viser._messages import GuiUpdateMessage

from app.browser.controls import show_value
from tests.app.waiting import until


def test_a_value_is_shown_when_it_returns(client):
    slider = client.gui.add_slider("k", min=0, max=9, step=1, initial_value=3)
    show_value(slider, 7)
    assert slider.value == 7


def test_it_does_not_come_between_a_change_and_its_callback(client):
    slider = client.gui.add_slider("k", min=0, max=9, step=1, initial_value=3)
    chosen, showing = [], threading.Event()

    # viser calls a change's callbacks one after the other, all in one go.
    @slider.on_update
    async def _(event):
        if event.client_id is not None:
            thread = threading.Thread(target=lambda: (showing.set(), show_value(slider, 3)))
            thread.start()
            assert showing.wait(10)
            thread.join(0.2)

    @slider.on_update
    async def _(event):
        if event.client_id is not None:
            chosen.append(slider.value)

    client.change("k", 8)
    assert chosen == [8]
    done = asyncio.run_coroutine_threadsafe(asyncio.sleep(0.01), client.server.get_event_loop())
    done.result(10)
    assert slider.value == 3


def test_after_a_persons_last_change_the_page_is_told_what_holds(client):
    slider = client.gui.add_slider("k", min=0, max=9, step=1, initial_value=3)
    show_value(slider, 7)
    client.take_sent()
    for value in (5, 6, 8):
        client.change("k", value)  # the 7 may arrive in the page only now

    def told():
        return [
            message.updates["value"]
            for message in client.sent
            # viser tells all other clients of each change.
            if isinstance(message, GuiUpdateMessage) and message.excluded_self_client is None
        ]

    until(told)
    assert told() == [8]
