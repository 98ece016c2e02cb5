"""2.0's suite of scripts again, beside a program of AMBF 3.0 that reads and commands the same simulator."""

import pytest
from test_old_style import test_client_methods  # noqa: F401
from test_old_style_objects import *  # noqa: F403

del test_every_documented_method_was_called  # noqa: F821 (it counts the calls of a whole file of them)

BESIDE = """
from ambf_client import Client

client = Client("third", 5)
client.connect()
slide = client.get_obj_handle("Slide")
seen = [client.get_obj_handle(name) for name in ("Box", "Base", "Table")]
rate = client.create_rate(100)
ready = False
while not client.is_shutdown():
    slide.set_force(0.0, 0.0, 0.0)
    if not ready and all(body._state.sim_step > 10 for body in [slide, *seen]):
        ready = True
        print("beside", flush=True)
    rate.sleep()
"""


@pytest.fixture
def bench(bench, script, master):
    beside = script(BESIDE, master.uri)
    beside.wait_line("beside")
    yield bench
    assert beside.process.poll() is None, beside.text()
    beside.interrupt()
    beside.reader.join(5.0)
    assert "Exception" not in beside.text(), beside.text()
