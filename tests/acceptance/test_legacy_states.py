"""Programs built against the messages of AMBF 1.0 or 3.0 beside programs built against ours (`--legacy-states`)."""

import scenes
from genpy.dynamic import generate_dynamic
from harness import eventually

from ambf_msgs.msg import RigidBodyState, WorldState

BOX = "/ambf/env/Cube001/State"
# As published in the original's repository: md5 of what such a program was built with.
OLD_BODY = "938fed649678cd6a0eb81e5478b1f5e2"
OLD_WORLD = "19e71cae5899074bfba211b483c66a1f"


def old_class(kind, left_out):
    """The message class that an old program has, from today's definition without what came later."""
    text = "\n".join(line for line in kind._full_text.splitlines() if not line.startswith(left_out))
    return generate_dynamic(kind._type, text)[kind._type]


def test_old_and_new_programs_each_hear_the_states_they_know(tmp_path, start, master, ros):
    body = old_class(RigidBodyState, "std_msgs/String identifier")
    world = old_class(WorldState, "uint64 graphics_loop_freq")
    assert (body._md5sum, world._md5sum) == (OLD_BODY, OLD_WORLD)
    launch = scenes.write(tmp_path, scenes.cubes(2))
    # Each publisher turns away those who ask for the other's type, and says so.
    start("--launch_file", launch, "-l", "0", "--legacy-states", "g2", master_uri=master.uri, allowed=[r"md5sum"])
    eventually(lambda: BOX in master.published(), 20.0, f"{BOX} in {master.published()}")

    old = ros.listen(BOX, body)
    old_world = ros.listen("/ambf/env/World/State", world)
    state = old.next(lambda message: message.sim_step > 10, 20.0, "a state for old programs")
    assert state.name.data.endswith("Cube001")
    assert not hasattr(state, "identifier")
    assert state.mass == 1.0
    assert abs(state.pose.position.x - 0.3) < 1e-6
    old_world.next(lambda message: message.dynamic_loop_freq > 0, 20.0, "the world's rate")
    old.unregister()

    new = ros.listen(BOX, RigidBodyState)
    assert new.next(lambda message: message.sim_step > 10, 20.0, "a state for new programs").identifier.data


def test_programs_of_the_third_release_hear_their_inertia(tmp_path, start, master, ros):
    text = RigidBodyState._full_text.replace("pInertia", "p_inertia")
    body = generate_dynamic(RigidBodyState._type, text)[RigidBodyState._type]
    assert body._md5sum == "201be33698a79d982715e2a5a3814805"
    launch = scenes.write(tmp_path, scenes.cubes(2))
    start("--launch_file", launch, "-l", "0", "--legacy-states", "g4", master_uri=master.uri, allowed=[r"md5sum"])
    eventually(lambda: BOX in master.published(), 20.0, f"{BOX} in {master.published()}")
    theirs = ros.listen(BOX, body).next(lambda message: message.sim_step > 10, 20.0, "a state for 3.0")
    assert theirs.identifier.data
    assert theirs.p_inertia.x > 0.0
    ros.close()
    ours = ros.listen(BOX, RigidBodyState).next(lambda message: message.sim_step > 10, 20.0, "a state for 2.0")
    assert ours.pInertia.x == theirs.p_inertia.x


def test_the_relay_ends_with_the_simulator(tmp_path, start, own_master):
    launch = scenes.write(tmp_path, scenes.cubes(1))
    simulator = start(
        *("--launch_file", launch, "-l", "0", "--legacy-states", "g2"),
        master_uri=own_master.uri,
        allowed=["contact master"],  # roscpp, of a busy one that answers at its next try
    )

    def relays():
        return {n for nodes in own_master.state()[0].values() for n in nodes if n.startswith("/ambf_legacy_states")}

    eventually(relays, 20.0, "the relay publishes")
    simulator.stop()
    eventually(lambda: not relays(), 10.0, "the relay is gone")
