"""Recordings: reading, writing and simulating MCAP files, and the shipped samples."""

from recordings.cloud import NO_STATUS, Cloud
from recordings.errors import RecordingError
from recordings.frame import Frame, PointTruth, Provenance
from recordings.object_meshes import ObjectMesh
from recordings.opening import open_recording
from recordings.recording import Recording
from recordings.samples import sample_paths
from recordings.sensors import VALID_STATUS, RecordedSensor
from recordings.truth import PairTruth

__all__ = [
    "NO_STATUS",
    "VALID_STATUS",
    "Cloud",
    "Frame",
    "ObjectMesh",
    "PairTruth",
    "PointTruth",
    "Provenance",
    "RecordedSensor",
    "Recording",
    "RecordingError",
    "open_recording",
    "sample_paths",
]
