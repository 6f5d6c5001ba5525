"""What a study runs: which recordings, and each with which parameters."""

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
"""The values of n that are tried."""
METHODS = ("paper", "baseline")
"""The methods that the paper compares."""
ABLATION_SPEED = 0.20
"""m/s; the ablation runs at this speed alone, or at the first of those that are asked for."""
_ABLATION_TRIALS = 3


@dataclass(frozen=True)
class Plan:
    """What is asked of a study.

    Attributes:
        parameters: of every method; their own method is not used.
        methods: names, in the order of the tables.
        scenarios: names of those that are simulated.
        speeds: m/s, None for those of each scenario; where nothing moves it is 0 all the same.
        trials: numbers, from 1.
        sweep: values of n for the sweep, empty for none.
        seed: of the simulator.
        noise: name of the simulator's noise model.
        imperfections: names, in the registry's order.
        ablation: whether noise models and imperfections are compared.
        recordings: that are taken instead of simulated ones, None to simulate.
        rig: file of the rig to simulate with, None for the paper's.
        method_files: FILE.py:NAME of methods that are not registered by themselves.
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
        """Every unit of work, a recording once, in a fixed order."""
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
        """The recordings of tables and sweep."""
        if self.recordings is not None:
            return list(self.recordings)
        return [
            Simulated(name, speed, trial, self.seed, self.noise, self.imperfections, self.rig)
            for name in self.scenarios
            for speed, trial in product(self._speeds(name), self.trials)
        ]

    def ablation_sources(self) -> list[Source]:
        """The recordings of the ablation, those of a condition beside each other."""
        speeds = self._speeds(SWEPT_SCENARIO)
        speed = ABLATION_SPEED if ABLATION_SPEED in speeds else speeds[0]
        return [
            Simulated(SWEPT_SCENARIO, speed, trial, self.seed, noise, imperfections, self.rig)
            for noise, imperfections in self.conditions()
            for trial in self.trials[:_ABLATION_TRIALS]
        ]

    def conditions(self) -> list[tuple[str, tuple[str, ...]]]:
        """Noise models alone, then each imperfection alone with the noise of the study."""
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
