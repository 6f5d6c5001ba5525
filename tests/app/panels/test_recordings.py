from dataclasses import replace

from app.panels.recordings import describe
from recordings import Provenance
from tests.app.fake_recordings import fake_opened, fake_recording


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
