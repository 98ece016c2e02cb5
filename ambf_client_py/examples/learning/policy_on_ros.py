"""A policy that was trained without ROS moves the PSM of a simulator that runs in real time, while people work in it.

Start a simulator (./dev run -l 15,16: the PSM, and the endoscope's arm for a person), train (train_psm_reach.py), then:

    ./dev shell -- python ambf_client_py/examples/learning/policy_on_ros.py --policy psm_reach/policy.npz

Nothing waits for the policy and nothing is reset: an episode begins when the arm has gone home. Somebody else may move
the endoscope meanwhile, by devices or programs (examples/joint_sinusoids.py ecm/baselink). --wrong-goal is a control:
the policy is shown other goals than those that count, and so reaches next to none.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
from ambf_client import Client, SimulatorUnavailable
from ambf_core import Commands, State, World
from ambf_core.arrays import BodyMode, JointMode, allocate
from ambf_gym.dvrk import PsmReach
from psm_policy import UNSEEN, Policy, WrongGoal, episodes

STEP = 0.001  # s
LATE = 5  # steps that an action may be late before it counts as such
SILENCE = 2.0  # s without a state after which the simulator is gone
STILL = 1e-4  # rad or m of a joint in 50 ms, below which the arm stands


class LiveWorld:
    """What environments use of a world, of a simulator that runs by itself: step(n) is a wait until n steps are over.

    Only of `shown` bodies is there a state; joints and their commands are the first one's.
    """

    def __init__(self, client: Client, files: Any, ground: Any, shown: tuple[str, ...]) -> None:
        with World(*files, world=ground) as plan:
            self.bodies, self.joints, self.rows = plan.bodies, plan.joints, plan.rows
            self.body, self.joint = plan.body, plan.joint
            state, commands = allocate(plan.counts)
            for array, start in zip(commands, plan.commands.arrays(), strict=True):
                array[...] = start
            names = [plan.bodies[plan.body(each)] for each in shown]
        self._arrays = dict(zip(State.fields(), state, strict=True))
        self.state, self.commands = State(state), Commands(commands, self.rows)
        self._handles = [client.wait_for(name) for name in names]
        self._led = [self.joint(name) for name in self._handles[0].get_joint_names()]
        self._sent: dict[int, list[float]] = {}
        self._client = client
        self.late, self.acts = 0, 0
        self._due = self._handles[0].get_sim_step()
        self.step(1)

    def step(self, n: int = 1) -> None:
        """Sends what is commanded, and waits until n steps after the last ones are over. Who comes late catches up."""
        self._send()
        now = self._handles[0].get_sim_step()
        self.acts, self.late = self.acts + 1, self.late + (now > self._due + LATE)
        self._due = max(self._due, now - LATE) + n
        for handle in self._handles:
            if not handle.wait_for_sim_step(self._due, SILENCE + n * STEP):
                raise SimulatorUnavailable(f"{handle.get_name()} shows no state any more")
        self._show()

    def _send(self) -> None:
        commands = self.commands
        led = np.flatnonzero(commands.joint_mode[self._led] == JointMode.POSITION)  # passive joints obey nobody
        if len(led):
            values = commands.joint_value[self._led]
            self._handles[0].set_joint_pos({int(index): float(values[index]) for index in led})
        for row in np.flatnonzero(commands.body_mode == BodyMode.POSE):
            pose = commands.body_pose[row].tolist()
            if self._sent.get(int(row)) != pose:
                self._client.wait_for(self.bodies[row]).set_pose(pose)
                self._sent[int(row)] = pose

    def _show(self) -> None:
        arrays, base = self._arrays, self._handles[0]
        arrays["sim_step"][...] = base.get_sim_step()
        arrays["sim_time"][...] = base.get_sim_time()
        arrays["joint_position"][self._led] = base.joint_positions
        arrays["joint_velocity"][self._led] = base.joint_velocities
        for handle in self._handles:
            row = self.rows["bodies"][handle.get_name()]
            arrays["body_pose"][row] = [*handle.position, *handle.orientation]


class LivePsmReach(PsmReach):
    """PsmReach in such a world."""

    def __init__(self, client: Client) -> None:
        self.live = LiveWorld(client, self.files, self.ground, ("baselink", self.tip))
        super().__init__(backend=self.live)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Goes home, and begins an episode with a new goal."""
        home, state = self._targets(self._arm.home), self.world.state
        self.world.commands.set_joints(home, joints=self._rows)
        for _ in range(100):
            before = state.joint_position[self._rows].copy()
            self.world.step(50)
            if np.abs(state.joint_position[self._rows] - before).max() < STILL:
                return self.begin(seed, options)
        raise RuntimeError("the arm does not come to rest at home: does somebody else move it?")


def main(arguments: list[str] | None = None) -> float:
    """The program; the share of episodes that succeeded."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--policy", type=Path, default=Path("psm_reach/policy.npz"))
    parser.add_argument("--expert", action="store_true", help="the environment's own policy in place of a trained one")
    parser.add_argument("--episodes", type=int, default=50)
    parser.add_argument("--wrong-goal", action="store_true", help="control: see another goal than the one that counts")
    options = parser.parse_args(arguments)
    with Client("policy_on_ros") as client:
        live = LivePsmReach(client)
        act = live.expert() if options.expert else Policy.load(options.policy)
        env: gymnasium.Env[Any, Any] = gymnasium.wrappers.TimeLimit(live, 50)
        env = WrongGoal(env) if options.wrong_goal else env
        begun, first = time.monotonic(), int(live.world.state.sim_step)
        ends = episodes(env, act, range(UNSEEN, UNSEEN + options.episodes))
        seconds = time.monotonic() - begun
        factor = (int(live.world.state.sim_step) - first) * STEP / seconds
    share = float(np.mean(ends))
    print(f"reached {100 * share:.1f} % of {len(ends)} unseen goals in {seconds:.0f} s")
    print(f"real-time factor {factor:.3f}; {live.live.late} of {live.live.acts} waits ended more than {LATE} ms late")
    return share


if __name__ == "__main__":
    main()
