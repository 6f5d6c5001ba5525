"""Store of finished results in a folder, from which a stopped study resumes."""

import hashlib
import json
import os
import sys
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from app.analysis.evaluation import EvaluationCase
from app.analysis.json_text import LARGEST, from_json
from app.errors import InputError, UserError
from app.output.writing import write
from app.study.work import Outcome, Recorded, Result, Source, Work
from estimator import from_nested, to_nested
from robot_assets.input_files import open_file

_LONGEST_NAME = 80
"""Maximum bytes of a recording's name in its file name, of the 255 that file systems take."""


class Store:
    """One JSON file per recording, named by a digest of everything that determines its results.

    These are scenario, speed, trial, seed, noise model, imperfections and rig, or the file's
    content and how it is opened; and the software. Parameters are stored with each result.

    Args:
        folder: created if missing.
        software: a `software_digest`.

    Raises:
        InputError: the folder cannot be created.
    """

    def __init__(self, folder: Path, software: str) -> None:
        self._folder = folder
        self._software = software
        self._unwritten: dict[Source, Outcome] = {}
        self._contents: dict[tuple[Path, int, int], str] = {}
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise InputError(f"The folder {folder} cannot be made: {error.strerror}.") from error

    def finished(self, work: Work) -> Outcome | None:
        """Stored results of a unit of work, None without any."""
        found = self._load(work.source)
        if found is None:
            return None
        known = {result.case: result for result in found.results}
        wanted = work.wanted(found.scenario)
        return replace(found, results=tuple(known[case] for case in wanted if case in known))

    def missing(self, work: Work) -> Work | None:
        """The part of a unit of work that is not stored yet, None if all is."""
        found = self.finished(work)
        if found is None:
            return work
        known = {result.case for result in found.results}
        left = tuple(case for case in work.wanted(found.scenario) if case not in known)
        return Work(work.source, left, method_files=work.method_files) if left else None

    def keep(self, outcome: Outcome) -> None:
        """Store the outcome of a unit of work; failures are not stored, so that they are retried.

        Outcomes that cannot be written are kept in memory.

        Raises:
            InputError: the file cannot be written.
        """
        if outcome.failure:
            return
        before = self._load(outcome.source)
        known = {r.case: r for r in (before.results if before else ())}
        known |= {r.case: r for r in outcome.results}
        whole = replace(outcome, results=tuple(known.values()))
        path = self._path(outcome.source)
        content = asdict(whole)
        content["source"] = _as_json(outcome.source)
        for written, result in zip(content["results"], whole.results, strict=True):
            written["case"]["parameters"] = to_nested(result.case.parameters)
        try:
            write(path, f"{json.dumps(content, indent=1)}\n".encode())
        except InputError:
            self._unwritten[outcome.source] = whole
            raise

    def _load(self, source: Source) -> Outcome | None:
        if source in self._unwritten:
            return self._unwritten[source]
        try:
            path = self._path(source)
            with open_file(path) as file:
                content = from_json(file.read(LARGEST + 1).decode("utf-8"), str(path))
            results = tuple(
                Result(
                    EvaluationCase(from_nested(r["case"]["parameters"]), r["case"]["resting"]),
                    r["metrics"],
                    r["seconds"],
                    r["diagnosis"],
                )
                for r in content["results"]
            )
            kept = {k: content[k] for k in ("scenario", "speed", "trial", "noise", "frames")}
            return Outcome(
                source,
                **kept,
                seconds=content["seconds"],
                results=results,
                warnings=tuple(content["warnings"]),
            )
        except (OSError, ValueError, KeyError, TypeError, *UserError):
            # A missing or invalid file: the results are computed again.
            return None

    def digest(self, source: Source) -> str:
        """SHA-256 of everything that determines a recording's results."""
        identity = _as_json(source) | {"software": self._software}
        files = ("path", "rig", "urdf") if isinstance(source, Recorded) else ("rig",)
        for key in files:
            identity[key] = self._content(getattr(source, key))
        return hashlib.sha256(json.dumps(identity, sort_keys=True).encode()).hexdigest()

    def _path(self, source: Source) -> Path:
        # The digest identifies the recording; its name, possibly cut, helps readers.
        encoding = sys.getfilesystemencoding()
        name = os.fsencode(source.name)[:_LONGEST_NAME].decode(encoding, errors="ignore")
        return self._folder / f"{name}-{self.digest(source)[:16]}.json"

    def _content(self, path: Path | None) -> str | None:
        """SHA-256 of a file, None if it cannot be read, which is reported when it is opened.

        Cached, since recordings can be large.
        """
        if path is None:
            return None
        try:
            found = path.stat()
            key = path, found.st_mtime_ns, found.st_size
            if key not in self._contents:
                with open_file(path) as file:
                    self._contents[key] = hashlib.file_digest(file, "sha256").hexdigest()
            return self._contents[key]
        except OSError:
            return None


def _as_json(source: Source) -> dict[str, Any]:
    return {k: str(v) if isinstance(v, Path) else v for k, v in asdict(source).items()}
