"""Order in which the frames of a recording are surveyed."""

_NEAR = 8
_COARSE = 16
_SHAPE = 128  # frames that show the shape of a plot


def survey_order(size: int, near: int) -> list[int]:
    """Permutation of `range(size)`.

    First the frame that a person looks at and its neighbours; then, so that plots show their shape
    early, some evenly spread frames of a long recording; then every 16th, and those between.

    Args:
        size: number of frames.
        near: the frame that is looked at.
    """
    spread = max(_COARSE, size // _SHAPE)

    def turn(k: int) -> tuple[int, int]:
        if abs(k - near) <= _NEAR:
            return 0, abs(k - near)
        if k % spread == 0:
            return 1, k
        return 2 + _COARSE - min(k & -k, _COARSE), k

    return sorted(range(size), key=turn)
