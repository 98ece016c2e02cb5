"""meta/README.md of a data set in one of LeRobot's formats: what its columns are, and how they belong together."""

from __future__ import annotations

from .episodes import ACTION, DONE, REWARD, STATE, SUCCESS, Dataset

_MEANINGS = {
    STATE: "what was seen before the action",
    ACTION: "what was asked for until the next row",
    REWARD: "of the action",
    DONE: "whether the episode ended with the action",
    SUCCESS: "whether the task was done after the action",
    "observation.sim_step": "steps of physics since the reset of the world",
}


def text(dataset: Dataset) -> str:
    """In Markdown."""
    successes = sum(episode.success for episode in dataset.episodes)
    lines = [
        f"# {dataset.task}",
        "",
        f"{len(dataset.episodes)} episodes ({successes} successful) of {dataset.source}, simulated by AMBF;"
        f" robot: {dataset.robot or 'not named'}. Failed episodes are in it: `{SUCCESS}` says which.",
        "",
        "## Synchronisation",
        "",
        f"A row every 1/{dataset.fps} s of simulated time; `timestamp` is frame_index / {dataset.fps}, exactly."
        f" {dataset.synchronised}",
        "",
        "## Columns",
        "",
        "Lengths are in m, angles in rad, forces in N, torques in N m, in the frame of the world where nothing else is"
        " said. Actions of environments are from -1 to 1.",
        "",
        "| column | type | shape | what |",
        "|---|---|---|---|",
    ]
    for name, (kind, shape) in dataset.features().items():
        meaning = ", ".join(f"`{each}`" for each in dataset.names.get(name, [])) or _MEANINGS.get(name, "")
        lines.append(f"| `{name}` | {kind} | {'x'.join(map(str, shape))} | {meaning} |")
    return "\n".join([*lines, ""])
