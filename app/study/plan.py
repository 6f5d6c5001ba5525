"""Plan of a study: its recordings, and the parameters to evaluate each with."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path

from app.analysis.evaluation import EvaluationCase
from app.study.work import SWEPT_SCENARIO, Recorded, Simulated, Source, Work
from estimator import Parameters
from recordings.simulation import (
    IMPERFECTIONS,
    NOISE_MODELS,
    PAPER_SCENARIOS,
    SCENARIOS,
    TRIALS,
)

SWEEP = tuple(range(1, 11))
"""Values of n in the sweep."""
METHODS = ("paper", "baseline")
"""Methods that the paper compares."""
ABLATION_SPEED = 0.20
"""Speed of the ablation, m/s; if the plan lacks it, the ablation has the plan's first speed."""
_ABLATION_TRIALS = 3


@dataclass(frozen=True)
class Plan:
    """Recordings, methods and parameters of a study.

    Attributes:
        parameters: of every method; their field `method` is ignored.
        methods: names, in the order of the tables.
        scenarios: names of the simulated ones.
        speeds: m/s, None for each scenario's own; ignored by scenarios in which nothing moves.
        trials: numbers, from 1.
        sweep: values of n for the sweep, empty for none.
        seed: of the simulator.
        noise: name of the simulator's noise model.
        imperfections: names, in the registry's order.
        ablation: whether noise models and imperfections are compared.
        recordings: to evaluate in place of simulated ones, None to simulate.
        rig: file of the simulated rig, None for the paper's.
        method_files: FILE.py:NAME of the methods that come from files.
    """

    parameters: Parameters
    methods: tuple[str, ...] = METHODS
    scenarios: tuple[str, ...] = PAPER_SCENARIOS
    speeds: tuple[float, ...] | None = None
    trials: tuple[int, ...] = TRIALS
    sweep: tuple[int, ...] = SWEEP
    seed: int = 0
    noise: str = "paper"
    imperfections: tuple[str, ...] = ()
    ablation: bool = False
    recordings: tuple[Recorded, ...] | None = None
    rig: Path | None = None
    method_files: tuple[str, ...] = ()

    def works(self) -> list[Work]:
        """All units of work, one per recording, in a fixed order."""
        cases = tuple(
            EvaluationCase(parameters) for parameters in self._parameters([self.parameters.n])
        )
        sweep = self._parameters(self.sweep)
        files = self.method_files
        works = {source: Work(source, cases, sweep, files) for source in self.sources()}
        for source in self.ablation_sources():
            works.setdefault(source, Work(source, cases, method_files=files))
        return list(works.values())

    def sources(self) -> list[Source]:
        """Recordings of the tables and the sweep."""
        if self.recordings is not None:
            return list(self.recordings)
        return [
            Simulated(name, speed, trial, self.seed, self.noise, self.imperfections, self.rig)
            for name in self.scenarios
            for speed, trial in product(self._speeds(name), self.trials)
        ]

    def ablation_sources(self) -> list[Source]:
        """Recordings of the ablation, grouped by condition."""
        speeds = self._speeds(SWEPT_SCENARIO)
        speed = ABLATION_SPEED if ABLATION_SPEED in speeds else speeds[0]
        return [
            Simulated(SWEPT_SCENARIO, speed, trial, self.seed, noise, imperfections, self.rig)
            for noise, imperfections in self.conditions()
            for trial in self.trials[:_ABLATION_TRIALS]
        ]

    def conditions(self) -> list[tuple[str, tuple[str, ...]]]:
        """Conditions of the ablation: noise models, then imperfections with the plan's noise."""
        if not self.ablation:
            return []
        return [
            *((noise, ()) for noise in NOISE_MODELS),
            *((self.noise, (name,)) for name in IMPERFECTIONS),
        ]

    def _speeds(self, name: str) -> tuple[float, ...]:
        scenario = SCENARIOS[name]
        return scenario.speeds if scenario.still or not self.speeds else self.speeds

    def _parameters(self, values: Iterable[int]) -> tuple[Parameters, ...]:
        return tuple(
            replace(self.parameters, method=method, n=n)
            for method, n in product(self.methods, values)
        )
