"""Simulated recordings of the paper's three scenarios."""

from recordings.simulation.noise import NOISE_MODELS, NoiseModel
from recordings.simulation.scenario import SCENARIOS, SPEEDS, TRIALS, Scenario
from recordings.simulation.simulate import simulate, write_simulation

__all__ = [
    "NOISE_MODELS",
    "SCENARIOS",
    "SPEEDS",
    "TRIALS",
    "NoiseModel",
    "Scenario",
    "simulate",
    "write_simulation",
]
