"""The example that drives a simulator in real time: it reaches goals there, and none where it is shown wrong ones."""

import importlib.util
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest
from harness import BENCH_ALLOWED, SIMULATOR

pytest.importorskip("gymnasium")
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "ambf_client_py/examples/learning"))
import ambf_gym  # noqa: E402
from psm_policy import Policy, episodes  # noqa: E402

NO_ROS = importlib.util.find_spec("rospy") is None or shutil.which("rosmaster") is None or not SIMULATOR.exists()


@pytest.mark.skipif(NO_ROS, reason="no ROS")
def test_an_arm_reaches_goals_while_the_world_runs_and_others_are_in_it(master, start, capsys):
    import policy_on_ros
    from ambf_client import Client

    start("-l", "15,16", master_uri=master.uri, allowed=BENCH_ALLOWED)
    with Client("person") as client:
        scope = client.wait_for("ecm/baselink")
        scope.set_joint_pos(0, 0.3)
        assert policy_on_ros.main(["--expert", "--episodes", "1"]) == 1.0
        assert policy_on_ros.main(["--expert", "--episodes", "1", "--wrong-goal"]) == 0.0
        assert scope.get_joint_pos(0) == pytest.approx(0.3, abs=0.01), "nothing was reset"
        assert not client.world.is_stepping()
    assert "reached 100.0 % of 1 unseen goals" in capsys.readouterr().out


def test_a_policy_is_kept_and_acts_on_one_and_on_many(tmp_path):
    random = np.random.default_rng(1)
    sizes = [20, 8, 3]
    weights = [
        random.normal(0, 0.1, shape).astype(np.float32)
        for fan_in, fan_out in zip(sizes[:-1], sizes[1:], strict=True)
        for shape in ((fan_in, fan_out), (fan_out,))
    ]
    Policy(weights).save(tmp_path / "policy.npz")
    act = Policy.load(tmp_path / "policy.npz")
    env = ambf_gym.make("ambf/PsmReach-v0")
    seen, _ = env.reset(seed=1)
    way = 100 * (seen["desired_goal"] - seen["achieved_goal"])
    joints, target = seen["observation"][:-3], 20 * seen["observation"][-3:]
    hidden = np.maximum(np.concatenate([way, joints, target]) @ weights[0] + weights[1], 0)
    assert act(seen) == pytest.approx(np.tanh(hidden @ weights[2] + weights[3]), abs=1e-6)
    many = act({name: np.stack([each, each]) for name, each in seen.items()})
    assert many.shape == (2, 3) and many[1] == pytest.approx(act(seen), abs=1e-6)
    assert episodes(env, act, range(2)) == [False, False]
    env.close()
