"""Use of the compiled engine as soon as its code is there, of the reference until then."""

import logging
import subprocess
import sys
import threading
from collections.abc import Callable

from estimator.engines import COMPILED, REFERENCE, Engine, use_engine

COMPILING = (
    "The fast estimator is being compiled, once, in about half a minute; until then scikit-learn "
    "and Open3D do its work."
)
COMPILED_NOW = "The fast estimator is compiled; it does the work from now on."
NOT_COMPILED = (
    "The fast estimator could not be compiled; scikit-learn and Open3D go on doing its work. The "
    "log says why."
)
_LOG = logging.getLogger(__name__)


class EngineSwitch:
    """Compiles the engine once, in a process of its own, while the reference estimates.

    Attributes:
        compiling: whether it is being compiled.
    """

    def __init__(self) -> None:
        self.compiling = False
        self._lock = threading.Lock()
        self._listeners: list[Callable[[str], None]] = []
        self._process: subprocess.Popen[bytes] | None = None
        self._closed = False

    def begin(self, engine: Engine) -> None:
        """Use an engine; the compiled one is loaded in the background, compiled where that is due.

        Args:
            engine: to use from now on, or as soon as it is there.
        """
        use_engine(REFERENCE)
        if engine is not COMPILED:
            return
        threading.Thread(target=self._run, name="engine", daemon=True).start()

    def subscribe(self, listener: Callable[[str], None]) -> Callable[[], None]:
        """Have a function called, from any thread, when `compiling` or the engine changes.

        Args:
            listener: takes what people are told of it, "" for nothing.

        Returns:
            Function that ends it.
        """
        with self._lock:
            self._listeners.append(listener)

        def leave() -> None:
            with self._lock:
                self._listeners.remove(listener)

        return leave

    def close(self) -> None:
        """End a compilation that is running."""
        with self._lock:
            self._closed = True
            process = self._process
        if process is not None:
            process.terminate()
            process.wait()

    def _run(self) -> None:
        said = COMPILED_NOW
        try:
            self._load()
        except Exception:
            _LOG.exception("The engine could not be compiled; the reference goes on.")
            said = NOT_COMPILED
        compiled_now, self.compiling = self.compiling, False
        if not self._closed:
            self._tell(said if compiled_now or said is NOT_COMPILED else "")

    def _tell(self, said: str) -> None:
        with self._lock:
            listeners = list(self._listeners)
        for listener in listeners:
            listener(said)

    def _compile(self) -> None:
        with self._lock:
            if self._closed:
                return
            command = [sys.executable, "-m", "estimator.engine.readiness"]
            # Ctrl-C at the terminal is for this process, which then ends that one.
            self._process = subprocess.Popen(command, start_new_session=True)
        code = self._process.wait()
        if code != 0 and not self._closed:
            raise RuntimeError(f"The process that compiles it has ended with {code}.")

    def _load(self) -> None:
        from estimator.engine.compiled import cache_folder
        from estimator.engine.readiness import compile_all, is_compiled

        if not is_compiled():
            self.compiling = True
            self._tell(COMPILING)
            # Without a folder to keep it in, the code must be compiled in this process.
            if cache_folder() is not None:
                self._compile()
        if self._closed:
            return
        compile_all()
        use_engine(COMPILED)
