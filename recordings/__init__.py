"""Recordings: reading, writing and simulating MCAP files, and the shipped samples."""

from recordings.cloud import Cloud
from recordings.errors import RecordingError
from recordings.frame import Frame, PointTruth, Provenance
from recordings.opening import open_recording
from recordings.recording import Recording
from recordings.samples import sample_paths
from recordings.sensors import RecordedSensor
from recordings.truth import PairTruth

__all__ = [
    "Cloud",
    "Frame",
    "PairTruth",
    "PointTruth",
    "Provenance",
    "RecordedSensor",
    "Recording",
    "RecordingError",
    "open_recording",
    "sample_paths",
]
