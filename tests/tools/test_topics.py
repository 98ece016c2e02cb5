"""Topics and services of any type: ambf-cli topics, publish, call, and ambf-cli serve, which the panel uses."""

import contextlib
import json
import os
import re
import signal
import subprocess
import sys
import threading
import time

import pytest
from harness import ROOT, eventually
from message_rows import value


@pytest.fixture
def cli(run_python):
    """cli(*words, code=0): what `ambf-cli words...` printed."""

    def run(*words, code=0, **more):
        return run_python("-m", "ambf_tools.cli", *words, code=code, **more)

    return run


class Serving:
    """`ambf-cli serve`, talked to as the simulator does."""

    def __init__(self, master_uri, simulator=0):
        path = os.pathsep.join([str(ROOT / "ambf_client_py"), os.environ.get("PYTHONPATH", "")])
        self.process = subprocess.Popen(
            # As what a script starts in the background: it hears SIGINT all the same.
            [
                "env",
                "--ignore-signal=INT",
                sys.executable,
                "-m",
                "ambf_tools.cli",
                "serve",
                "--simulator",
                str(simulator),
            ],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            bufsize=1,
            env=dict(os.environ, PYTHONPATH=path, ROS_MASTER_URI=master_uri, ROS_IP="127.0.0.1"),
        )
        self.events = []
        self._last_id = 0
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        for line in self.process.stdout:
            self.events.append(json.loads(line))  # nothing but JSON may come

    def say(self, **request):
        with contextlib.suppress(BrokenPipeError):
            self.process.stdin.write(json.dumps(request) + "\n")

    def ask(self, **request):
        """The answer to a request."""
        self._last_id += 1
        number = self._last_id
        self.say(id=number, **request)
        return self.wait(lambda e: e["event"] == "answer" and e["id"] == number, f"the answer to {request}")

    def wait(self, condition, what, since=0):
        """The newest event that fits, once there is one."""
        return eventually(lambda: next((e for e in reversed(self.events[since:]) if condition(e)), None), 20.0, what)

    def message(self, topic, condition=lambda event: True, since=0):
        return self.wait(lambda e: e["event"] == "message" and e["topic"] == topic and condition(e), topic, since)

    def end(self):
        self.process.kill()
        self.process.wait()


@pytest.fixture
def serve(master):
    """serve(...): such a program, ended with the test."""
    made = []

    def start(master_uri=master.uri, **options):
        made.append(Serving(master_uri, **options))
        return made[-1]

    yield start
    for each in made:
        each.end()


# --- verbs -----------------------------------------------------------------------------------------------------------


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


# --- what the panel uses ---------------------------------------------------------------------------------------------


def test_a_panel_hears_what_there_is_ours_first(bench, serve, ros):
    import rospy
    from std_msgs.msg import String

    other = rospy.Publisher("/aaa_other", String, queue_size=1)
    serving = serve(simulator=bench.process.pid)
    listed = serving.wait(
        lambda e: e["event"] == "list" and any(s[1] == "ambf_msgs/Step" for s in e["services"]), "services with types"
    )
    names = [name for name, *_ in listed["topics"]]
    ours = {name: is_ours for name, _, _, _, is_ours in listed["topics"]}
    assert ours["/ambf/env/Box/State"] and not ours["/aaa_other"]
    assert names.index("/aaa_other") > names.index("/ambf/env/World/State")
    box = next(each for each in listed["topics"] if each[0] == "/ambf/env/Box/State")
    assert [box[1], box[2], box[4]] == ["ambf_msgs/RigidBodyState", 1, True]
    watching = serve()
    watching.say(do="watch", topics=["/ambf/env/Box/State"])
    watching.message("/ambf/env/Box/State")
    time.sleep(2.5)
    assert box in serving.events[-1].get("topics", listed["topics"]), "who looks is no listener"
    before = len(serving.events)
    other.unregister()
    serving.wait(lambda e: e["event"] == "list" and "/aaa_other" not in str(e), "it is gone from the list", before)


def test_a_topic_is_watched_slowly_however_fast_it_comes(bench, serve):
    serving = serve()
    serving.say(do="watch", topics=["/ambf/env/Box/State"])
    first = serving.message("/ambf/env/Box/State", lambda e: e["rate"] > 0)
    assert first["type"] == "ambf_msgs/RigidBodyState" and "error" not in first
    assert value(first["rows"], "name") == "Box", "a std_msgs/String is its text"
    assert value(first["rows"], "pose", "position").startswith("x ")
    before, begin = len(serving.events), time.monotonic()
    time.sleep(1.5)
    events = [e for e in serving.events[before:] if e["event"] == "message"]
    shown = len(events) / (time.monotonic() - begin)
    came = (events[-1]["count"] - events[0]["count"]) / len(events)
    assert shown < 11.0 and came > 3.0, f"{shown} a second are shown, each the last of {came}"
    serving.say(do="watch", topics=[])
    time.sleep(0.5)
    before = len(serving.events)
    time.sleep(0.5)
    assert not [e for e in serving.events[before:] if e["event"] == "message"]


def test_a_type_that_is_not_installed_is_watched_by_what_its_sender_says_of_it(master, serve, ros):
    import genpy.dynamic
    import rospy

    definition = "float64 left\nuint8[] bytes\nPart part\n" + "=" * 80 + "\nMSG: alien_msgs/Part\nstring word\n"
    kinds = genpy.dynamic.generate_dynamic("alien_msgs/Thing", definition)
    publisher = rospy.Publisher("/alien", kinds["alien_msgs/Thing"], queue_size=1, latch=True)
    message = kinds["alien_msgs/Thing"](left=2.5, bytes=b"\x01\x02")
    message.part.word = "hello"
    publisher.publish(message)
    serving = serve()
    serving.say(do="watch", topics=["/alien"])
    rows = serving.message("/alien")["rows"]
    assert value(rows, "left") == "2.5" and value(rows, "part") == "word hello" and value(rows, "bytes") == "1, 2"
    answer = serving.ask(do="template", name="/alien")
    assert "alien_msgs/Thing is not known here" in answer["error"]
    publisher.unregister()


def test_publishing_and_calling_are_answered(bench, serve, ros):
    import rospy
    from std_msgs.msg import Float64

    heard = []
    subscriber = rospy.Subscriber("/listened", Float64, lambda message: heard.append(message.data))
    serving = serve()
    assert serving.ask(do="template", name="/listened")["text"] == "data: 0.0\n"
    publish = {"do": "publish", "topic": "/listened", "type": "std_msgs/Float64"}
    assert serving.ask(**publish, text="data: 4.5", rate=0)["text"] == "published to 1 listener"
    eventually(lambda: heard == [4.5], 5.0, "published once")
    assert serving.ask(**publish, text="data: 7", rate=50)["text"] == "publishing at 50 Hz"
    eventually(lambda: heard.count(7.0) > 10, 10.0, "again and again")
    serving.wait(
        lambda e: e["event"] == "publishing" and e["topics"][:1] and e["topics"][0]["rate"] == 50, "it is told"
    )
    assert serving.ask(do="stop", topic="/listened")["text"] == "no longer published"
    time.sleep(0.3)
    count = len(heard)
    time.sleep(0.3)
    assert len(heard) == count
    for wrong, told in (
        ({"text": "{data: x}"}, "must be float"),
        ({"text": "{"}, "not YAML"),
        ({"type": "std_msgs/String", "text": ""}, "is of type std_msgs/Float64"),
        ({"type": "nonsense", "text": ""}, "is no message type"),
        ({"rate": 1e9, "text": ""}, "from 0 to 1000 Hz"),
    ):
        assert told in serving.ask(**{**publish, **wrong})["error"]
    answer = serving.ask(do="call", service="/ambf/env/World/Step", text="n: 3")
    assert value(answer["rows"], "success") == "true"
    assert "there is no service /no" in serving.ask(do="call", service="/no", text="")["error"]
    assert "no such request" in serving.ask(do="dance")["error"]
    assert serving.ask(do="template", name="/ambf/env/World/Step", service=True)["text"].startswith("n: 0")
    subscriber.unregister()


def test_a_service_that_fails_is_told_and_a_slow_one_holds_up_nothing(master, serve, ros):
    import rospy

    from ambf_msgs.srv import Step, StepResponse

    go = threading.Event()

    def wait(_):
        go.wait(20.0)
        return StepResponse(success=True)

    slow = rospy.Service("/slow", Step, wait)
    broken = rospy.Service("/broken", Step, lambda _: 1 / 0)
    serving = serve()
    serving.say(do="call", id=1000, service="/slow", text="")
    assert "/broken failed" in serving.ask(do="call", service="/broken", text="")["error"]
    assert not [e for e in serving.events if e.get("id") == 1000]
    go.set()
    serving.wait(lambda e: e["event"] == "answer" and e["id"] == 1000 and ["success", "true"] in e["rows"], "slow")
    slow.shutdown()
    broken.shutdown()


def test_a_master_that_goes_and_comes_back_is_told_and_watching_goes_on(own_master, serve, run_python):
    serving = serve(own_master.uri)
    serving.wait(lambda e: e["event"] == "master" and e["alive"], "the master")
    serving.say(do="watch", topics=["/word"])
    environment = dict(os.environ, ROS_MASTER_URI=own_master.uri, ROS_IP="127.0.0.1")
    program = "import rospy, std_msgs.msg as m, time\nrospy.init_node('w', anonymous=True)\np = rospy.Publisher('/word', m.String, queue_size=1)\nwhile 1:\n p.publish('hi')\n time.sleep(0.05)\n"  # noqa: E501
    first = subprocess.Popen([sys.executable, "-c", program], env=environment)
    try:
        assert value(serving.message("/word")["rows"], "data") == "hi"
        own_master.kill()
        serving.wait(lambda e: e["event"] == "master" and not e["alive"], "the master is gone")
        assert "no ROS master answers" in serving.ask(do="call", service="/any", text="")["error"]
    finally:
        first.kill()
        first.wait()
    before = len(serving.events)
    own_master.start()
    serving.wait(lambda e: e["event"] == "master" and e["alive"], "the master is back", before)
    before = len(serving.events)
    second = subprocess.Popen([sys.executable, "-c", program], env=environment)
    try:
        serving.message("/word", since=before)
    finally:
        second.kill()
        second.wait()


def test_without_a_master_it_says_so_and_waits(own_master, serve):
    own_master.kill()
    serving = serve(own_master.uri)
    told = serving.wait(lambda e: e["event"] == "master", "whether there is a master")
    assert not told["alive"] and own_master.uri in told["uri"]
    own_master.start()
    serving.wait(lambda e: e["event"] == "master" and e["alive"], "the master")


@pytest.mark.parametrize("how", ["its input ends", "interrupted"])
def test_it_ends_with_its_input_and_leaves_nothing_at_the_master(master, serve, ros, how):
    serving = serve()
    serving.say(do="watch", topics=["/left_behind"])
    eventually(lambda: "/left_behind" in str(master._ask("getSystemState")), 20.0, "it is registered")
    if how == "interrupted":
        serving.process.send_signal(signal.SIGINT)
    else:
        serving.process.stdin.close()
    serving.process.wait(10.0)
    assert "/left_behind" not in str(master._ask("getSystemState"))
