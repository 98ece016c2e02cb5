"""Models come and go while the simulation runs, and their topics with them (dissertation Fig. 4.12)."""

import re
from pathlib import Path

import pytest
import scenes
from geometry_msgs.msg import Point, Pose, Quaternion
from harness import eventually

from ambf_msgs.msg import Diagnostic, RigidBodyCmd, RigidBodyState
from ambf_msgs.srv import List, Load, Remove, Unload

NO_POSE = Pose(Point(), Quaternion(0, 0, 0, 0))


@pytest.fixture
def services(bench, ros):
    def call(kind, **request):
        return ros.service(f"/ambf/env/World/{kind.__name__}", kind)(**request)

    return call


@pytest.fixture
def two_boxes(tmp_path):
    file = tmp_path / "two.yaml"
    file.write_text(
        scenes.model(
            {"Left": scenes.box("Left", 1.0, (0.0, 3.0, 0.0)), "Right": scenes.box("Right", 1.0, (0.0, 4.0, 0.0))},
            {"weld": scenes.joint("weld", "fixed", "Left", "Right", (0.0, 1.0, 0.0))},
        )
    )
    return file


def test_memory_that_a_model_needed_is_given_back(bench, services):
    def megabytes():
        status = Path(f"/proc/{bench.pid}/status").read_text()
        return int(re.search(r"VmRSS:\s+(\d+)", status).group(1)) / 1024

    before = megabytes()
    crowd = scenes.cubes(400, namespace="/crowd/")
    loaded = services(Load, path="", text=crowd, name_prefix="", pose=NO_POSE, check_only=False)
    assert loaded.success, loaded.message
    held = megabytes()
    assert held > before + 6.0
    assert services(Unload, model=loaded.model).success
    eventually(lambda: megabytes() < held - 0.3 * (held - before), 20.0, "memory falls")


def test_topics_follow_models(master, services, ros, two_boxes):
    before = master.names()
    loaded = services(
        Load,
        path=str(two_boxes),
        text="",
        name_prefix="",
        pose=Pose(Point(0, 0, 2), Quaternion(0, 0, 0, 1)),
        check_only=False,
    )
    assert loaded.success, loaded.message
    assert sorted(loaded.objects) == ["/ambf/env/Left", "/ambf/env/Right"]
    assert len(loaded.joints) == 1
    topics = {f"{name}/{end}" for name in loaded.objects for end in ("State", "Command")}
    eventually(lambda: master.names() == before | topics, 5.0, "the new topics")
    assert ros.listen("/ambf/env/Left/State", RigidBodyState).last().pose.position.z == pytest.approx(2.0, abs=1e-3)

    # The same file again gets numbers, on ROS too.
    again = services(Load, path=str(two_boxes), text="", name_prefix="", pose=NO_POSE, check_only=False)
    assert sorted(again.objects) == ["/ambf/env/Left1", "/ambf/env/Right1"]
    assert again.model != loaded.model
    eventually(lambda: "/ambf/env/Right1/State" in master.published(), 5.0, "topics with numbers")
    ros.talk("/ambf/env/Left1/Command", RigidBodyCmd)

    removed = services(Unload, model=loaded.model)
    assert removed.success, removed.message
    assert {"/ambf/env/Left", "/ambf/env/Right"} <= set(removed.removed)
    eventually(lambda: not topics & master.names(), 5.0, "the topics are gone")
    assert "/ambf/env/Left1/State" in master.published()
    # A name that is free again is given again.
    third = services(Load, path=str(two_boxes), text="", name_prefix="", pose=NO_POSE, check_only=False)
    assert sorted(third.objects) == ["/ambf/env/Left", "/ambf/env/Right"]
    eventually(lambda: topics <= master.names(), 5.0, "and its topics, too")
    state = ros.listen("/ambf/env/Left/State", RigidBodyState)
    ros.talk("/ambf/env/Left/Command", RigidBodyCmd).publish(RigidBodyCmd(publish_children_names=True))
    assert state.next(lambda m: m.children_names)


def test_single_objects_can_be_removed(bench, master, services, ros):
    bench.allowed.append("Nobody.* names no object")
    base = ros.listen("/ambf/env/Base/State", RigidBodyState)
    assert base.last().joint_names == ["turn", "lift"]
    gone = services(Remove, name="/ambf/env/Slide")
    assert gone.success, gone.message
    assert "/ambf/env/Slide" in gone.removed
    eventually(lambda: not any("Slide" in name for name in master.names()), 5.0, "its topics are gone")
    base.next(lambda m: m.joint_names == ["turn"] and len(m.joint_positions) == 1)
    joint = services(List, model="").joints[0].name
    assert services(Remove, name=joint).success
    base.next(lambda m: m.joint_names == [])
    assert not services(Remove, name="/ambf/env/Nobody").success


def test_text_prefix_and_lists(services):
    text = scenes.model({"Extra": scenes.box("Extra", 1.0, (0.0, 5.0, 0.0))})
    loaded = services(Load, path="", text=text, name_prefix="/second/", pose=NO_POSE, check_only=False)
    assert loaded.success, loaded.message
    assert [name.startswith("/second/") for name in loaded.objects] == [True]
    listing = services(List, model="")
    models = {model.name: model for model in listing.models}
    assert models[loaded.model].objects == loaded.objects
    entry = next(o for o in listing.objects if o.name == loaded.objects[0])
    assert (entry.kind, entry.model, entry.topic) == ("rigid_body", loaded.model, loaded.objects[0])
    turn = next(j for j in listing.joints if j.name.endswith("turn"))
    assert turn.type == "revolute"
    assert turn.parent == "/ambf/env/Base" and turn.child == "/ambf/env/Plate"
    only = services(List, model=loaded.model)
    assert [o.name for o in only.objects] == loaded.objects


def test_what_is_wrong_with_a_file_is_told_and_nothing_changes(bench, master, services, tmp_path):
    bench.allowed += [r"broken\.yaml", r"refused", r"there is no model"]
    before = services(List, model="").structure_version
    file = tmp_path / "broken.yaml"
    file.write_text("adf version: 1.0\nbodies: [BODY A\n")
    answer = services(Load, path=str(file), text="", name_prefix="", pose=NO_POSE, check_only=False)
    assert not answer.success
    errors = [d for d in answer.diagnostics if d.severity == Diagnostic.ERROR]
    assert errors and errors[0].file.endswith("broken.yaml") and errors[0].line > 0
    bad_pose = services(
        Load,
        path=str(file),
        text="",
        name_prefix="",
        pose=Pose(Point(float("nan"), 0, 0), Quaternion(0, 0, 0, 1)),
        check_only=False,
    )
    assert not bad_pose.success
    assert not services(Unload, model="nothing of that name").success
    assert services(List, model="").structure_version == before


def test_check_only_loads_nothing(master, services, two_boxes):
    before = master.names()
    assert services(Load, path=str(two_boxes), text="", name_prefix="", pose=NO_POSE, check_only=True).success
    assert "/ambf/env/Left" not in {o.name for o in services(List, model="").objects}
    assert master.names() == before


def test_check_only_says_what_loading_would(bench, services, tmp_path):
    bench.allowed += [r"launch file", r"refused"]
    text = (
        "namespace: /t/\nbodies: [BODY A]\n"
        "BODY A: {name: A, mass: 0.01, controller output type: FORCE, controller: {linear: {P: 1, D: 100}}}\n"
    )
    checked = services(Load, path="", text=text, name_prefix="", pose=NO_POSE, check_only=True)
    assert checked.success
    assert any("gains cannot be stable" in d.message for d in checked.diagnostics), checked

    (tmp_path / "start.yaml").write_text("world config: world.yaml\nmultibody configs: []\n")
    before = services(List, model="").structure_version
    refused = services(Load, path=str(tmp_path / "start.yaml"), text="", name_prefix="", pose=NO_POSE, check_only=False)
    assert not refused.success
    assert [("launch file" in d.message, "--launch_file" in d.hint) for d in refused.diagnostics] == [(True, True)]
    assert services(List, model="").structure_version == before


def test_check_only_looks_at_what_is_in_the_world(bench, services):
    def checked(text, prefix=""):
        return services(Load, path="", text=text, name_prefix=prefix, pose=NO_POSE, check_only=True)

    lid = (
        "namespace: /ambf/env/\nbodies: [BODY Lid]\njoints: [JOINT shuts]\n"
        "BODY Lid: {name: Lid, mass: 0.1}\n"
        "JOINT shuts: {name: shuts, type: revolute, parent: BODY %s, child: BODY Lid, "
        "parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: 0, y: 0, z: 0}, "
        "parent axis: {x: 1, y: 0, z: 0}, child axis: {x: 1, y: 0, z: 0}}\n"
    )
    before = services(List, model="").structure_version
    there = checked(lid % "Plate")
    assert there.success and not [d for d in there.diagnostics if d.severity > Diagnostic.INFORMATION], there
    absent = checked(lid % "Plote")
    assert not absent.success
    (told,) = (d for d in absent.diagnostics if d.severity == Diagnostic.ERROR)
    assert 'there is no body "BODY Plote"' in told.message and "BODY Plate" in told.hint
    again = "namespace: /ambf/env/\nbodies: [BODY Plate]\nBODY Plate: {name: Plate, mass: 1}\n"
    assert any("is there already" in d.message for d in checked(again).diagnostics)
    assert not any("is there already" in d.message for d in checked(again, "/second").diagnostics)
    assert services(List, model="").structure_version == before
