"""Handles of the simulation as programs of AMBF 3.0 wrap them: poses in pieces, names from the handle's privates."""

import math
import sys
import time

import numpy as np
from ambf_client import Client
from tf_function import quaternion_from_euler


def frame(position, angles):
    """A 4x4 matrix of a position (m) and roll, pitch, yaw (rad)."""
    x, y, z, w = quaternion_from_euler(*angles)
    made = np.identity(4)
    made[:3, :3] = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
        (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
        (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
    )
    made[:3, 3] = position
    return made


def angles_of(matrix):
    """Roll, pitch, yaw (rad)."""
    r = matrix[:3, :3]
    return math.atan2(r[2, 1], r[2, 2]), math.asin(max(-1.0, min(1.0, -r[2, 0]))), math.atan2(r[1, 0], r[0, 0])


def inverse(matrix):
    made = np.identity(4)
    made[:3, :3] = matrix[:3, :3].T
    made[:3, 3] = -made[:3, :3] @ matrix[:3, 3]
    return made


def wait_until(condition, what, seconds=100.0):
    """Ends the program when it does not become true."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            sys.exit(f"not within {seconds} s: {what}")
        time.sleep(0.01)


class SimulationObject:
    def __init__(self, ambf_object):
        self._object = ambf_object

    def get_ros_name(self):
        return self._object._name

    def get_pos(self):
        return np.array([getattr(self._object.get_pos(), axis) for axis in "xyz"])

    def get_pose(self):
        return frame(self.get_pos(), self._object.get_rpy())

    def set_pos(self, position):
        self._object.set_pos(*map(float, position))

    def set_rpy(self, r, p, y):
        self._object.set_rpy(r, p, y)

    def set_pose(self, pose):
        self.set_pos(pose[:3, 3])
        self.set_rpy(*angles_of(pose))

    def get_joint_names(self):
        return self._object.get_joint_names()

    def get_joint_pos(self, index):
        return self._object.get_joint_pos(index)

    def get_joint_vel(self, index):
        return self._object.get_joint_vel(index)

    def set_joint_pos(self, index, value):
        self._object.set_joint_pos(index, float(value))

    def set_joint_vel(self, index, value):
        self._object.set_joint_vel(index, float(value))

    def set_force(self, force):
        self._object.set_force(*force)

    def set_torque(self, torque):
        self._object.set_torque(*torque)

    def __getattr__(self, name):  # actuate(), get_all_sensed_obj_names(), ...
        return getattr(self._object, name)


class SimulationManager:
    def __init__(self, name):
        self._client = Client(name)
        assert self._client.ral is None  # until connect()
        self._client.connect()
        time.sleep(1.0)

    def get_obj_handle(self, name, required=False):
        handle = self._client.get_obj_handle(name)
        if handle is None and required:
            raise RuntimeError(f"the simulation has no {name}")
        return None if handle is None else SimulationObject(handle)

    def get_world_handle(self):
        return self._client.get_world_handle()

    def is_shutdown(self):
        return self._client.is_shutdown()

    def get_time(self):
        return self._client.get_time()

    def get_time_msg(self):
        return self._client.get_ral().now_msg()

    def create_rate(self, rate):
        return self._client.create_rate(rate)

    def get_ral(self):
        return self._client.get_ral()
