"""The flags that say how recordings are opened."""

import argparse
from dataclasses import dataclass
from pathlib import Path

from app.errors import InputError
from recordings import Recording, open_recording
from robot_assets import Rig, Robot, load_rig, load_robot


@dataclass(frozen=True)
class Opening:
    """Settings for opening recordings: the arguments of `open_recording` beside the path."""

    fixed_frame: str | None = None
    truth_frame: str | None = None
    rig: Rig | None = None
    robot: Robot | None = None
    mesh_folders: tuple[Path, ...] = ()

    def open(self, path: Path) -> Recording:
        """Open a recording; RecordingError where that is not possible."""
        return open_recording(
            path, self.fixed_frame, self.truth_frame, self.rig, self.robot, self.mesh_folders
        )


def add_recording_flags(parser: argparse.ArgumentParser) -> None:
    """Add --fixed-frame, --truth-frame, --rig, --urdf and --meshes."""
    group = parser.add_argument_group("how recordings are opened")
    group.add_argument(
        "--fixed-frame",
        metavar="FRAME",
        help="frame in which clouds and flow are (default: the root of /tf, or the robot's base)",
    )
    group.add_argument(
        "--truth-frame",
        metavar="FRAME",
        help="frame whose rigid motion is the truth (default: the recorded twist or pose)",
    )
    group.add_argument(
        "--rig",
        type=Path,
        metavar="FILE",
        help=(
            "rig file (TOML): names and intrinsics of the sensors, and their places where /tf has "
            "none (default: as recorded; places by the rig in the file, or by the paper's on a "
            "Panda)"
        ),
    )
    group.add_argument(
        "--urdf",
        type=Path,
        metavar="FILE",
        help="robot (default: the recording's own description, or a Panda where the joints fit)",
    )
    group.add_argument(
        "--meshes",
        type=Path,
        action="append",
        default=[],
        metavar="FOLDER",
        help=(
            "folder with the meshes of the robot, or with packages of them; may be given several "
            "times (default: packages of ROS and of example-robot-data, by their names alone)"
        ),
    )


def opening_from(options: argparse.Namespace) -> Opening:
    """Collect the flags.

    Raises:
        RigError, RobotError: a file cannot be used.
        InputError: a folder is not there.
    """
    for folder in options.meshes:
        if not folder.is_dir():
            raise InputError(f"There is no folder {folder} (--meshes).")
    return Opening(
        fixed_frame=options.fixed_frame,
        truth_frame=options.truth_frame,
        rig=load_rig(options.rig) if options.rig else None,
        robot=load_robot(options.urdf, options.meshes) if options.urdf else None,
        mesh_folders=tuple(options.meshes),
    )


def with_absolute_paths(options: argparse.Namespace) -> argparse.Namespace:
    """The same flags for processes that run in other folders, as a cluster's do."""
    changed = argparse.Namespace(**vars(options))
    changed.rig, changed.urdf = (path and path.absolute() for path in (options.rig, options.urdf))
    changed.meshes = [folder.absolute() for folder in options.meshes]
    return changed


def files_read(options: argparse.Namespace) -> list[Path]:
    """Files beside the recordings that the flags name: rig, robot, parameters."""
    named = (options.rig, options.urdf, options.parameters)
    return [path for path in named if path is not None]


def recording_paths(arguments: list[Path]) -> list[Path]:
    """The recordings that arguments name: files as they are, folders as the *.mcap in them.

    Raises:
        InputError: a path is not there, or a folder has no recordings.
    """
    paths: list[Path] = []
    for argument in arguments:
        if argument.is_dir():
            inside = sorted(argument.glob("*.mcap"))
            if not inside:
                raise InputError(f"The folder {argument} has no .mcap files.")
            paths += inside
        elif argument.exists():
            paths.append(argument)
        else:
            raise InputError(f"There is no file or folder {argument}.")
    return paths
