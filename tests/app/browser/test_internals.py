"""Canaries: each says in words what an upgrade of viser has changed."""

import inspect
import re
import threading
from pathlib import Path

import viser._messages
from viser import _gui_api, _gui_handles, _icons

import app
from app.browser import connections, internals
from tests.app.browser.viser_page import page, scripts_and_styles

INTERNALS = "app/browser/internals.py"


def in_page(*patterns: str, why: str) -> None:
    """Fail with a sentence where viser's page has nothing of one of these patterns any more."""
    missing = [pattern for pattern in patterns if not re.search(pattern, scripts_and_styles())]
    assert not missing, f"viser's page has no {missing} any more; {why} ({INTERNALS})."


def test_a_control_has_the_id_of_its_element(client):
    control = client.gui.add_number("k", 1.0)
    found = internals.element_id(control)
    assert found in client.gui._gui_input_handle_from_uuid, (
        f"a control's `_impl.uuid` is not its id any more: `element_id` of {INTERNALS} needs it"
    )


def test_hints_are_known_by_the_id_of_the_control(client):
    told = client.gui.add_number("k", 1.0, hint="A number.")
    client.gui.add_number("l", 1.0)
    assert internals.hints_of(client) == {told._impl.uuid: "A number."}


def test_actions_run_in_the_event_loop_of_a_control(client):
    control, ran, threads = client.gui.add_number("k", 1.0), threading.Event(), []

    def action():
        threads.append(threading.current_thread())
        ran.set()

    internals.call_in_event_loop(control, action)
    assert ran.wait(10), f"`call_in_event_loop` of {INTERNALS} runs nothing any more"
    called = threading.Event()

    @control.on_update
    async def _(event):
        threads.append(threading.current_thread())
        called.set()

    client.change("k", 2.0)
    assert called.wait(10)
    assert threads[0] is threads[1], (
        f"viser calls back in another thread than `call_in_event_loop` of {INTERNALS} runs in"
    )


def test_a_script_is_sent_to_the_page(client):
    client.take_sent()
    internals.run_script(client, "1 + 1")
    (message,) = client.take_sent()
    assert message == viser._messages.RunJavascriptMessage(source="1 + 1")
    in_page("RunJavascriptMessage", why="`run_script` runs nothing")


def test_the_canvas_of_the_scene_is_found():
    assert internals.SCENE_CANVAS == "canvas[data-engine]"
    in_page(r"setAttribute\(`data-engine`", why="the scene's canvas is not found")


def test_the_input_of_a_number_field_is_found():
    assert internals.NUMBER_INPUT == "input.mantine-NumberInput-input"
    in_page(
        "__staticSelector:`NumberInput`",
        r"classNamesPrefix:\w+=`mantine`",
        why="a number that is left empty does not come back",
    )


def test_dropdowns_open_a_list_of_options():
    assert internals.DROPDOWN == "[aria-haspopup=listbox]"
    assert internals.DROPDOWN_OPTION == "[role=option]"
    in_page(
        *('"aria-haspopup":`listbox`', '"aria-controls":', "role:`option`"),
        why="clicks choose nothing in dropdowns",
    )


def test_sliders_and_tabs_say_what_they_are():
    assert internals.SLIDER_OR_TAB == "[role=slider], [role=tab]"
    in_page("role:`slider`", "role:`tab`", why="arrow keys move playback beside a slider")


def test_the_browsers_storage_is_read_below_a_prefix():
    prefix = internals.STORAGE_PREFIX
    in_page(f"`{prefix}`", why="links and reloads find nothing, and pictures have no size")


def test_the_value_of_a_control_is_sent_again(client):
    control = client.gui.add_number("k", 1.0)
    client.take_sent()
    internals.send_value(control)
    (message,) = client.take_sent()
    assert message == viser._messages.GuiUpdateMessage(control._impl.uuid, {"value": 1.0})


def test_changes_of_controls_wait_where_they_are_kept_from_waiting():
    names = ("sendMessage", "GuiUpdateMessage", "50")
    assert all(name in internals.SEND_AT_ONCE for name in names)
    in_page(
        r"sendMessage\(\w+\),\w+=!1,\w+=!1,\w+=setTimeout\(",
        r"\w+\(50\)\.send\b",
        why="of several quick changes the last alone is sent (SEND_AT_ONCE)",
    )


def test_values_that_arrive_can_be_held_back():
    names = ("messageQueue", "GuiUpdateMessage", "requestRender", internals.NUMBER_INPUT)
    assert all(name in internals.KEEP_TYPED for name in names)
    in_page(
        r"messageQueue:\[\]",
        r"(\w+)=\w+\.messageQueue,\w+=\w+\.drainMessageQueue\b.{,400}\1\.push\(\w+\)",
        why="a value that arrives replaces what is being typed (KEEP_TYPED)",
    )


def test_scripts_can_be_kept_from_drawing_the_scene():
    names = ("messageQueue", "drainMessageQueue", "requestRender", "getRenderRequestState")
    assert all(name in internals.NO_FRAME_FOR_SCRIPTS for name in names)
    in_page(
        *names,
        r"getRenderRequestState===`ready`",
        r"`Gui3DMessage`",
        why="the scene is drawn for each of our scripts (NO_FRAME_FOR_SCRIPTS)",
    )


def test_the_title_of_the_page_can_be_replaced():
    assert page().count(internals.PAGE_TITLE) == 1, (
        f"viser's page has another title: offline pages keep it (PAGE_TITLE of {INTERNALS})"
    )


def test_the_page_is_drawn_into_one_element():
    assert internals.PAGE_ROOT == "#root"
    assert page().count('<div id="root">') == 1, (
        f"viser's page is drawn elsewhere: its own panel is seen while the page loads ({INTERNALS})"
    )


def test_the_button_of_viser_s_own_settings_is_found():
    assert internals.SETTINGS_ICON == "svg.tabler-icon-adjustments"
    in_page(r"`tabler-icon-\$\{", "`adjustments`", why="viser's own settings can be opened")


def test_the_worker_that_holds_the_connection_says_how_it_is():
    patterns = [rf"\w\(\{{type:`{news}`" for news in internals.CONNECTION_NEWS]
    in_page(r"new Worker\(", *patterns, why="a lost connection is not told")


def test_notices_have_classes():
    in_page(
        "`mantine`|=`mantine`", "`Notifications`", "`Notification`", why="notices.css hits nothing"
    )


def test_the_panels_at_one_side_and_the_divider_between_them_are_found():
    in_page(
        *('"data-dock-leaf"', '"data-dock-scroll"', '"data-dock-divider"', "`floating-panel`"),
        why="the parameters' panel is higher than they are (assets/panel_height.js)",
    )


def test_grey_buttons_say_so_in_their_style():
    in_page("--mantine-color-", "-filled", why="they are too pale (assets/controls.css)")


def test_the_notice_of_drawing_by_software_can_be_removed():
    in_page(
        "`webgl-software-rendering`",
        "`RemoveNotificationMessage`",
        why="it stays over the scene (assets/notices.js)",
    )


def test_the_panel_of_a_phone_is_found():
    in_page(
        r"position:`fixed`,bottom:0,right:0.{,80}maxHeight:`60%`,width:`20em`",
        why="it lies behind the timeline (assets/timeline.css)",
    )


def test_a_ray_through_the_pointer_can_be_computed():
    in_page(
        r"__viserMutable=\w+\.current",
        r"__viserSceneTree=\{getState:",
        r"\.current\.canvas=",
        r"\.current\.camera\b",
        why="points and frustums in the scene answer nothing (assets/answers.js)",
    )


def test_the_player_of_an_offline_page_can_be_kept_from_flashing():
    names = ("__viserMutable", "drainMessageQueue", "messageQueue", "requestRender")
    assert all(name in internals.NO_FLASH for name in names)
    in_page(*names, why="offline pages flash where they begin again (NO_FLASH)")


def test_a_page_can_be_kept_at_full_resolution():
    name = internals.FULL_RESOLUTION.strip("?").partition("=")[0]
    in_page(name, why="pictures of slow machines are blurred (FULL_RESOLUTION)")


def test_the_player_of_an_offline_page_has_a_pause_button_that_can_be_found():
    assert "tabler-icon-player-pause-filled" in internals.PAUSE_TO_TYPE
    in_page("player-pause-filled", why="typing a time does not pause (PAUSE_TO_TYPE)")


def test_private_parts_are_used_in_two_files_alone():
    root = Path(app.__file__).parent
    private = {Path(inspect.getfile(module)) for module in (internals, connections)}
    used = [
        f"{path.relative_to(root)}: {line.strip()}"
        for path in sorted(root.rglob("*.py"))
        if path not in private and "viser" in (text := path.read_text("utf-8"))
        for line in text.splitlines()
        if re.search(r"(?<!\bself)(?<!\bcls)(?<!\bargparse)\._[a-z]|\bviser\._", line)
    ]
    assert not used, f"put these into {INTERNALS} or connections.py, with a test: {used}"


def test_icons_are_those_that_viser_reads(monkeypatch):
    names = [viser.Icon.PLAYER_PLAY, viser.Icon.DOWNLOAD]
    assert [internals.icon_svg(name) for name in names] == list(map(_icons.svg_from_icon, names))
    for module in (_gui_api, _gui_handles):
        monkeypatch.setattr(module, "svg_from_icon", None)
    internals.keep_icons_open()
    why = f"viser draws icons by another function: `keep_icons_open` of {INTERNALS} has no effect"
    for module in (_gui_api, _gui_handles):
        assert "svg_from_icon(icon" in inspect.getsource(module), why
        assert module.svg_from_icon is internals.icon_svg
