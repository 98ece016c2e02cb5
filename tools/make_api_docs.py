"""Writes docs/api/ from the docstrings of the Python packages. Run by ./dev shell -- python tools/make_api_docs.py

With --check it writes nothing, and ends with 1 when the pages are not what it would write.
"""

import importlib
import inspect
import re
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[1] / "docs/api"
# Modules with a page each, in the order of reading.
MODULES = [
    *("ambf_client.client", "ambf_client.world", "ambf_client.services", "ambf_client.rigid_body"),
    *("ambf_client.jointed", "ambf_client.base_object", "ambf_client.handle", "ambf_client.camera"),
    *("ambf_client.light", "ambf_client.sensor", "ambf_client.actuator", "ambf_client.vehicle"),
    *("ambf_client.contact_sensor", "ambf_client.ghost_object", "ambf_client.object"),
    "ambf_client.soft_body",
    "ambf_client.task",
    *(
        "ambf_client.sensor_base",
        "ambf_client.node",
        "ros_abstraction_layer.ros1",
        "tf_function",
        "ambf_client.devices",
        "ambf_client.env",
        "ambf_client.rotations",
        "ambf_client.watch_dog",
        "ambf_client.kinds",
    ),
    *("ambf_tools.record", "ambf_tools.read_bag", "ambf_tools.read_input"),
    *("ambf_core.world", "ambf_core.arrays", "ambf_core.batch", "ambf_core.views", "ambf_core.pictures"),
    *("ambf_core.windows", "ambf_core.arms", "ambf_core.tasks"),
    *("ambf_gym.goals", "ambf_gym.judged", "ambf_gym.vector", "ambf_gym.randomization"),
    *("ambf_tools.dataset.recorder", "ambf_tools.dataset.check", "ambf_tools.dataset.episodes"),
]
NOTE = "<!-- Made by tools/make_api_docs.py from the docstrings: change those. -->\n"


def public(owner):
    """(name, thing) of what a module or class defines itself, in the order of its text."""
    return [(name, thing) for name, thing in vars(owner).items() if not name.startswith("_") or name == "__init__"]


def signature(name, function):
    """As one would write it, without the quotes of postponed annotations and without self."""
    text = str(inspect.signature(function)).replace("(self, ", "(").replace("(self)", "()")
    text = re.sub(r"'([^']*)'", lambda m: m.group(1) if m.start() and text[m.start() - 1] in " >" else m.group(0), text)
    return f"{name}{text}".replace("Names", "list[str]")


def doc(thing):
    return inspect.getdoc(thing) or ""


def class_text(name, kind):
    bases = [base.__name__ for base in kind.__bases__ if base is not object]
    lines = [f"## class {name}" + (f"({', '.join(bases)})" if bases else ""), "", doc(kind), ""]
    for member, thing in public(kind):
        if isinstance(thing, (staticmethod, classmethod)):
            thing = thing.__func__
        if isinstance(thing, property):
            lines += [f"### {name}.{member}", "", doc(thing), ""]
        elif inspect.isfunction(thing) and thing.__name__ == member:
            text = doc(thing)
            if member == "__init__":
                if not text:
                    continue
                lines += [f"### `{signature(name, thing).removesuffix(' -> None')}`", "", text, ""]
            else:
                lines += [f"### `{signature(member, thing)}`", "", text, ""]
    fields = getattr(kind, "__dataclass_fields__", {})
    if fields:
        lines += ["| field | type |", "|---|---|"]
        lines += [f"| `{field}` | `{info.type}` |".replace(" | None", " or None") for field, info in fields.items()]
        lines.append("")
    return lines


def page(module_name):
    module = importlib.import_module(module_name)
    lines = [NOTE, f"# {module_name}", "", doc(module), ""]
    for name, thing in public(module):
        if getattr(thing, "__module__", None) != module_name:
            continue
        if inspect.isclass(thing):
            lines += class_text(name, thing)
        elif inspect.isfunction(thing):
            lines += [f"## `{signature(name, thing)}`", "", doc(thing), ""]
    return "\n".join(lines).rstrip() + "\n"


def contents():
    lines = [NOTE, "# The Python packages", "", "Start with [the tutorial](../python.md).", "", "| module | what |"]
    lines.append("|---|---|")
    for name in MODULES:
        first = doc(importlib.import_module(name)).splitlines()[0]
        lines.append(f"| [{name}]({name}.md) | {first} |")
    return "\n".join(lines) + "\n"


def pages():
    """{file name: text}"""
    return {"README.md": contents(), **{f"{name}.md": page(name) for name in MODULES}}


def main():
    made = pages()
    if "--check" in sys.argv[1:]:
        there = {file.name: file.read_text() for file in FOLDER.glob("*.md")}
        stale = sorted(name for name in made.keys() | there.keys() if made.get(name) != there.get(name))
        if stale:
            print(f"not up to date: {', '.join(stale)}: run ./dev shell -- python tools/make_api_docs.py")
        return 1 if stale else 0
    FOLDER.mkdir(exist_ok=True)
    for file in FOLDER.glob("*.md"):
        file.unlink()
    for name, text in made.items():
        (FOLDER / name).write_text(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
