"""Compiled HDBSCAN and ICP with the results of scikit-learn and Open3D."""
