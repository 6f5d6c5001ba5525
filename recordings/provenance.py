"""Provenance of the recordings that we write: a metadata record of the file."""

from dataclasses import MISSING, asdict, fields

from recordings.errors import RecordingError
from recordings.frame import Provenance
from recordings.mcap_file import McapFile

PROVENANCE_RECORD = "tofscope"
_UNSAID = ("imperfections", "rig")


def provenance_of(file: McapFile) -> Provenance | None:
    """The provenance of a file by its metadata; None for files that we did not write.

    Raises:
        RecordingError: the record is not as we write it.
    """
    record = file.metadata.get(PROVENANCE_RECORD)
    if record is None:
        return None
    try:
        return Provenance(
            simulated=record["simulated"] == "true",
            scenario=record["scenario"],
            speed=float(record["speed"]),
            trial=int(record["trial"]),
            seed=int(record["seed"]),
            noise=record["noise"],
            command=record["command"],
            imperfections=tuple(record.get("imperfections", "").split()),
            rig=record.get("rig", ""),
        )
    except (KeyError, ValueError) as error:
        names = ", ".join(f.name for f in fields(Provenance) if f.default is MISSING)
        raise RecordingError(
            f"{file.path}: its metadata record '{PROVENANCE_RECORD}' must hold {names}; "
            f"wrong or missing: {error}."
        ) from error


def provenance_record(provenance: Provenance) -> dict[str, str]:
    """The metadata record of a file that comes from there."""
    values = asdict(provenance) | {"imperfections": " ".join(provenance.imperfections)}
    # What an older file does not say stays unsaid, so that nothing in it changes.
    values = {name: v for name, v in values.items() if v != "" or name not in _UNSAID}
    return {name: str(v).lower() if isinstance(v, bool) else str(v) for name, v in values.items()}
