"""What publishes for ambf-cli, within this process."""

import genpy.dynamic
from ambf_tools.topics import sending
from harness import eventually


def test_a_field_that_is_only_called_header_needs_no_stamp(ros):
    kind = genpy.dynamic.generate_dynamic("odd_msgs/Odd", "string header\n")["odd_msgs/Odd"]
    sender = sending.Sender("/odd", kind)
    sender.repeat(kind(header="x"), 100.0)
    eventually(lambda: sender.count > 3, 10.0, "it is published again and again")
    sender.repeat(None, 0.0)
