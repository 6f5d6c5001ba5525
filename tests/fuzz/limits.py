"""What a hostile recording may cost, see docs/limits.md."""

CPU_SECONDS = 5.0
HANGING_SECONDS = 30.0
"""Seconds of CPU after which a trial is interrupted."""
MEMORY_BYTES = 700_000_000
"""That a trial takes beyond what the process had, some 300 MB for its packages."""
