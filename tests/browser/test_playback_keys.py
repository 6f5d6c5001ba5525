"""Keys of playback in a real Chromium: who gets them, and what they do."""

from tests.browser.tab import Tab


def press(tab: Tab, key: str) -> None:
    tab.page.keyboard.press(key)


def test_keys_go_through_the_recording_and_leave_the_camera_alone(tab: Tab):
    frame = tab.value("Frame")
    tab.page.locator("canvas[data-engine]").click()
    camera = "Array.from(window.__viserMutable.camera.matrixWorld.elements)"
    tab.page.wait_for_timeout(500)
    before = tab.page.evaluate(camera)
    press(tab, "ArrowRight")
    tab.until(lambda: tab.value("Frame") == frame + 1)
    press(tab, "Shift+ArrowLeft")
    tab.until(lambda: tab.value("Frame") == frame - 9)
    press(tab, "Home")
    tab.until(lambda: tab.value("Frame") == 0)
    press(tab, "m")
    tab.until(lambda: 0 < tab.value("Frame") < frame)
    press(tab, "End")
    tab.until(lambda: tab.is_at(38))
    assert tab.page.evaluate(camera) == before


def test_a_slider_that_has_the_focus_keeps_its_keys(tab: Tab):
    frame = tab.value("Frame")
    slider = tab.row("γ").locator("[role=slider]")
    slider.focus()
    slider.press("Home")
    tab.until(lambda: tab.value("γ") == 0.0)
    slider.press("ArrowRight")
    tab.until(lambda: tab.value("γ") == 0.01)
    slider.press("l")  # arrives after the others
    tab.until(lambda: tab.value("Frame") == frame + 1)
    tab.page.wait_for_timeout(300)
    assert tab.value("Frame") == frame + 1
    assert tab.value("γ") == 0.01


def test_space_pauses_once_where_the_play_button_has_the_focus(tab: Tab):
    tab.open("sideways")
    tab.page.get_by_label("Speed", exact=True).select_option("0.1x")
    tab.page.get_by_role("button", name="Play", exact=True).click()
    pause = tab.page.get_by_role("button", name="Pause", exact=True)
    pause.wait_for()
    pause.press("Space")
    tab.page.get_by_role("button", name="Play", exact=True).wait_for()
    tab.page.wait_for_timeout(500)
    assert pause.count() == 0


def test_the_palette_knows_playback(tab: Tab):
    tab.page.locator("canvas[data-engine]").click()
    press(tab, "Control+k")
    tab.page.get_by_placeholder("Search commands").fill("First frame")
    press(tab, "Enter")
    tab.until(lambda: tab.is_at(0))


def test_a_click_in_the_timeline_goes_there(tab: Tab):
    strip, last = tab.slider("Frame"), tab.last_frame()
    for share in (0.25, 0.9):
        box = strip.bounding_box()
        assert box is not None
        tab.page.mouse.click(box["x"] + share * box["width"], box["y"] + box["height"] / 2)
        tab.until(lambda share=share: abs(tab.value("Frame") - share * last) <= 1)
        tab.until(lambda: tab.is_at(int(tab.value("Frame"))))


def test_keys_play_after_a_recording_was_chosen_and_a_number_was_entered(tab: Tab):
    tab.open("sideways")
    frame = tab.value("Frame")
    press(tab, "l")
    tab.until(lambda: tab.value("Frame") == frame + 1)
    number = tab.row("n").locator("input:not([type=hidden])")
    number.fill("7")
    number.press("Enter")
    tab.page.wait_for_timeout(200)
    press(tab, "l")
    tab.until(lambda: tab.value("Frame") == frame + 2)
    assert tab.value("n") == 7


def test_clicks_that_follow_each_other_at_once_all_count(tab: Tab):
    tab.set_slider("Frame", "Home")
    tab.until(lambda: tab.is_at(0))
    forward = tab.page.get_by_role("button", name="Next frame", exact=True)
    forward.evaluate("button => { for (let i = 0; i < 5; i++) button.click(); }")
    tab.until(lambda: tab.is_at(5))


_LATE = """([uuid, value]) => {
  const {messageQueue, drainMessageQueue} = window.__viserMutable;
  messageQueue.push({type: "GuiUpdateMessage", uuid, updates: {value}});
  drainMessageQueue();
}"""


def test_a_number_that_is_entered_while_another_is_on_its_way_is_shown(tab: Tab):
    press(tab, "End")
    uuid = tab.row("n").locator(".mantine-Slider-root").get_attribute("id")
    number = tab.row("n").locator("input:not([type=hidden])")
    number.fill("12")
    tab.page.evaluate(_LATE, [uuid, 1])  # what the server had sent before it knew
    tab.until(lambda: tab.has_text("0.800 s"))
    tab.until(lambda: tab.value("n") == 12 and number.input_value() == "12")


def test_what_is_being_typed_stays_when_a_value_arrives_and_is_followed_once_it_is_left(tab: Tab):
    press(tab, "End")
    uuid = tab.row("n").locator(".mantine-Slider-root").get_attribute("id")
    number = tab.row("n").locator("input:not([type=hidden])")
    number.click()
    press(tab, "Control+a")
    tab.page.evaluate(_LATE, [uuid, 3])  # while the text is selected
    press(tab, "1")
    tab.page.evaluate(_LATE, [uuid, 4])  # between two digits
    press(tab, "2")
    tab.until(lambda: tab.has_text("0.800 s"))
    assert number.input_value() == "12"
    tab.page.wait_for_timeout(500)  # until the page has been sent its own number again
    tab.page.evaluate(_LATE, [uuid, 7])
    assert number.input_value() == "12"
    number.blur()
    tab.until(lambda: number.input_value() == "7" and tab.value("n") == 7)


def test_the_time_stands_still_while_it_is_in_use_and_follows_again_once_it_is_left(tab: Tab):
    press(tab, "Home")
    tab.until(lambda: tab.is_at(0))
    loop = tab.page.get_by_role("button", name="Loop", exact=True)
    assert loop.get_attribute("aria-pressed") == "true"  # the recording is short
    loop.click()
    tab.until(lambda: loop.get_attribute("aria-pressed") == "false")
    press(tab, "Space")
    time = tab.page.get_by_label("Go to time")
    time.focus()
    held = time.input_value()
    tab.until(lambda: tab.is_at(38))
    assert time.input_value() == held != "2.533"
    time.blur()
    tab.until(lambda: time.input_value() == "2.533")
    tab.page.get_by_role("button", name="Play", exact=True).wait_for()


_PLACES = """elements => {
  window.places = [];
  const look = () => {
    const tops = elements.map(each => Math.round(each.getBoundingClientRect().top)).join();
    if (window.places.at(-1) !== tops) window.places.push(tops);
    requestAnimationFrame(look);
  };
  look();
}"""


def test_while_a_recording_opens_the_controls_stay_in_their_places(tab: Tab):
    tab.page.wait_for_timeout(500)
    controls = tab.page.locator("[role=tab], [role=slider], .mantine-Slider-root")
    controls.evaluate_all(_PLACES)
    tab.open("sideways")
    assert len(tab.page.evaluate("window.places")) == 1
