"""Rig of our own recordings: an attachment of the file, and names of topics."""

from recordings.mcap_file import McapFile
from robot_assets import Rig, RigError, parse_rig, rig_text

RIG_ATTACHMENT = "rig.toml"
"""Name of the attachment, a rig file as for --rig."""
RIG_TYPE = "application/toml"
_LARGEST = 1_000_000  # bytes; a thousand sensors need a third of it


def packed(rig: Rig) -> bytes:
    """Content of the attachment."""
    return rig_text(rig).encode("utf-8")


def rig_of(file: McapFile) -> tuple[Rig | None, list[str]]:
    """Rig attached to a recording, None where there is none or it is not usable.

    Returns:
        The rig, and a warning where it is not usable.
    """
    content = file.attachment(RIG_ATTACHMENT)
    if content is None:
        return None, []
    if len(content) > _LARGEST:
        return None, [f"The file's own rig has {len(content)} bytes, too many; it is not used."]
    try:
        return parse_rig(content, f"{RIG_ATTACHMENT} in the file"), []
    except RigError as error:
        return None, [f"{error} It is not used."]


def topic_part(sensor_name: str) -> str:
    """Part of topics and frames that names a sensor."""
    return sensor_name.strip("/").replace(" ", "_")


def depth_topic(part: str) -> str:
    """Topic of a sensor's ranges."""
    return f"/tof/{part}/image"
