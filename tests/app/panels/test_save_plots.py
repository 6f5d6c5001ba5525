"""Plots saved as files, of the sides that there are."""

from types import SimpleNamespace
from typing import Any

import pytest

from app.analysis.comparison import A, Comparison
from app.analysis.estimates import Estimates
from app.errors import InputError
from app.panels.save_plots import SavePlots
from app.scene.settings import ViewSettings
from app.session.tasks import Tasks
from estimator import Parameters
from tests.app.analysis.test_survey import filled
from tests.app.fake_recordings import FRAMES, fake_opened
from tests.app.panels.test_plots import Bench
from tests.app.waiting import until


class Library:
    def __init__(self, held):
        self.held, self.opened = held, 0

    def open(self, entry):
        self.opened += 1
        return self.held

    def release(self, entry):
        self.opened -= 1


def bench_of(comparison=None, **surveys) -> Any:
    opened, events = fake_opened(), []
    known = {"edited": None, "other": None} | surveys
    return SimpleNamespace(
        opened=opened,
        surveys=SimpleNamespace(**{n: SimpleNamespace(survey=s) for n, s in known.items()}),
        tuning=SimpleNamespace(comparison=comparison),
        outbox=[],
        tasks=Tasks(events.append),
        events=events,
        library=Library(opened),
        estimates=Estimates(),
        plotted_pair=None,
        settings=ViewSettings(),
    )


@pytest.fixture(scope="module")
def survey():
    return filled(fake_opened(), Parameters())


def test_the_numbers_are_those_of_what_is_plotted(survey):
    workbench = bench_of(edited=survey)
    SavePlots("csv").apply(workbench)
    (file,) = workbench.outbox
    assert file.name == "fake_plots.csv"
    assert len(file.content.decode().splitlines()) == FRAMES + 2
    both = bench_of(Comparison(Parameters(), edited=A), edited=survey, other=survey)
    SavePlots("csv").apply(both)
    assert len(both.outbox[0].content.decode().splitlines()) == FRAMES + 3


@pytest.mark.parametrize(("form", "begin"), [("png", b"\x89PNG"), ("pdf", b"%PDF")])
def test_a_picture_is_drawn_in_the_background_while_the_recording_stays_open(survey, form, begin):
    workbench = bench_of(edited=survey)
    SavePlots(form).apply(workbench)
    with pytest.raises(InputError, match="already"):
        SavePlots(form).apply(workbench)
    until(lambda: workbench.events, timeout=60)
    ((file, notice),) = [event.messages for event in workbench.events]
    assert notice.sentence.startswith(f"fake_plots.{form}, ")
    assert file.name == f"fake_plots.{form}"
    assert file.content.startswith(begin)
    assert workbench.library.opened == 0


def test_before_anything_is_computed_it_says_so():
    with pytest.raises(InputError, match="Nothing of the whole recording is computed yet"):
        SavePlots("csv").apply(bench_of())


def test_there_is_a_button_and_a_command_for_each(client):
    bench = Bench(client)
    client.change("Save as", "SVG")
    until(lambda: bench.posted == [SavePlots("svg")])
    client.trigger("Save plots as PDF")
    until(lambda: bench.posted[-1] == SavePlots("pdf"))
    client.change("Save as", "EXE")
    until(lambda: len(bench.posted) == 3)
