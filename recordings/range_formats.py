"""Registry of range formats; a new one is added to the tuple."""

from recordings.depth_images import DEPTH_IMAGE
from recordings.range_format import RangeFormat

RANGE_FORMATS = (DEPTH_IMAGE,)

_BY_TYPE = {form.type: form for form in RANGE_FORMATS}


def range_format(schema_name: str) -> RangeFormat | None:
    """Reader of the messages of a schema, such as sensor_msgs/msg/Image; None for another type."""
    return _BY_TYPE.get(schema_name.replace("/msg/", "/"))
