import base64
import json
import re
from dataclasses import fields

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.analysis.comparison import A, B, Comparison
from app.analysis.quantities import QUANTITIES
from app.analysis.zones import SOURCE, TARGET, Zone
from app.errors import InputError
from app.scene.camera import Camera
from app.scene.palettes import PALETTES
from app.scene.settings import ARROW_COLOURS, LAYERS, STATIC_SCENE, ViewSettings
from app.session.linked_view import PERSONAL, LinkedView
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


settings = st.builds(
    ViewSettings,
    static_scene=st.sampled_from(STATIC_SCENE),
    arrow_scale=st.floats(0.5, 10),
    point_size=st.floats(1, 20),
    arrow_colours=st.sampled_from(ARROW_COLOURS),
    colours=st.sampled_from(PALETTES),
    legend=st.booleans(),
    strip=st.sampled_from(sorted(QUANTITIES)),
    layers=st.frozensets(st.sampled_from(LAYERS)),
)
comparisons = st.builds(Comparison, parameters, st.sampled_from([A, B]), st.booleans())
names = st.sampled_from(sorted(QUANTITIES))


@given(
    st.builds(
        SavedSession,
        label=st.text(max_size=40),
        frame=st.integers(0, 10**6),
        parameters=parameters,
        camera=st.none() | cameras,
        settings=settings,
        comparison=st.none() | comparisons,
        picked=st.none() | st.integers(0, 100),
        plotted_pair=st.none() | st.tuples(names, names),
        selected=st.none() | st.integers(0, 100),
        pinned=st.none()
        | st.builds(
            Zone,
            side=st.sampled_from([SOURCE, TARGET]),
            sensor=st.integers(0, 100),
            row=st.integers(0, 63),
            column=st.integers(0, 63),
        ),
    )
)
def test_a_token_comes_back_as_the_same_session(saved):
    token = saved.token()
    assert re.fullmatch(r"[\w-]+", token, re.ASCII)
    assert from_token(token) == saved


def test_whether_the_page_is_dark_and_plays_is_everybodys_own():
    saved = SavedSession("a", 3, Parameters(), settings=ViewSettings(dark=True), playing=True)
    assert from_token(saved.token()) == SavedSession("a", 3, Parameters())


def test_a_link_holds_every_setting_that_is_not_personal():
    linked = {*LinkedView.model_fields} - {"hidden"} | {"layers"}
    assert not {field.name for field in fields(ViewSettings)} - linked - PERSONAL


def test_the_roll_of_the_camera_goes_with_it():
    camera = Camera((1.0, 2.0, 3.0), (4.0, 5.0, 6.0), 0.7)
    rolled = SavedSession("a", 3, Parameters(), camera, up=(0.6, 0.0, 0.8))
    assert from_token(rolled.token()) == rolled
    upright = SavedSession("a", 3, Parameters(), camera, up=(0.0, 0.0, 1.0))
    assert from_token(upright.token()).up is None


def test_links_of_before_there_was_a_comparison_in_them_still_open():
    token = made(parameters={"n": 5}, camera=[1, 2, 3, 4, 5, 6, 0.7])
    saved = from_token(token)
    assert saved.parameters == Parameters(n=5)
    assert saved == SavedSession("a", 3, Parameters(n=5), Camera((1, 2, 3), (4, 5, 6), 0.7))


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
        made(comparison={}),
        made(comparison={"other": {}, "edited": "C", "both": True}),
        made(comparison={"other": {}, "edited": "B", "both": 1}),
        made(view={"colours": "pink"}),
        made(view={"hidden": ["Walls"]}),
        made(view={"hidden": "Robot"}),
        made(view={"point_size": 1e9}),
        made(view={"arrow_scale": -1.0}),
        made(picked=-1),
        made(picked="0"),
        made(plotted=["time"]),
        made(plotted=["time", "password"]),
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
    with pytest.raises(InputError, match="The link: gamma must be between 0 and 1"):
        from_token(made(comparison={"other": {"gamma": 7}, "edited": "A", "both": False}))
    with pytest.raises(InputError, match="The link: speed is no parameter"):
        from_token(made(parameters={"speed": 7}))
