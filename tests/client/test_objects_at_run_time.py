"""Objects come and go while a client runs: by its own requests, by others', and with their simulator."""

import pytest
import scenes
from ambf_client import Client, RequestRefused, RigidBody
from harness import eventually

CRATE = scenes.model({"Crate": scenes.box("Crate", 1.0, (2.0, 0.0, 0.0))})


def test_what_is_loaded_can_be_used_at_once_and_what_is_unloaded_is_gone(bench, client, capsys):
    added, removed = [], []
    client.on_object_added(added.append)
    client.on_object_removed(removed.append)
    loaded = client.load(text=CRATE, name_prefix="/first", pose=[0.0, 0.0, 1.0, 0.0, 0.0, 0.0])
    assert loaded.objects == ["/first/ambf/env/Crate"]
    crate = client.get_obj_handle("Crate")
    assert isinstance(crate, RigidBody)
    assert crate.position == pytest.approx([2.0, 0.0, 1.0])
    assert added == ["/first/ambf/env/Crate"]
    assert loaded.model in [model.name for model in client.list().models]
    assert client.unload(loaded.model) == ["/first/ambf/env/Crate"]
    assert removed == ["/first/ambf/env/Crate"]
    assert "/first/ambf/env/Crate" not in client.get_obj_names()
    assert client.get_obj_handle("Crate") is None
    # The handle that the script still holds serves again when the object comes back.
    client.load(text=CRATE, name_prefix="/first")
    crate.set_linear_vel(0.5, 0.0, 0.0)
    eventually(lambda: crate.linear_velocity[0] == pytest.approx(0.5))


def test_handles_and_listed_things_stand_for_their_names(bench, client):
    loaded = client.load(text=CRATE)
    assert [each.name for each in client.list(loaded).objects] == ["/ambf/env/Crate"]
    assert client.unload(loaded) == ["/ambf/env/Crate"]
    loaded = client.load(text=CRATE)
    assert client.unload(client.list().models[-1]) == ["/ambf/env/Crate"]
    client.load(text=CRATE)
    assert client.remove(client.wait_for("Crate")) == ["/ambf/env/Crate"]
    joint = next(each for each in client.list().joints if each.name.endswith("lift"))
    assert client.remove(joint) == [joint.name]
    box = next(each for each in client.list().objects if each.name.endswith("Box"))
    assert client.remove(box) == ["/ambf/env/Box"]
    kept = client.snapshot("kept")
    assert client.restore(kept).sim_step == kept.sim_step
    table = client.wait_for("Table")
    for call, wrong in (
        (client.remove, 5),
        (client.remove, client.list().models[0]),
        (client.unload, table),
        (client.unload, None),
        (client.list, 5),
        (client.snapshot, 5),
        (client.restore, table),
    ):
        with pytest.raises(TypeError, match=f"^{call.__name__} takes text"):
            call(wrong)
    with pytest.raises(TypeError):
        client.load(5)
    with pytest.raises(TypeError, match="load takes text"):
        client.load(text=CRATE, name_prefix=5)
    assert client.wait_for("Table") is table


def test_others_see_what_one_loads(bench, client):
    watcher = Client()
    watcher.connect()
    client.load(text=CRATE)
    assert watcher.wait_for("Crate", timeout=5.0).position == pytest.approx([2.0, 0.0, 0.0])
    client.remove("Crate")
    eventually(lambda: "/ambf/env/Crate" not in watcher.get_obj_names(), 20.0)
    watcher.clean_up()


def test_lists_name_models_objects_joints_and_snapshots(bench, client):
    listing = client.list()
    bodies = {o.name: o for o in listing.objects if o.kind == "rigid_body"}
    assert set(bodies) == {f"/ambf/env/{name}" for name in ("Box", "Table", "Base", "Plate", "Slide")}
    assert bodies["/ambf/env/Box"].topic == "/ambf/env/Box"
    joints = {j.name: j for j in listing.joints}
    turn = next(j for name, j in joints.items() if name.endswith("turn"))
    assert (turn.type, turn.parent, turn.child, turn.limits) == (
        "revolute",
        "/ambf/env/Base",
        "/ambf/env/Plate",
        None,
    )
    kept = client.snapshot("mine")
    assert kept.name == "mine"
    assert kept.size > 0
    assert client.list().snapshots == ["mine"]
    box = client.wait_for("Box")
    box.set_linear_vel(1.0, 0.0, 0.0)
    eventually(lambda: box.position[0] > 0.2)
    box.clear_cmd()
    assert client.restore("mine").sim_step == kept.sim_step
    eventually(lambda: box.position[0] < 0.1)
    client.forget(kept)
    assert client.list().snapshots == []
    with pytest.raises(RequestRefused, match="mine"):
        client.forget("mine")


def test_refusals_say_what_to_mend(bench, client):
    bench.allowed += ["error", "warning"]
    with pytest.raises(RequestRefused) as refused:
        client.load(text="adf version: 1.0\nbodies: [BODY A]\nBODY A: {mass: heavy}\n", check_only=True)
    assert refused.value.findings
    assert "mass" in str(refused.value)
    lid = "bodies: [BODY Lid]\njoints: [JOINT on]\nBODY Lid: {mass: 1}\n"
    lid += "JOINT on: {name: on, type: fixed, parent: BODY %s, child: BODY Lid, parent pivot: {x: 0, y: 0, z: 0}, "
    lid += "child pivot: {x: 0, y: 0, z: 0}, parent axis: {x: 0, y: 0, z: 1}, child axis: {x: 0, y: 0, z: 1}}\n"
    assert client.load(text=lid % "Box", check_only=True).objects == []
    with pytest.raises(RequestRefused, match='there is no body "BODY Bux".*BODY Box'):
        client.load(text=lid % "Bux", check_only=True)
    with pytest.raises(RequestRefused):
        client.unload("nothing of that name")
    with pytest.raises(RequestRefused):
        client.restore("never kept")


def test_a_callback_that_fails_ends_nothing(bench, client, capsys):
    seen = []
    client.on_object_added(lambda name: 1 / 0)
    client.on_object_added(seen.append)
    client.load(text=CRATE)
    assert seen == ["/ambf/env/Crate"]
    assert "ZeroDivisionError" in capsys.readouterr().err
    client.load(text=CRATE, name_prefix="/another")
    assert len(seen) == 2


def test_waiting_for_what_never_comes_says_what_there_is(bench, client):
    with pytest.raises(TimeoutError, match="/ambf/env/Table"):
        client.wait_for("Fox", timeout=0.3)


def test_many_objects_are_found_quickly_and_cost_nothing_until_used(tmp_path, master, start, ros):
    start("--launch_file", scenes.write(tmp_path, scenes.cubes(150)), "-l", "0", master_uri=master.uri)
    eventually(lambda: len(master.published()) > 150, 30.0)
    with Client() as client:
        eventually(lambda: len(client.get_obj_names()) == 153)
        assert client.get_obj_handle("Cube1") is None  # fits many
        cube = client.get_obj_handle("Cube149")
        assert cube.get_name() == "/ambf/env/Cube149"
        topics = {topic for topic, _, _ in client._objects.open_topics()}
        assert topics == {f"/ambf/env/{name}/{end}" for name in ("World", "Cube149") for end in ("State", "Command")}


def test_namespaces_tell_simulators_apart(tmp_path, master, start, ros):
    launch = scenes.write(tmp_path)
    for side in ("left", "right"):
        start("--launch_file", launch, "-l", "0", "--ns", f"/{side}", master_uri=master.uri, allowed=["WatchDog"])
    with Client(namespace="/left") as left, Client(namespace="/right/ambf") as right:
        a, b = left.wait_for("Table", 20.0), right.wait_for("Table", 20.0)
        assert (a.get_name(), b.get_name()) == ("/left/ambf/env/Table", "/right/ambf/env/Table")
        assert left.get_common_namespace().startswith("/left/")
        a.set_pos(1.0, 1.0, 1.0)
        eventually(lambda: a.position[2] == 1.0)
        assert b.position[2] == 0.0
        at = right.world.step(5).sim_step
        assert left.world.wait_for_sim_step(left.world.get_sim_step() + 50)
        assert right.world.step(0).sim_step == at


def test_launch_files_may_put_scripts_into_a_namespace(bench, script, master):
    """roslaunch sets ROS_NAMESPACE for what stands in a group; objects keep their names."""
    text = (
        "from ambf_client import Client\nwith Client() as client:\n"
        "    box = client.wait_for('Box', 10.0)\n    print('hears', box.get_name(), client.world.step(2).sim_step)\n"
    )
    listening = "from ambf_tools.cli.main import main\nprint('ends', main(['echo', 'Box', '-n', '1']))\n"
    for program, line in ((text, "hears /ambf/env/Box "), (listening, "ends 0")):
        client = script(program, master.uri, environment={"ROS_NAMESPACE": "/group"})
        assert client.finish(30.0) == 0 and line in client.text(), client.text()


def test_joints_keep_their_commands_when_others_before_them_go(bench, client):
    """Commands on topics and with steps go by place in the list of joints, which gets shorter."""
    sides = {"left": (0.0, 3.0, 0.5), "right": (0.0, 4.0, 0.5)}
    bodies = {"Post": scenes.box("Post", 0.0, (0.0, 3.0, 0.0))}
    bodies |= {name: scenes.box(name, 1.0, place) for name, place in sides.items()}
    gains = "  controller: {P: 20.0, I: 0.0, D: 1.0}\n"
    joints = {
        f"turn_{name}": scenes.joint(f"turn_{name}", "revolute", "Post", name, (0.0, y - 3.0, z), gains)
        for name, (_, y, z) in sides.items()
    }
    client.load(text=scenes.model(bodies, joints))
    post = client.wait_for("Post")
    post.set_joint_pos({"turn_left": 0.7, "turn_right": -0.2})
    eventually(lambda: post.get_joint_pos("turn_right") == pytest.approx(-0.2, abs=0.01), 10.0, "they have moved")
    left = next(each for each in client.list().joints if each.name.endswith("turn_left"))
    client.remove(left)  # no message goes by the places of before
    assert post.get_joint_names() == ["turn_right"]
    until = post.get_sim_time() + 0.3
    while post.get_sim_time() < until:
        assert post.get_joint_pos("turn_right") == pytest.approx(-0.2, abs=0.05)
    assert post.get_joint_command("turn_right") == ("position", pytest.approx(-0.2))
    client.world.step(300)
    assert post.get_joint_pos("turn_right") == pytest.approx(-0.2, abs=0.02)
