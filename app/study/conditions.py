"""Conditions and commands of a study, as sentences for captions and the page."""

import shlex
from collections.abc import Iterable

from app.analysis.method_files import method_files
from app.analysis.parameter_files import flag_of
from app.study.plan import Plan
from estimator import METRIC_INFO, PARAMETER_INFO, ParameterInfo, find_method, values_of
from recordings.simulation import IMPERFECTIONS, NOISE_MODELS


def conditions(plan: Plan) -> str:
    """Caption: simulated or recorded, noise, imperfections, seed, parameters."""
    if plan.recordings is not None:
        return f"Recordings that were given. {opening_text(plan)} {parameters_text(plan)}."
    also = ", ".join(plan.imperfections) or "none"
    rig = f"rig {plan.rig.name}, " if plan.rig else ""
    return (
        f"Simulated, not measured: {rig}noise model {plan.noise}, imperfections {also}, seed "
        f"{plan.seed}. {parameters_text(plan)}."
    )


def opening_text(plan: Plan) -> str:
    """Sentences on the fixed frame and the truth frame, "" if neither was given."""
    first = plan.recordings[0] if plan.recordings else None
    sentences: list[str] = []
    if first and first.fixed_frame:
        sentences.append(f"Clouds and flow are in the frame {first.fixed_frame}.")
    if first and first.truth_frame:
        sentences.append(
            f"The truth is the motion of the frame {first.truth_frame}: coverage, precision, EPE3D "
            "and the other metrics of points assume that every point moves with it."
        )
    return " ".join(sentences)


def truth_frame_text(plan: Plan) -> str:
    """Addition to a table's note where truth is the motion of a frame, else ""."""
    if not (plan.recordings and (frame := plan.recordings[0].truth_frame)):
        return ""
    return (
        f" Every point is taken to move with the frame {frame}: precision is 1 by construction "
        "(less only where that rests), and false flow looks only at moments of rest."
    )


def definitions(metrics: Iterable[str]) -> str:
    """Definitions of metrics, a sentence for each that is not a count."""
    infos = [METRIC_INFO[name] for name in metrics]
    return " ".join(f"{info.described}." for info in infos if info.kind != "count")


def parameters_text(plan: Plan) -> str:
    """Names and values of all parameters of the study's methods."""
    values = values_of(plan.parameters)
    return ", ".join(_written(name, values[name], info) for name, info in _infos(plan).items())


def _written(name: str, value: object, info: ParameterInfo) -> str:
    if info.kind in (int, float) and value is not None:
        return f"{name} = {value:g} {info.unit}".strip()
    return f"{name} = {'unset' if value is None else str(value).lower()}"


def _infos(plan: Plan) -> dict[str, ParameterInfo]:
    """{name: description} of all methods' parameters, shared ones first."""
    infos = {n: info for method in plan.methods for n, info in find_method(method).infos().items()}
    shared = {name: infos[name] for name in PARAMETER_INFO if name in infos}
    return shared | infos


def simulator_texts(plan: Plan) -> list[str]:
    """Sentences on noise model and imperfections."""
    return [
        f"Noise model {plan.noise}: {NOISE_MODELS[plan.noise].text}.",
        *(f"Imperfection {name}: {IMPERFECTIONS[name].text}." for name in plan.imperfections),
    ]


def study_command(plan: Plan) -> str:
    """Command that evaluates the recordings of `simulate_command`."""
    flags: list[str] = []
    values = values_of(plan.parameters)
    methods = [text for name in plan.methods for text in method_files([name]) or (name,)]
    for name, info in _infos(plan).items():
        value, flag = values[name], flag_of(name)
        if value == info.default:
            continue
        if isinstance(value, bool):
            flags.append(flag if value else f"--no-{flag.removeprefix('--')}")
        else:
            flags += [flag, str(value)]
    return shlex.join(
        [
            *("tofscope", "study", "--recordings", "recordings", "--method", *methods),
            *("--sweep", *map(str, plan.sweep), *flags, "--out", "FOLDER"),
        ]
    )


def simulate_command(plan: Plan) -> str:
    """Command that writes the study's recordings to files."""
    return shlex.join(
        [
            *("tofscope", "simulate", *plan.scenarios),
            *(["--speed", *(f"{speed:g}" for speed in plan.speeds)] if plan.speeds else []),
            *("--trial", *map(str, plan.trials)),
            *("--seed", str(plan.seed), "--noise", plan.noise),
            *(["--imperfections", *plan.imperfections] if plan.imperfections else []),
            *(["--rig", str(plan.rig)] if plan.rig else []),
            *("--out", "recordings"),
        ]
    )
