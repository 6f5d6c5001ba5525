"""Order in which the frames of a recording are surveyed."""

_NEAR = 8
_COARSE = 16


def survey_order(size: int, near: int) -> list[int]:
    """Permutation of `range(size)`.

    First the frame that a person looks at and its neighbours, then every 16th, so that a plot
    shows its shape early, then those between.

    Args:
        size: number of frames.
        near: the frame that is looked at.
    """

    def step(k: int) -> int:
        return min(k & -k, _COARSE) if k else _COARSE

    def turn(k: int) -> tuple[int, int]:
        distance = abs(k - near)
        return (-_COARSE - 1, distance) if distance <= _NEAR else (-step(k), k)

    return sorted(range(size), key=turn)
