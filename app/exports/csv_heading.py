"""First line of a CSV file: what it holds, of which recording, with which parameters."""

import re

from app.output.text import escaped
from estimator import Parameters, to_nested
from recordings import Recording


def described(recording: Recording, parameters: Parameters) -> str:
    """File's name, simulated or measured, and parameters, in one line without commas in names."""
    said = "; ".join(f"{name}={value}" for name, value in to_nested(parameters).items())
    origin = "simulated" if recording.simulated else "measured"
    # A line break would end the comment, and what separates cells would let one begin in the name.
    file = " ".join(re.split(r'[\s,;"]+', escaped(recording.path.name)))
    return f"recording {file}; {origin}; {said}"
