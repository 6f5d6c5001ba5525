"""A function applied to many things by the workers of a Dask cluster."""

from collections.abc import Callable, Generator, Sequence
from typing import Any

from app.analysis.method_files import load_method
from app.errors import InputError
from app.execution.lost import Lost

_PATIENCE = 10  # seconds, timeout of the connection to a scheduler


def on_cluster(
    function: Callable[[Any], Any], items: Sequence[Any], address: str, method_files: Sequence[str]
) -> Generator[tuple[int, Any], None, None]:
    """Yield (index, result, or Lost where its worker failed) in order of completion.

    Args:
        function: of one item.
        items: any number.
        address: of the scheduler, such as tcp://host:8786.
        method_files: FILE.py:NAME of methods that the workers load.

    Raises:
        InputError: the scheduler cannot be reached, or Dask is not installed.
    """
    try:
        from distributed import Client, as_completed
    except ImportError as error:
        raise InputError(
            "--dask needs the package distributed: install it with pip install 'tofscope[dask]'."
        ) from error
    try:
        client = Client(address, timeout=_PATIENCE)
    except (OSError, ValueError) as error:
        raise InputError(f"There is no Dask scheduler at {address}.") from error
    with client:
        if method_files:
            client.register_plugin(_method_loader(method_files))
        futures = client.map(function, items, pure=False)
        index_of = {future: index for index, future in enumerate(futures)}
        try:
            for future in as_completed(futures):
                error = future.exception()
                lost = Lost(f"the worker failed: {error}")
                yield index_of[future], future.result() if error is None else lost
        finally:
            client.cancel(futures)


def _method_loader(method_files: Sequence[str]) -> Any:  # noqa: ANN401 (of an optional package)
    """Dask plugin that loads methods in every worker, including those that join later."""
    from distributed import WorkerPlugin

    class MethodLoader(WorkerPlugin):
        name = "tofscope-methods"

        def setup(self, worker: object) -> None:
            del worker
            for text in method_files:
                load_method(text)

    return MethodLoader()
