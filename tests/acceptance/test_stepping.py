"""Clients that drive the simulation step by step: throttling by WorldCmd, the Step service, resets, snapshots."""

import io
import random
import time

import pytest
import scenes
from geometry_msgs.msg import Vector3, Wrench
from harness import eventually
from std_msgs.msg import Empty

from ambf_msgs.msg import RigidBodyCmd, RigidBodyState, WorldCmd, WorldRates, WorldState
from ambf_msgs.srv import List, Restore, Snapshot, Step


def size_of(message):
    buffer = io.BytesIO()
    message.serialize(buffer)
    return len(buffer.getvalue())


class Throttle:
    """Toggles the step clock as the original's client does."""

    def __init__(self, ros):
        self.state = ros.listen("/ambf/env/World/State", WorldState)
        self.talk = ros.talk("/ambf/env/World/Command", WorldCmd)
        self.clock = False

    def engage(self):
        self.talk.publish(WorldCmd(True, self.clock, 1))
        time.sleep(0.1)
        return self.settled()

    def settled(self):
        """The step at which it waits."""
        at = self.state.next().sim_step
        assert self.state.next().sim_step == at, "it does not wait"
        return at

    def toggle(self, steps):
        self.clock = not self.clock
        self.talk.publish(WorldCmd(True, self.clock, steps))

    def release(self):
        self.talk.publish(WorldCmd(False, self.clock, 1))


def test_each_toggle_runs_its_steps_and_is_shown_at_once(bench, ros):
    throttle = Throttle(ros)
    at = throttle.engage()
    for steps in (1, 7, 50, 100):
        throttle.toggle(steps)
        at += steps
        # Shown when it is done, not when the next heartbeat is due.
        throttle.state.next(lambda m, a=at: m.sim_step == a, 2.0, f"step {at}")
    assert throttle.settled() == at


def test_a_thousand_toggles_at_random_times_are_all_run(bench, ros):
    random_ = random.Random(1)
    throttle = Throttle(ros)
    at = throttle.engage()
    granted = 0
    for _ in range(1000):
        steps = random_.randrange(1, 6)
        granted += steps
        throttle.toggle(steps)
        if random_.random() < 0.3:
            time.sleep(random_.random() * 0.004)
        if random_.random() < 0.1:  # the same level again is no toggle
            throttle.talk.publish(WorldCmd(True, throttle.clock, 90))
    eventually(lambda: throttle.state.messages[-1].sim_step == at + granted, 20.0, f"{granted} steps")
    assert throttle.settled() == at + granted


def test_a_silent_client_keeps_the_simulation_waiting_and_another_takes_over(bench, ros):
    throttle = Throttle(ros)
    at = throttle.engage()
    throttle.toggle(3)
    time.sleep(1.2)  # the original ran away after 0.5 s
    assert throttle.settled() == at + 3
    bench.wait_log("the client that throttles it is silent")
    # Another node, whose clock starts low as they all do.
    import subprocess
    import sys

    program = """
import rospy, time
from ambf_msgs.msg import WorldCmd
rospy.init_node("other", anonymous=True, disable_signals=True, disable_rosout=True)
talk = rospy.Publisher("/ambf/env/World/Command", WorldCmd, queue_size=10)
while talk.get_num_connections() == 0: time.sleep(0.01)
for clock in (False, True): talk.publish(WorldCmd(True, clock, 4))
time.sleep(0.5)
"""
    subprocess.run([sys.executable, "-c", program], check=True, timeout=60)
    eventually(lambda: throttle.state.messages[-1].sim_step == at + 7, 5.0, "the other's toggle is run")
    throttle.release()
    throttle.state.next(lambda m: m.sim_step > at + 100, what="released")


def test_the_step_service_answers_with_that_very_step(bench, ros):
    step = ros.service("/ambf/env/World/Step", Step)
    first = step(n=0)
    assert first.success
    at = first.sim_step
    push = RigidBodyCmd(wrench=Wrench(Vector3(2.0, 0.0, 0.0), Vector3()))
    speed = None
    for i in range(20):
        answer = step(n=5, rigid_body_names=["/ambf/env/Box"], rigid_body_cmds=[push], wanted_states=["/ambf/env/Box"])
        at += 5
        assert answer.success, answer.message
        assert (answer.sim_step, answer.world.sim_step) == (at, at)
        assert answer.sim_time == pytest.approx(at * 0.001)
        box = answer.rigid_bodies[0]
        assert box.sim_step == at
        assert list(answer.state_sizes) == [size_of(answer.world), size_of(box)]
        assert box.twist.linear.x == pytest.approx((i + 1) * 5 * 0.001 * 1.0, rel=1e-3)
        assert box.twist.linear.x != speed
        speed = box.twist.linear.x
    time.sleep(0.3)
    assert step(n=0).sim_step == at  # it waits meanwhile


def test_the_step_service_refuses_what_is_wrong_with_it(bench, ros):
    bench.allowed.append("command to '/ambf/env/World/Step' refused")
    step = ros.service("/ambf/env/World/Step", Step)
    at = step(n=0).sim_step
    lengths = step(n=1, rigid_body_names=["/ambf/env/Box"])
    unknown = step(n=1, rigid_body_names=["/ambf/env/Fox"], rigid_body_cmds=[RigidBodyCmd()])
    broken = step(
        n=1,
        rigid_body_names=["/ambf/env/Box"],
        rigid_body_cmds=[RigidBodyCmd(wrench=Wrench(Vector3(float("nan"), 0, 0), Vector3()))],
    )
    assert [answer.success for answer in (lengths, unknown, broken)] == [False] * 3
    assert "as long as" in lengths.message
    assert "Fox" in unknown.message
    assert "finite" in broken.message
    assert step(n=0).sim_step == at


def test_reset_brings_back_poses_and_time(bench, ros):
    box = ros.listen("/ambf/env/Box/State", RigidBodyState)
    world = ros.listen("/ambf/env/World/State", WorldState)
    rates = ros.listen("/ambf/env/World/Rates", WorldRates)
    talk = ros.talk("/ambf/env/Box/Command", RigidBodyCmd)
    talk.publish(RigidBodyCmd(wrench=Wrench(Vector3(20.0, 0.0, 0.0), Vector3())))
    box.next(lambda m: m.pose.position.x > 0.2)
    epoch = rates.last().epoch
    later = box.last().sim_step + 700
    moved = box.next(lambda m: m.sim_step > later)  # its command has expired
    ros.talk("/ambf/env/World/Command/Reset/Bodies", Empty).publish(Empty())
    back = box.next(lambda m: abs(m.pose.position.x) < 1e-6)
    assert back.sim_step > moved.sim_step  # time goes on
    assert back.twist.linear.x == pytest.approx(0.0, abs=1e-9)

    talk.publish(RigidBodyCmd(wrench=Wrench(Vector3(20.0, 0.0, 0.0), Vector3())))
    moved = box.next(lambda m: m.pose.position.x > 0.2)
    ros.talk("/ambf/env/World/Command/Reset", Empty).publish(Empty())
    restarted = world.next(lambda m: m.sim_step < moved.sim_step)
    assert restarted.sim_time < moved.sim_time
    assert box.next(lambda m: m.sim_step < moved.sim_step).pose.position.x == pytest.approx(0.0, abs=1e-6)
    assert rates.next(lambda m: m.epoch > epoch)


def test_restoring_a_snapshot_repeats_what_followed_it(bench, ros, tmp_path):
    step = ros.service("/ambf/env/World/Step", Step)
    push = RigidBodyCmd(wrench=Wrench(Vector3(2.0, 1.0, 0.0), Vector3(0.0, 0.0, 0.01)))

    def go_on():
        answers = []
        for n in (1, 10, 100):
            answers.append(
                step(n=n, rigid_body_names=["/ambf/env/Box"], rigid_body_cmds=[push], wanted_states=["/ambf/env/Box"])
            )
        return [(a.sim_step, a.rigid_bodies[0].pose, a.rigid_bodies[0].twist) for a in answers]

    step(n=50, rigid_body_names=["/ambf/env/Box"], rigid_body_cmds=[push])
    file = tmp_path / "kept.state"
    kept = ros.service("/ambf/env/World/Snapshot", Snapshot)(name="here", path=str(file))
    assert kept.success, kept.message
    assert file.stat().st_size == kept.size > 0
    first = go_on()
    restore = ros.service("/ambf/env/World/Restore", Restore)
    back = restore(name="here", path="")
    assert back.success, back.message
    assert back.sim_step == kept.sim_step
    assert go_on() == first
    assert restore(name="", path=str(file)).success
    assert go_on() == first
    assert not restore(name="nowhere", path="").success


def test_a_snapshot_whose_file_cannot_be_written_is_not_kept(bench, ros, tmp_path):
    snapshot = ros.service("/ambf/env/World/Snapshot", Snapshot)
    assert snapshot(name="here", path="").success
    lost = snapshot(name="there", path=str(tmp_path / "no" / "such" / "folder" / "file.state"))
    assert not lost.success
    assert "file.state" in lost.message
    assert list(ros.service("/ambf/env/World/List", List)("").snapshots) == ["here"]


def test_states_that_are_not_there_are_named(bench, ros):
    step = ros.service("/ambf/env/World/Step", Step)
    answer = step(n=1, wanted_states=["/ambf/env/Box", "nobody"])
    assert answer.success
    assert len(answer.rigid_bodies) == 1
    assert [d.message for d in answer.diagnostics] == ["there is no object 'nobody': its state is missing"]


def test_the_release_of_silent_clients_can_be_asked_for(tmp_path, master, start, ros):
    start(
        *("--launch_file", scenes.write(tmp_path), "-l", "0", "--release_silent_throttle", "true"),
        master_uri=master.uri,
        allowed=["WatchDog"],
    )
    throttle = Throttle(ros)
    throttle.talk.publish(WorldCmd(True, False, 1))
    throttle.state.next(lambda m: throttle.state.messages[-2].sim_step == m.sim_step, what="it waits")
    at = throttle.state.last().sim_step
    throttle.state.next(lambda m: m.sim_step > at + 200, what="half a second later it runs again")
