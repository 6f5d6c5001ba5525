import asyncio
import threading

from app.browser.controls import show_value


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
