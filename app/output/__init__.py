"""Output files: whole or as they were before, and never in place of what Tofscope did not write."""
