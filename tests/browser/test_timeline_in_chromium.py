"""The timeline in a real Chromium: scrubbing, zoom, range, typed times, marks."""

from pathlib import Path

import numpy as np

from app.browser.assets import packed
from tests.browser.tab import Tab

_HEIGHT = 40  # px below the top of the tracks, where nothing but the playhead is taken
RANGE = 16  # where the handles of the range are
_FLAG = 3  # where the flags of marks are


def place(tab: Tab, share: float, height: float = _HEIGHT) -> tuple[float, float]:
    """Pixel of the page at a share of the tracks' width, so far below their top."""
    box = tab.slider("Frame").bounding_box()
    assert box is not None
    return box["x"] + share * box["width"], box["y"] + height


def drag(tab: Tab, start: float, end: float, height: float = _HEIGHT) -> None:
    """Press at a share of the width, and move to another without letting go."""
    tab.page.mouse.move(*place(tab, start, height))
    tab.page.mouse.down()
    tab.page.mouse.move(*place(tab, end, height), steps=5)


def tip(tab: Tab, share: float, height: float = _HEIGHT) -> str:
    """What is said where the mouse points."""
    for apart in (0.002, 0.0):
        tab.page.mouse.move(*place(tab, share + apart, height))
    return tab.slider("Frame").get_attribute("title") or ""


def at_share(tab: Tab, share: float) -> bool:
    frame = tab.drawn_frame()
    return tab.is_at(frame) and abs(frame - share * tab.last_frame()) <= 1


def test_a_drag_scrubs_before_it_is_let_go_and_what_comes_late_moves_nothing(tab: Tab):
    target = tab.points("target")
    drag(tab, 0.2, 0.8)
    tab.until(lambda: at_share(tab, 0.8))
    tab.until(lambda: not np.array_equal(tab.points("target"), target))
    tab.page.evaluate("window.tofscope.timeline.frame(0)")
    tab.page.mouse.move(*place(tab, 0.4), steps=3)
    tab.until(lambda: at_share(tab, 0.4))
    tab.page.mouse.move(*place(tab, 1.01))  # beyond the end of the tracks
    tab.until(lambda: tab.is_at(tab.last_frame()))
    tab.page.mouse.up()
    tab.page.mouse.move(*place(tab, 0.1))
    tab.page.wait_for_timeout(300)
    assert tab.is_at(tab.last_frame())


def test_the_wheel_zooms_where_it_points_and_a_double_click_shows_all_again(tab: Tab):
    last = tab.last_frame()
    tab.set_slider("Frame", "Home")
    tab.until(lambda: tab.is_at(0))
    tab.page.mouse.move(*place(tab, 0.5))
    tab.page.mouse.wheel(0, -5000)
    tab.page.mouse.click(*place(tab, 0.98))
    tab.until(lambda: tab.is_at(tab.drawn_frame()) and 0.5 < tab.drawn_frame() / last < 0.75)
    near = tab.drawn_frame()
    tab.page.mouse.wheel(300, 0)  # sideways
    tab.page.mouse.click(*place(tab, 0.98))
    tab.until(lambda: tab.is_at(tab.drawn_frame()) and tab.drawn_frame() > near)
    tab.page.mouse.dblclick(*place(tab, 0.5))
    tab.page.mouse.click(*place(tab, 0.98))
    tab.until(lambda: at_share(tab, 0.98))
    tab.page.mouse.wheel(0, -5000)
    tab.page.get_by_role("button", name="Whole recording").click()
    tab.page.mouse.click(*place(tab, 0.1))
    tab.until(lambda: at_share(tab, 0.1))


_NOTE_FRAMES = """() => {
  window.frames_seen = [];
  const {timeline} = window.tofscope, {frame} = timeline;
  timeline.frame = k => { window.frames_seen.push(k); frame(k); };
}"""


def test_handles_set_the_range_that_is_played_again_and_again(tab: Tab):
    said = tab.page.locator("#tofscope-timeline .range")
    before = tab.drawn_frame()
    drag(tab, 0.0, 0.3, RANGE)
    tab.page.mouse.up()
    tab.until(lambda: said.inner_text().startswith("plays frames"))
    drag(tab, 0.998, 0.5, RANGE)
    tab.page.mouse.up()
    tab.page.wait_for_timeout(500)  # what the session knows of it has come back
    first, last = (int(word) for word in said.inner_text().split() if word.isdigit())
    assert abs(first - 0.3 * tab.last_frame()) <= 1
    assert abs(last - 0.5 * tab.last_frame()) <= 1
    assert tab.drawn_frame() == before
    tab.page.mouse.click(*place(tab, 0.4))
    tab.until(lambda: at_share(tab, 0.4))
    tab.page.evaluate(_NOTE_FRAMES)
    tab.page.get_by_role("button", name="Play", exact=True).click()
    # Back from the end to the beginning, since a short recording loops.
    tab.until(lambda: (np.diff(tab.page.evaluate("frames_seen")) < 0).sum() > 1)
    seen = tab.page.evaluate("frames_seen")
    assert first <= min(seen) <= max(seen) <= last
    tab.page.get_by_role("button", name="Pause", exact=True).click()
    drag(tab, first / tab.last_frame(), 0.0, RANGE)
    tab.page.mouse.up()
    tab.page.wait_for_timeout(500)
    drag(tab, last / tab.last_frame(), 1.0, RANGE)
    tab.page.mouse.up()
    tab.until(lambda: said.inner_text() == "")


def test_a_time_is_typed_and_what_is_none_changes_nothing(tab: Tab):
    time = tab.page.get_by_label("Go to time")
    for typed, frame in (("1", 15), ("0,52", 8), ("99", tab.last_frame()), ("-3", 0), ("1e0", 15)):
        time.fill(typed)
        time.press("Enter")
        tab.until(lambda frame=frame: tab.is_at(frame))
        tab.until(lambda frame=frame: float(time.input_value()) == round(frame / 15, 3))
    for typed in ("abc", "", "1:2"):
        time.fill(typed)
        time.press("Enter")
        tab.until(lambda: time.input_value() == "1.000")
        assert tab.is_at(15)
    time.fill("2")
    time.press("Escape")
    tab.until(lambda: time.input_value() == "1.000")
    assert tab.is_at(15)


def test_a_quantity_is_chosen_and_survives_a_new_session(tab: Tab):
    quantity = tab.page.get_by_label("Plotted quantity")
    tab.until(lambda: quantity.input_value() == "moving")
    quantity.select_option("speed")
    share = tab.drawn_frame() / tab.last_frame()
    tab.until(lambda: "speed: 0." in tip(tab, share))
    assert "valid zones: " in tip(tab, share)
    tab.open("sideways")
    tab.until(lambda: quantity.input_value() == "speed")


def test_a_mark_with_a_note_is_a_file_beside_the_recording_and_survives_a_reload(
    tab: Tab, recordings_folder: Path
):
    def kept() -> str:
        return "".join(file.read_text() for file in recordings_folder.glob("*.marks.json"))

    try:
        tab.page.mouse.click(*place(tab, 0.25))
        tab.until(lambda: at_share(tab, 0.25))
        frame = tab.drawn_frame()
        tab.page.keyboard.press("k")
        note = tab.page.get_by_label("Note", exact=True)
        tab.page.keyboard.type("jumps <l> km")  # at once, letters that are keys of playback, too
        note.press("Enter")
        tab.until(lambda: '"jumps <l> km"' in kept())
        assert tab.is_at(frame)
        assert tab.page.get_by_role("dialog", name="Mark", exact=True).count() == 0

        tab.page.reload()
        tab.until(lambda: tab.is_at(frame))
        tab.set_slider("Frame", "End")
        tab.until(lambda: tab.is_at(tab.last_frame()))
        share = frame / tab.last_frame()
        tab.until(lambda: tip(tab, share, _FLAG) == "jumps <l> km")
        tab.page.mouse.click(*place(tab, share, _FLAG))
        tab.until(lambda: tab.is_at(frame))
        assert note.input_value() == "jumps <l> km"
        note.press("Escape")
        assert tab.page.get_by_role("dialog", name="Mark", exact=True).count() == 0

        tab.page.get_by_role("button", name="Mark this frame").click()
        tab.page.get_by_role("button", name="Remove", exact=True).click()
        tab.until(lambda: '"jumps <l> km"' not in kept())
        tab.page.get_by_role("button", name="Mark this frame").click()
        tab.page.get_by_text("New mark at frame").wait_for()
        tab.page.get_by_role("button", name="Cancel", exact=True).click()
    finally:
        for file in recordings_folder.glob("*.marks.json"):
            file.unlink()


def advanced(tab: Tab, speed: str) -> int:
    """How many frames playback at a speed goes on within a second, from the first."""
    tab.set_slider("Frame", "Home")
    tab.until(lambda: tab.is_at(0))
    tab.page.get_by_label("Speed", exact=True).select_option(speed)
    tab.page.get_by_role("button", name="Play", exact=True).click()
    tab.until(lambda: tab.drawn_frame() > 0)
    start = tab.drawn_frame()
    tab.page.wait_for_timeout(1000)
    frames = tab.drawn_frame() - start
    tab.set_slider("Frame", "End")  # where it ends, if it has not yet
    tab.page.get_by_role("button", name="Play", exact=True).wait_for()
    return frames


def test_playback_is_as_fast_as_is_chosen(tab: Tab):
    tab.page.get_by_role("button", name="Loop", exact=True).click()  # which ends at the last frame
    slow, fast = advanced(tab, "0.25x"), advanced(tab, "2x")
    assert slow > 0
    assert fast > 2 * slow  # eight times as many, on a machine that has nothing else to do


def test_what_moves_and_what_is_not_read_yet_is_told_of_each_frame(tab: Tab):
    frames = tab.last_frame() + 1
    moving, none = np.zeros((2, frames), dtype=bool)
    moving[: frames // 2] = True
    bits = {"moving": moving, "empty": none, "gaps": none}
    sent = {name: packed(np.packbits(flags), "u1") for name, flags in bits.items()}
    tab.page.evaluate("window.tofscope.timeline.events", sent | {"unread": frames // 4})
    assert "something moves" in tip(tab, 0.2)
    assert "something moves" not in tip(tab, 0.6)
    assert "not read yet" not in tip(tab, 0.6)
    assert "its truth is not read yet" in tip(tab, 0.9)


def test_columns_are_covered_by_shares(tab: Tab):
    covered = "spans => Array.from(window.tofscope.covered(spans, 4))"
    assert tab.page.evaluate(covered, []) == [0, 0, 0, 0]
    spans = [[-1, 0.25], [0.5, 2], [2, 2.25], [3.5, 9]]
    assert tab.page.evaluate(covered, spans) == [0.75, 1, 0.25, 0.5]
    assert tab.page.evaluate(covered, [[0, 4], [1, 2]]) == [1, 1, 1, 1]
