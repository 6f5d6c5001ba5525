"""Provenance of the recordings that we write: a metadata record of the file."""

from dataclasses import MISSING, asdict, fields

from recordings.errors import RecordingError
from recordings.frame import Provenance
from recordings.mcap_file import McapFile

PROVENANCE_RECORD = "tofscope"
_OPTIONAL = ("imperfections", "rig", "repeated")


def provenance_of(file: McapFile) -> Provenance | None:
    """Provenance of a file by its metadata; None for files of other writers.

    Raises:
        RecordingError: a value of the record is missing or wrong.
    """
    record = file.metadata(PROVENANCE_RECORD)
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
            repeated=record.get("repeated", ""),
        )
    except (KeyError, ValueError) as error:
        names = ", ".join(f.name for f in fields(Provenance) if f.default is MISSING)
        raise RecordingError(
            f"{file.path}: its metadata record '{PROVENANCE_RECORD}' must hold {names}; "
            f"wrong or missing: {error}."
        ) from error


def provenance_record(provenance: Provenance) -> dict[str, str]:
    """Metadata record of a provenance."""
    values = asdict(provenance) | {"imperfections": " ".join(provenance.imperfections)}
    # Empty values are left out, so that the record of an older file stays the same.
    values = {name: v for name, v in values.items() if v != "" or name not in _OPTIONAL}
    return {name: str(v).lower() if isinstance(v, bool) else str(v) for name, v in values.items()}
