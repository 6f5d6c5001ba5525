"""Simulator of recordings: the paper's three scenarios and more."""

from recordings.simulation.imperfections import IMPERFECTIONS, Imperfection
from recordings.simulation.noise import NOISE_MODELS, NoiseModel
from recordings.simulation.repeating import Repetition, write_repeated
from recordings.simulation.scenario import PAPER_SCENARIOS, SCENARIOS, SPEEDS, TRIALS, Scenario
from recordings.simulation.simulate import simulate, write_simulation

__all__ = [
    "IMPERFECTIONS",
    "NOISE_MODELS",
    "PAPER_SCENARIOS",
    "SCENARIOS",
    "SPEEDS",
    "TRIALS",
    "Imperfection",
    "NoiseModel",
    "Repetition",
    "Scenario",
    "simulate",
    "write_repeated",
    "write_simulation",
]
