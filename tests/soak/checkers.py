"""gymnasium's checker on every environment, backend, render mode and observation, with warnings as errors.

    DISPLAY=:1 ./dev shell -- python tests/soak/checkers.py [--only PART] [--backend core|ros]
    DISPLAY=:1 ./dev learn python tests/soak/checkers.py --backend core [--checker sb3]

In this process: each observation, without a render mode and with each ("human" opens windows). Over ROS: simulators
that this program starts, with a window and without. Ends with 1 where a check fails; nothing is skipped.
"""

import argparse
import os
import sys
import tempfile
import warnings
from pathlib import Path

import ambf_gym
import gymnasium
from gymnasium.utils import env_checker

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/acceptance"), str(ROOT / "tests/benchmarks")]

TASKS = ("--launch_file", str(ROOT / "ambf_models/descriptions/launch_tasks.yaml"))
# What a simulator loads for each.
PLACES = {
    "ambf/AmbfEnv-v0": (*TASKS, "-l", "1,9"),
    "ambf/Arm7Reach-v0": ("-l", "2"),
    "ambf/BiPegTransfer-v0": (*TASKS, "-l", "1,9"),
    "ambf/EcmReach-v0": ("-l", "16"),
    "ambf/EcmTrack-v0": ("-l", "16"),
    "ambf/NeedleDrive-v0": (*TASKS, "-l", "12,13"),
    "ambf/NeedlePick-v0": (*TASKS, "-l", "1,10"),
    "ambf/NeedleRegrasp-v0": (*TASKS, "-l", "1,10"),
    "ambf/PegTransfer-v0": (*TASKS, "-l", "1,9"),
    "ambf/PsmReach-v0": ("-l", "15"),
    "ambf/RingLift-v0": (*TASKS, "-l", "1,9"),
    "ambf/RingWire-v0": (*TASKS, "-l", "0"),
    "ambf/TissueRetract-v0": (*TASKS, "-l", "11"),
}


def check(env, draws, checker):
    if checker == "sb3":
        from stable_baselines3.common import env_checker as of_sb3

        of_sb3.check_env(env, warn=True, skip_render_check=True)
        if draws:
            of_sb3._check_render(env, warn=True)  # by itself: check_env goes on with what this one has closed
    else:
        env_checker.check_env(env, skip_render_check=not draws, skip_close_check=True)


def problem(id, draws, checker="gymnasium", **options):
    """What the checker says, or an empty text."""
    env = None
    try:
        env = ambf_gym.make(id, **options)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.simplefilter("ignore", ResourceWarning)  # rospy leaves sockets to the collector
            check(env.unwrapped, draws, checker)
            env.close()
            env.close()
    except Exception as fault:  # whatever it raises is a fault of the environment
        return f"{type(fault).__name__}: {fault}"
    finally:
        if env is not None:
            env.close()
    return ""


def in_process(id, checker):
    """(options, problem) of each."""
    for observation in ("state", "pictures", "both"):
        if (id, observation) == ("ambf/AmbfEnv-v0", "both"):
            continue  # it has no dict
        for mode in (None, "rgb_array", "human"):
            options = {"observation": observation, "render_mode": mode}
            yield options, problem(id, False, checker, **options)
    yield {"each render mode": "by the checker"}, problem(id, True, checker, render_mode="rgb_array")


def over_ros(id, master):
    """(options, problem) of each."""
    from harness import Simulator

    for mode in (None, "human"):
        display = os.environ["DISPLAY"] if mode else ""
        with tempfile.TemporaryDirectory() as folder:
            simulator = Simulator(folder, *PLACES[id], master_uri=master.uri, display=display)
            try:
                simulator.wait_loaded()
                yield {"backend": "ros", "render_mode": mode}, problem(id, False, backend="ros", render_mode=mode)
            finally:
                simulator.stop()


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="", help="a part of the id")
    parser.add_argument("--backend", choices=("core", "ros"))
    parser.add_argument("--checker", choices=("gymnasium", "sb3"), default="gymnasium", help="of worlds in process")
    options = parser.parse_args(arguments)
    if not os.environ.get("DISPLAY"):
        parser.error("windows need a display: set DISPLAY (Xvfb will do)")
    ids = [id for id in gymnasium.registry if id.startswith("ambf/")]
    assert set(ids) == set(PLACES), set(ids) ^ set(PLACES)
    print("gymnasium", gymnasium.__version__)
    faults = count = 0
    master = None
    if options.backend != "core":
        import ambf_gym.over_ros
        import support

        ambf_gym.over_ros._DRAWING = 60.0  # s: windows of several programs take turns here
        print(support.machine())
        master = support.Master()
        os.environ.update(ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1")
    try:
        for id in ids:
            if options.only not in id:
                continue
            outcomes = [] if options.backend == "ros" else list(in_process(id, options.checker))
            outcomes += list(over_ros(id, master)) if master else []
            bad = [(chosen, said) for chosen, said in outcomes if said]
            print(f"{id}: {len(outcomes)} combinations, {len(bad)} faults", flush=True)
            for chosen, said in bad:
                print("   ", chosen, said, flush=True)
            faults, count = faults + len(bad), count + len(outcomes)
    finally:
        if master:
            master.kill()
    print(f"{count} combinations, {faults} faults")
    return int(faults > 0)


if __name__ == "__main__":
    sys.exit(main())
