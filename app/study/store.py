"""Finished results in a folder, so that a study goes on where it stopped."""

import hashlib
import json
import os
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from app.errors import InputError
from app.study.work import Ask, Outcome, Recorded, Result, Source, Work
from estimator import Parameters


class Store:
    """One JSON file per recording, named by all that decides its results.

    That is: scenario, speed, trial, seed, noise model and imperfections, or the content of the
    file and how it is opened; and the software. Parameters and method are kept with each result.

    Args:
        folder: made where it is missing.
        software: see `app.study.software`.

    Raises:
        InputError: the folder cannot be made.
    """

    def __init__(self, folder: Path, software: str) -> None:
        self._folder = folder
        self._software = software
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise InputError(f"The folder {folder} cannot be made: {error.strerror}.") from error

    def finished(self, work: Work) -> Outcome | None:
        """What is known of a unit of work already, of what it wants; None where nothing is."""
        found = self._load(work.source)
        if found is None:
            return None
        known = {result.ask: result for result in found.results}
        wanted = work.wanted(found.scenario)
        return replace(found, results=tuple(known[ask] for ask in wanted if ask in known))

    def missing(self, work: Work) -> Work | None:
        """What remains to be done of a unit of work, None where all is known."""
        found = self.finished(work)
        if found is None:
            return work
        known = {result.ask for result in found.results}
        left = tuple(ask for ask in work.wanted(found.scenario) if ask not in known)
        return Work(work.source, left) if left else None

    def keep(self, outcome: Outcome) -> None:
        """Add what came of a unit of work; failures are not kept, so that they are tried again.

        Raises:
            InputError: the file cannot be written.
        """
        if outcome.failure:
            return
        before = self._load(outcome.source)
        known = {r.ask: r for r in (before.results if before else ())}
        known |= {r.ask: r for r in outcome.results}
        path = self._path(outcome.source)
        content = asdict(replace(outcome, results=tuple(known.values())))
        content["source"] = _as_json(outcome.source)
        # Written beside and renamed: whoever stops in between leaves the old file or the new one.
        draft = path.with_suffix(".draft")
        try:
            draft.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
            os.replace(draft, path)
        except OSError as error:
            raise InputError(f"{path} cannot be written: {error.strerror}.") from error

    def _load(self, source: Source) -> Outcome | None:
        try:
            content: dict[str, Any] = json.loads(self._path(source).read_text("utf-8"))
            results = tuple(
                Result(
                    Ask(Parameters(**r["ask"]["parameters"]), r["ask"]["resting"]),
                    r["metrics"],
                    r["seconds"],
                    r["why"],
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
        except (OSError, ValueError, KeyError, TypeError):
            # Not there, or not ours, or half a file: then it is computed again.
            return None

    def _path(self, source: Source) -> Path:
        identity = _as_json(source) | {"software": self._software}
        if isinstance(source, Recorded):
            del identity["path"]
            for key in ("path", "rig", "urdf"):
                identity[f"{key}_content"] = _content(getattr(source, key))
        digest = hashlib.sha256(json.dumps(identity, sort_keys=True).encode()).hexdigest()
        return self._folder / f"{source.name}-{digest[:16]}.json"


def _as_json(source: Source) -> dict[str, Any]:
    return {k: str(v) if isinstance(v, Path) else v for k, v in asdict(source).items()}


def _content(path: Path | None) -> str | None:
    """A digest of a file, None where it cannot be read: whoever opens it says why."""
    if path is None:
        return None
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError:
        return None
