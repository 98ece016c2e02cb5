"""What publishes for ambf-cli and the panel, within this process."""

import genpy.dynamic
from ambf_tools.topics import sending
from harness import eventually
from std_msgs.msg import Float64


def test_a_sender_closes_unused_and_then_says_so(ros, monkeypatch):
    closed = []
    sender = sending.Sender("/unused", Float64, closed.append)
    assert sender.keep() and not closed
    monkeypatch.setattr(sending, "_IDLE", 0.0)
    eventually(lambda: closed == [sender], 10.0, "it closes")
    assert not sender.keep()


def test_a_field_that_is_only_called_header_needs_no_stamp(ros):
    kind = genpy.dynamic.generate_dynamic("odd_msgs/Odd", "string header\n")["odd_msgs/Odd"]
    sender = sending.Sender("/odd", kind)
    sender.repeat(kind(header="x"), 100.0)
    eventually(lambda: sender.count > 3, 10.0, "it is published again and again")
    sender.close()
