"""Exports: pictures, CSV files, and a page that plays offline."""
