"""Everything that depends on private parts of viser, or of the page that it serves."""
