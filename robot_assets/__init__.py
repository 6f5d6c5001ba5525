"""Robot model: description, kinematics, sensor rigs, ray casting, and the self filter."""

from robot_assets.errors import RobotError
from robot_assets.joint_match import JointMatch
from robot_assets.raycast import RayCaster
from robot_assets.rig import Rig, RigError, Sensor, load_rig, parse_rig
from robot_assets.rig_names import plain_name
from robot_assets.rig_text import rig_text
from robot_assets.robot import Robot, Transform, load_robot
from robot_assets.self_filter import SelfFilter
from robot_assets.sensor_model import SensorModel, zone_rays

__all__ = [
    "JointMatch",
    "RayCaster",
    "Rig",
    "RigError",
    "Robot",
    "RobotError",
    "SelfFilter",
    "Sensor",
    "SensorModel",
    "Transform",
    "load_rig",
    "load_robot",
    "parse_rig",
    "plain_name",
    "rig_text",
    "zone_rays",
]
