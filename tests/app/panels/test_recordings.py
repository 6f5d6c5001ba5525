from dataclasses import replace

from app.panels.recordings import RecordingsPanel, describe
from recordings import Provenance
from tests.app.fake_recordings import fake_opened, fake_recording
from tests.app.fake_session import context, snapshot, status


def test_a_measured_recording_is_described_by_its_size():
    assert describe(fake_opened()) == ["1 sensor, 40 frames, 2.6 s", "Fixed frame: world"]


def test_a_simulated_recording_says_so_first():
    fake = fake_recording()
    fake.simulated = True
    fake.provenance = Provenance(True, "towards", 0.25, 3, 7, "paper: ...", "tofscope simulate")
    assert describe(fake_opened(fake))[0] == "Simulated: towards, 0.25 m/s, trial 3"
    fake.simulated = False
    fake.provenance = replace(fake.provenance, simulated=False)
    assert "imulated" not in " ".join(describe(fake_opened(fake)))


def test_what_is_being_opened_is_said_and_what_stays_open_after_a_bad_one(client):
    panel = RecordingsPanel(context(client))
    assert "Opening …" in client.text()
    panel.announce(status(opening="a<b"))
    assert "Opening a&lt;b …" in client.text()
    opened = fake_opened()
    panel.announce(status(opened=opened))
    assert f"Opening {opened.entry.label} …" in client.text()  # until its first frame is drawn
    panel.show(snapshot(opened=opened))
    assert "Opening" not in client.text()
    panel.announce(status(opening="bad", opened=opened))
    assert "Opening bad …" in client.text()
    panel.announce(status(opened=opened))
    assert "1 sensor, 40 frames" in client.text()
    panel.announce(status(opening="bad"))
    panel.announce(status())
    assert "No recording is open." in client.text()


def test_one_frame_is_one_frame():
    single = fake_recording()
    single.stamps = single.stamps[:1]
    assert describe(fake_opened(single))[0] == "1 sensor, 1 frame, 0.0 s"
