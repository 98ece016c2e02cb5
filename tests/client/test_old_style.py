"""Scripts of the original's users, unchanged: every documented public method, as they call it, against a simulator.

Here: names, the client, the watchdog; the handles of objects are in test_old_style_*.py.
"""

import importlib
import inspect
import time

import ambf_client
import pytest
from documented import PUBLIC, WHERE_CALLED, documented, methods
from harness import eventually

pytestmark = pytest.mark.usefixtures("called")


@pytest.mark.parametrize("class_name", PUBLIC)
def test_names_arguments_and_defaults_are_those_of_the_original(class_name):
    for name, arguments in methods(PUBLIC[class_name]).items():
        function = inspect.getattr_static(getattr(ambf_client, class_name), name)
        own = list(inspect.signature(function).parameters.values())[1:]
        for (argument, default), parameter in zip(arguments, own, strict=False):
            assert argument.lstrip("*") == parameter.name, f"{class_name}.{name}"
            assert argument.startswith("*") == (parameter.kind == parameter.VAR_POSITIONAL)
            if default is not None:
                expected = None if default == "None" else type(parameter.default)(default.strip("'"))
                assert parameter.default == expected, f"{class_name}.{name}({argument})"
        assert len(own) >= len(arguments), f"{class_name}.{name} takes {len(own)} arguments"
        for parameter in own[len(arguments) :]:  # ours beyond are optional
            assert parameter.default is not inspect.Parameter.empty, f"{class_name}.{name}({parameter.name})"


@pytest.mark.parametrize(
    "module, names",
    [
        ("ambf_client", ["Client"]),
        ("ambf_world", ["World"]),
        ("ambf_object", ["Object"]),
        ("ambf_rigid_body", ["RigidBody"]),
        ("ambf_base_object", ["BaseObject"]),
        ("ambf_camera", ["Camera"]),
        ("ambf_light", ["Light"]),
        ("ambf_sensor", ["Sensor"]),
        ("ambf_actuator", ["Actuator"]),
        ("ambf_vehicle", ["Vehicle"]),
        ("ambf_env", ["AmbfEnv", "Observation"]),
        ("watch_dog", ["WatchDog"]),
        ("ambf_comm", [*PUBLIC]),
    ],
)
def test_old_module_names_give_the_classes(module, names):
    for name in names:
        assert getattr(importlib.import_module(module), name) is getattr(ambf_client, name)


def test_every_documented_class_is_used_in_one_of_the_files():
    assert sorted(name for names in WHERE_CALLED.values() for name in names) == sorted(PUBLIC)


def test_client_methods(bench, ros, capsys):
    from ambf_client import Client

    client = Client("old_script")
    client.create_objs_from_rostopics(publish_rate=120)
    client.start()
    client.set_publish_rate(rate=200)
    client.refresh()
    names = client.get_obj_names()
    assert "World" in names
    assert {"/ambf/env/Box", "/ambf/env/cameras/eye", "/ambf/env/lights/sun"} <= set(names)
    assert client.get_common_namespace() == "/ambf/env/"
    assert client.get_world_handle() is client.get_obj_handle("World")
    box = client.get_obj_handle(a_name="Box")
    assert box is client.get_obj_handle("/ambf/env/Box")
    assert box.is_active()
    assert client.get_obj_pose(a_name="Box") == pytest.approx([0.0, 1.0, 0.0, 0.0, 0.0, 0.0], abs=1e-6)
    client.set_obj_cmd("Box", fx=4.0, fy=0.0, fz=0.0, nx=0.0, ny=0.0, nz=0.0)
    eventually(lambda: box.get_linear_vel().x > 0.05, what="the box is pushed")
    capsys.readouterr()
    client.print_active_topics()
    assert "/ambf/env/Box/State" in capsys.readouterr().out
    client.print_summary()
    assert "RigidBody (5)" in capsys.readouterr().out
    client.clean_up()
    assert not box.is_active()


def test_a_name_that_fits_nothing_or_several_gives_none_and_says_why(bench, client, capsys):
    assert client.get_obj_handle("Fox") is None
    assert "no object 'Fox'" in capsys.readouterr().err
    assert client.get_obj_handle("e") is None
    said = capsys.readouterr().err
    assert "fits several" in said
    assert "/ambf/env/Table" in said
    assert client.get_obj_handle("Tab").get_name() == "/ambf/env/Table"  # any unambiguous part will do


def test_watch_dog_methods(capsys):
    dog = ambf_client.WatchDog(time_out=0.05)
    assert not dog.is_wd_expired()
    dog.acknowledge_wd()
    assert not dog.is_wd_expired()
    time.sleep(0.08)
    assert dog.is_wd_expired()
    dog.console_print(class_name="Thing")
    dog.console_print(class_name="Thing")
    assert capsys.readouterr().err.count("Thing") == 1
    dog.set_timeout(time_out=10.0)
    dog.acknowledge_wd()
    assert not dog.is_wd_expired()


def test_every_documented_method_was_called(called):
    """The last of this file."""
    assert documented(__name__) - called == set()
