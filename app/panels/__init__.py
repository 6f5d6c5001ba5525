"""Panels of the page, one class and one file each."""
