"""What a hostile recording may cost, see docs/limits.md."""

CPU_SECONDS = 5.0
HANGING_SECONDS = 30.0
"""Seconds of CPU after which a trial is interrupted."""
MEMORY_BYTES = 1_000_000_000
