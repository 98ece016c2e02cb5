"""The generated Python classes have the wire formats that clients, scripts and bags were built against.

Run with Debian's Python, which has genpy, and the generated package on PYTHONPATH. Exits 1 on a difference.
"""

import pathlib
import sys

import ambf_msgs.msg
import ambf_msgs.srv


def generated_md5sums():
    messages = {n: c._md5sum for n, c in vars(ambf_msgs.msg).items() if hasattr(c, "_slot_types")}
    services = {n: c._md5sum for n, c in vars(ambf_msgs.srv).items() if hasattr(c, "_request_class")}
    return {**messages, **services}


def frozen_md5sums():
    lines = (pathlib.Path(__file__).parent / "md5sums.txt").read_text().splitlines()
    return dict(line.split() for line in lines if line and not line.startswith("#"))


frozen, generated = frozen_md5sums(), generated_md5sums()
for name in sorted(frozen.keys() | generated.keys()):
    if frozen.get(name) != generated.get(name):
        print(f"{name}: generated {generated.get(name)}, frozen {frozen.get(name)}")
sys.exit(frozen != generated)
