"""What a study runs: which recordings, and each with which parameters."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import product

from app.study.work import Recorded, Simulated, Source, Work
from estimator import Parameters
from recordings.simulation import SPEEDS, TRIALS

PAPER_SCENARIOS = ("towards", "sideways", "robot_moving")
SWEEP = tuple(range(1, 11))
"""The values of n that are tried."""


@dataclass(frozen=True)
class Plan:
    """What is asked of a study.

    Attributes:
        parameters: of every method; their own method is not used.
        methods: names, in the order of the tables.
        scenarios: names of those that are simulated.
        speeds: m/s.
        trials: numbers, from 1.
        sweep: values of n for the sweep, empty for none.
        seed: of the simulator.
        noise: name of the simulator's noise model.
        imperfections: names, in the registry's order.
        recordings: that are taken instead of simulated ones, None to simulate.
    """

    parameters: Parameters
    methods: tuple[str, ...] = ("paper", "baseline")
    scenarios: tuple[str, ...] = PAPER_SCENARIOS
    speeds: tuple[float, ...] = SPEEDS
    trials: tuple[int, ...] = TRIALS
    sweep: tuple[int, ...] = SWEEP
    seed: int = 0
    noise: str = "paper"
    imperfections: tuple[str, ...] = ()
    recordings: tuple[Recorded, ...] | None = None

    def works(self) -> list[Work]:
        """Every unit of work, in a fixed order."""
        parameters = self._parameters([self.parameters.n])
        sweep = self._parameters(self.sweep)
        return [Work(source, parameters, sweep) for source in self._sources()]

    def _sources(self) -> list[Source]:
        if self.recordings is not None:
            return list(self.recordings)
        return [
            Simulated(scenario, speed, trial, self.seed, self.noise, self.imperfections)
            for scenario, speed, trial in product(self.scenarios, self.speeds, self.trials)
        ]

    def _parameters(self, values: Iterable[int]) -> tuple[Parameters, ...]:
        return tuple(
            replace(self.parameters, method=method, n=n)
            for method, n in product(self.methods, values)
        )
