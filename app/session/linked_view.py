"""View settings in a link, which anybody may have written."""

from collections.abc import Collection
from dataclasses import fields
from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from app.analysis.quantities import QUANTITIES
from app.scene.palettes import PALETTES
from app.scene.settings import ARROW_COLOURS, LAYERS, STATIC_SCENE, ViewSettings

PERSONAL = frozenset({"dark", "follows_system", "behind"})
"""Settings that no link holds: those of the reader's own page, and of pictures alone."""

_DEFAULTS = ViewSettings()


def one_of(options: Collection[str]) -> AfterValidator:
    """Check that a text is one of these options."""

    def check(value: str) -> str:
        if value not in options:
            raise ValueError(f"{value!r} is none of {', '.join(options)}")
        return value

    return AfterValidator(check)


class LinkedView(BaseModel):
    """Settings of the drawing, each checked as strictly as its control does.

    Layers are those that are hidden, so that layers which an older link does not know are shown.
    """

    model_config = ConfigDict(strict=True, allow_inf_nan=False, frozen=True)

    static_scene: Annotated[str, one_of(STATIC_SCENE)] = _DEFAULTS.static_scene
    arrow_scale: Annotated[float, Field(gt=0, le=100)] = _DEFAULTS.arrow_scale
    point_size: Annotated[float, Field(gt=0, le=100)] = _DEFAULTS.point_size
    arrow_colours: Annotated[str, one_of(ARROW_COLOURS)] = _DEFAULTS.arrow_colours
    colours: Annotated[str, one_of(PALETTES)] = _DEFAULTS.colours
    legend: bool = _DEFAULTS.legend
    strip: Annotated[str, one_of(QUANTITIES)] = _DEFAULTS.strip
    hidden: tuple[Annotated[str, one_of(LAYERS)], ...] = ()

    @classmethod
    def of(cls, settings: ViewSettings) -> "LinkedView":
        """What a link holds of these settings."""
        values = {f.name: getattr(settings, f.name) for f in fields(settings)}
        shown = values.pop("layers")
        linked = {name: value for name, value in values.items() if name not in PERSONAL}
        return cls(**linked, hidden=tuple(name for name in LAYERS if name not in shown))

    def settings(self) -> ViewSettings:
        """The settings that a page begins with."""
        values: dict[str, Any] = self.model_dump(exclude={"hidden"})
        return ViewSettings(**values, layers=frozenset(LAYERS) - frozenset(self.hidden))
