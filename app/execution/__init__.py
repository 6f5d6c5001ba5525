"""One function applied to many things: on the cores of this machine, or on a Dask cluster."""
