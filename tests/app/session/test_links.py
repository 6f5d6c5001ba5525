import base64
import json
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.errors import InputError
from app.scene.camera import Camera
from app.scene.settings import ViewSettings
from app.session.links import SavedSession, from_token
from estimator import Parameters

coordinate = st.floats(-100, 100).map(lambda x: round(x, 4))
cameras = st.builds(
    Camera,
    st.tuples(coordinate, coordinate, st.floats(200, 300).map(lambda x: round(x, 4))),
    st.tuples(coordinate, coordinate, coordinate),
    st.floats(0.1, 2.0).map(lambda x: round(x, 4)),
)
parameters = st.builds(
    Parameters,
    n=st.integers(1, 1000),
    delta=st.floats(0, 10),
    method=st.sampled_from(["paper", "baseline"]),
    min_samples=st.none() | st.integers(1, 50),
    allow_single_cluster=st.booleans(),
)


@given(st.text(max_size=40), st.integers(0, 10**6), parameters, st.none() | cameras)
def test_a_token_comes_back_as_the_same_session(label, frame, parameters, camera):
    saved = SavedSession(label, frame, parameters, camera)
    token = saved.token()
    assert re.fullmatch(r"[\w-]+", token, re.ASCII)
    assert from_token(token) == saved


def test_settings_are_everybodys_own():
    saved = SavedSession("a", 3, Parameters(), settings=ViewSettings(dark=True))
    assert from_token(saved.token()).settings == ViewSettings()


def made(**changes):
    content = {"recording": "a", "frame": 3, "parameters": {}, **changes}
    return base64.urlsafe_b64encode(json.dumps(content).encode()).decode()


@pytest.mark.parametrize(
    "token",
    [
        "",
        "x",
        "äöü",
        "a" * 5000,
        base64.urlsafe_b64encode(b"[" * 2000).decode(),
        base64.urlsafe_b64encode(b"[1, 2]").decode(),
        made(recording=7),
        made(frame="3"),
        made(parameters=[]),
        made(camera=7),
        made(camera=[1, 2, 3]),
        made(camera=[1, 2, 3, 1, 2, 3, 0.7]),
        made(camera=[1, 2, 3, 4, 5, float("nan"), 0.7]),
        made(camera=[1, 2, 1e9, 4, 5, 6, 0.7]),
        made(camera=[1, 2, 3, 4, 5, 6, 9.0]),
        made(camera=[int("1" * 400), 2, 3, 4, 5, 6, 0.7]),
        made(camera=[int("1" * 400)] * 7),
        made(camera=[True, 2, 3, 4, 5, 6, 0.7]),
        made(frame=True),
        made(frame=-1),
        made(frame=2.0),
        made(frame=2**63),
        made(frame=int("9" * 400)),
        made(recording="\ud800"),
        made(parameters={"\udfff": 1}),
        made(parameters={"method": "\ud83d"}),
        base64.urlsafe_b64encode(
            b'{"recording":"a","frame":3,"parameters":{"n":' + b"[" * 1400 + b"]" * 1400 + b"}}"
        ).decode(),
    ],
)
def test_a_damaged_token_is_told(token):
    with pytest.raises(InputError, match="The link is damaged"):
        from_token(token)


def test_parameters_that_cannot_be_used_are_told():
    with pytest.raises(InputError, match="The link: gamma must be between 0 and 1"):
        from_token(made(parameters={"gamma": 7}))
    with pytest.raises(InputError, match="The link: n must be a number"):
        from_token(made(parameters={"n": [[[[[5]]]]]}))
    with pytest.raises(InputError, match="The link: speed is no parameter"):
        from_token(made(parameters={"speed": 7}))
