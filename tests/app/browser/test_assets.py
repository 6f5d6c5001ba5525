"""Scripts and style sheets of our own elements."""

from app.browser.assets import call, run_asset
from tests.app.browser.viser_page import page, scripts_and_styles


def test_a_script_runs_as_it_is_in_its_file(client):
    client.take_sent()
    run_asset(client, "events.js")
    (message,) = client.take_sent()
    assert message.source.startswith("// What a person does")


def test_a_function_is_called_with_values(client):
    client.take_sent()
    call(client, "timeline.show", {"frame": 1}, 'a "quote"')
    (message,) = client.take_sent()
    assert message.source == 'window.tofscope.timeline.show({"frame":1}, "a \\"quote\\"");'


def test_what_our_scripts_look_for_is_in_the_page():
    """An upgrade of viser may have changed what they find by name."""
    assert 'id="root"' in page(), "the page has no #root any more: timeline.css shortens it"
    for pattern, why in (
        ("role:`tablist`", "tabs do not stay open (tabs.js)"),
        ("role:`tab`", "tabs do not stay open (tabs.js)"),
        ('"aria-selected"', "tabs do not stay open (tabs.js)"),
        ("htmlFor:", "labels have no hints (hints.js)"),
        ("__staticSelector:`Spotlight`", "keys have raw names in the palette (hints.js)"),
        ("--mantine-color-body", "the timeline has no background (timeline.css)"),
        ("--mantine-primary-color-filled", "the play button has no colour (timeline.css)"),
        ("__viserMutable", "events do not arrive (events.js)"),
    ):
        assert pattern in scripts_and_styles(), f"viser's page has no {pattern} any more: {why}"
