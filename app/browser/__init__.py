"""Code that depends on private parts of viser or of the page it serves."""
