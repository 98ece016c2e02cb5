"""Topics and services of any type: ambf-cli topics, publish, call."""

import json
import re

from harness import eventually


def test_topics_are_listed_with_types(bench, cli):
    text = cli("topics", "Box").stdout
    assert re.search(r"/ambf/env/Box/State +ambf_msgs/RigidBodyState +1 +\d", text)
    listed = json.loads(cli("topics", "*/Command", "--json").stdout)
    assert {each["name"]: each["listeners"] for each in listed}["/ambf/env/Box/Command"] == 1
    services = {each["name"]: each for each in json.loads(cli("topics", "--services", "--json").stdout)}
    assert services["/ambf/env/World/List"]["type"] == "ambf_msgs/List" and services["/ambf/env/World/List"]["ours"]


def test_a_message_is_published_from_the_shell(bench, cli):
    state = lambda: json.loads(cli("info", "Box", "--json").stdout)["state"]["pose"]["position"]["z"]  # noqa: E731
    low = state()
    yaml = "{cartesian_cmd_type: 1, pose: {position: {x: 0, y: 1, z: 2}, orientation: {w: 1}}}"
    said = cli("publish", "Box/Command", yaml, "--rate", 200, "--for", 1.0).stdout
    assert "/ambf/env/Box/Command: published " in said
    count = int(said.split("published ")[1].split()[0])
    assert 50 <= count <= 220
    eventually(lambda: state() > low + 0.1, 10.0, "the box is above where it was")
    assert "published to 1 listener" in cli("publish", "Box/Command", "{}").stdout
    assert (
        "cartesian_cmd_type must"
        in cli("publish", "Box/Command", "--rate", 9, "{cartesian_cmd_type: a}", code=1).stderr
    )


def test_what_cannot_be_published_is_said(bench, cli):
    assert "field cartesian_cmd_type must be" in cli("publish", "Box/Command", "{cartesian_cmd_type: a}", code=1).stderr
    assert (
        "is of type ambf_msgs/RigidBodyCmd" in cli("publish", "Box/Command", "--type", "std_msgs/Empty", code=1).stderr
    )
    assert "give it by --type" in cli("publish", "/nobody", code=2).stderr
    assert "is the Python package no_such installed?" in cli("publish", "/n", "--type", "no_such/Thing", code=1).stderr
    assert "'/a b' is no name of a topic" in cli("publish", "/a b", "--type", "std_msgs/Empty", code=1).stderr
    assert "unrecognized arguments: b c" in cli("publish", "/a", "--rate", 9, "b", "c", code=2).stderr
    assert "fits several topics" in cli("publish", "Command", code=1).stderr
    assert "neither 0 nor between 0.001 and 1000" in cli("publish", "Box/Command", "--rate", "1e9", code=2).stderr


def test_a_service_is_called_from_the_shell(bench, cli):
    answer = json.loads(cli("call", "World/Step", "--json", "{n: 5}").stdout)
    assert answer["success"] and answer["sim_step"] > 0
    assert "n: 0" in cli("call", "World/Step", "--template").stdout
    assert "there is no service World/Nothing" in cli("call", "World/Nothing", code=1).stderr
    assert "field n must be" in cli("call", "World/Step", "{n: many}", code=1).stderr


def test_a_service_that_refuses_is_a_failure(bench, cli):
    bench.allowed.append("/nowhere.yaml: error")
    refused = cli("call", "World/Load", "{path: /nowhere.yaml}", code=1)
    assert "success: False" in refused.stdout, "its answer is printed all the same"
    assert "/ambf/env/World/Load refused: " in refused.stderr and "nowhere.yaml" in refused.stderr
    answer = json.loads(cli("call", "World/Load", "--json", "{path: /nowhere.yaml}", code=1).stdout)
    assert not answer["success"] and answer["diagnostics"][0]["severity"] == 2
