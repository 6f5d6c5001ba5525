"""What a hostile recording may cost, see docs/limits.md."""

CPU_SECONDS = 5.0
MEMORY_BYTES = 1_000_000_000
