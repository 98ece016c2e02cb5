#!/usr/bin/env python3
"""Picks up what a sensor sees: a palm comes down until its ray meets a cube, holds it by an actuator and carries it.

Start a simulator (any scene), then: ./dev shell -- python ambf_client_py/examples/pick_by_sensor.py
Palm and cube are loaded for this and taken away again.
"""

from collections.abc import Callable

import numpy as np
from ambf_client import Client

MODEL = """\
adf version: 1.0
namespace: /ambf/env/picking/
bodies: [BODY palm, BODY cube]
sensors: [SENSOR eye]
actuators: [ACTUATOR grip]
BODY palm:
  name: palm
  mass: 0.3
  inertia: {ix: 0.0003, iy: 0.0003, iz: 0.0003}
  gravity: {x: 0.0, y: 0.0, z: 0.0}
  location: {position: {x: 0.0, y: 0.0, z: 0.3}}
  shape: BOX
  geometry: {x: 0.05, y: 0.05, z: 0.02}
  collision shape: BOX
  collision geometry: {x: 0.05, y: 0.05, z: 0.02}
  controller: {linear: {P: 300.0, I: 0.0, D: 20.0}, angular: {P: 2.0, I: 0.0, D: 0.05}}
  controller output type: FORCE
BODY cube:
  name: cube
  mass: 0.1
  location: {position: {x: 0.0, y: 0.0, z: 0.03}}
  shape: BOX
  geometry: {x: 0.06, y: 0.06, z: 0.06}
  collision shape: BOX
  collision geometry: {x: 0.06, y: 0.06, z: 0.06}
SENSOR eye:
  name: eye
  type: Proximity
  parent: BODY palm
  range: 0.03
  array: [{offset: {x: 0.0, y: 0.0, z: 0.0}, direction: {x: 0.0, y: 0.0, z: -1.0}}]
ACTUATOR grip:
  name: grip
  type: Constraint
  parent: BODY palm
"""
PLACE = (0.6, 0.5, 0.0)  # m: beside what else there is
FAR = (0.6, 0.7)  # x and y of where it is put down
SPEED = 0.2  # m/s


def main() -> None:
    with Client("pick_by_sensor") as client:
        world = client.world
        loaded = client.load(text=MODEL, pose=[*PLACE, 0.0, 0.0, 0.0])
        try:
            palm, cube, eye, grip = (client.wait_for(f"picking/{name}") for name in ("palm", "cube", "eye", "grip"))
            world.step(300)  # the world waits for our steps; the cube comes to rest
            start = cube.position
            x, y, height = (float(v) for v in start)

            def go(place: list[float], until: Callable[[], bool | None] = bool) -> None:
                """In a straight line, to the end or until something happens."""
                begin, goal = palm.position, np.array(place)
                steps = int(100 * np.linalg.norm(goal - begin) / SPEED) + 1
                for n in range(1, steps + 1):
                    palm.set_pose([*(begin + (goal - begin) * n / steps), 0.0, 0.0, 0.0])
                    if grip.is_commanded():
                        grip.actuate_from_sensor_data("picking/eye")  # commands end after 0.5 s
                    world.step(10)
                    if until():
                        return

            go([x, y, height], until=lambda: eye.is_triggered(0))
            print(f"the ray meets {eye.get_sensed_object(0)}")
            grip.actuate_from_sensor_data("picking/eye")
            world.step(10)
            held = palm.position - cube.position
            go([x, y, height + 0.2])
            print(f"lifted by {1e3 * (cube.position[2] - start[2]):.0f} mm")
            go([*FAR, height + 0.2])
            go([*FAR, height + 0.04])
            moved = np.linalg.norm(palm.position - cube.position - held)
            print(f"moved in the grasp by {1e3 * moved:.3f} mm")
            grip.deactuate()
            world.step(500)
            print(f"put down {1e3 * np.linalg.norm(cube.position[:2] - start[:2]):.0f} mm further")
        finally:
            world.release()
            client.unload(loaded.model)


if __name__ == "__main__":
    main()
