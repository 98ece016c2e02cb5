#!/usr/bin/env python3
"""Draws docs/images/frames.svg, the picture of docs/frames.md, from the models' files and the kinematics.

Usage: PYTHONPATH=ambf_client_py draw_frames.py [PICTURE]     another ending than svg makes another kind of picture
"""

import re
import sys
from pathlib import Path

import matplotlib
import numpy as np
import yaml

matplotlib.use("Agg")
from ambf_client.kinematics import load_arm  # noqa: E402
from ambf_client.rotations import matrix_from_quaternion, quaternion_from_euler  # noqa: E402
from matplotlib import pyplot as plt  # noqa: E402

ROOT = Path(__file__).resolve().parents[1]
COLOURS = ("#c0392b", "#1e8449", "#2471a3")  # x, y, z
GREY, INK = "#8a8f94", "#222222"
DEEP = 0.1  # m: insertion of PSMs and ECM


def frame(rotation, position=(0, 0, 0)):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = rotation, position
    return T


def body_pose(arm, name):
    location = yaml.safe_load((ROOT / f"ambf_models/dvrk/{arm}.yaml").read_text())[f"BODY {name}"]["location"]
    rotation = matrix_from_quaternion(quaternion_from_euler(*(location["orientation"][key] for key in "rpy")))
    return frame(rotation, [location["position"][key] for key in "xyz"])


def page_names():
    """What the page's lines of Python define."""
    names = {}
    for block in re.findall(r"^```python\n(.*?)^```", (ROOT / "docs/frames.md").read_text(), re.MULTILINE | re.DOTALL):
        exec(block, names)
    return names


class View:
    """A parallel projection of the world onto a panel: seen from `azimuth`, `height` above the horizon (rad)."""

    def __init__(self, axes, azimuth, height):
        self.axes = axes
        right = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
        back = np.array([np.cos(height) * np.cos(azimuth), np.cos(height) * np.sin(azimuth), np.sin(height)])
        self.plane = np.array([right, np.cross(back, right)])

    def line(self, points, **style):
        self.axes.plot(*(self.plane @ np.array(points).T), **{"color": GREY, "lw": 2.5, "zorder": 1, **style})

    def frame(self, T, size, label="", shift=(0, 0), align="left"):
        at = self.plane @ T[:3, 3]
        for k, colour in enumerate(COLOURS):
            tip = self.plane @ (T[:3, 3] + size * T[:3, k])
            arrow(self.axes, at, tip, colour)
        self.axes.plot(*at, "o", color=INK, ms=3, zorder=5)
        write(self.axes, at + np.array(shift), label, align)


def arrow(axes, start, end, colour):
    style = {"arrowstyle": "-|>,head_width=0.22,head_length=0.5", "color": colour, "lw": 1.8}
    axes.annotate("", end, start, arrowprops={**style, "shrinkA": 0, "shrinkB": 0}, zorder=4, annotation_clip=False)
    axes.plot(*np.transpose([start, end]), alpha=0)  # so that the panel's limits count it


def write(axes, at, text, align="left", size=9.5, **style):
    box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.8}
    axes.text(*at, text, ha=align, va="center", fontsize=size, color=INK, zorder=6, bbox=box, **style)


def patient_side(axes):
    view = View(axes, np.radians(25), np.radians(25))
    labels = {  # beside base and tip
        "psm1": ((0.015, 0.02, "left"), (0.015, -0.012, "left")),
        "psm2": ((-0.025, 0.025, "right"), (-0.01, -0.04, "right")),
        "ecm": ((-0.01, 0.054, "left"), (-0.01, -0.03, "center")),
    }
    for arm, (beside_base, beside_tip) in labels.items():
        known, base = load_arm(arm[:3].upper()), body_pose(arm, "base link")
        q = np.array([0.0, 0.0, DEEP, *[0.0] * (len(known.lower) - 3)])
        tip = base @ known.forward(q)
        view.line([base[:3, 3] + 0.09 * base[:3, 2], tip[:3, 3]])
        view.frame(base, 0.045, f"{arm.upper()} base (RCM)", beside_base[:2], beside_base[2])
        view.frame(tip, 0.045, f"{arm.upper()} tip", beside_tip[:2], beside_tip[2])
    corner = np.linalg.pinv(view.plane) @ (view.plane @ body_pose("psm2", "base link")[:3, 3] + (0.0, -0.2))
    view.frame(frame(np.eye(3), corner), 0.045, "axes of the world", (0.0, -0.03), "center")


def masters(axes):
    view = View(axes, np.radians(-60), np.radians(22))
    for arm in ("mtmr", "mtml"):
        known, base = load_arm(arm.upper()), body_pose(arm, "Top Panel")
        tip = base @ known.forward(np.zeros(7))
        elbow, wrist = ((base @ np.array([0, y, -0.2794, 1.0]))[:3] for y in (0, -0.3645))
        view.line([base[:3, 3], elbow, wrist, tip[:3, 3]])
        view.frame(base, 0.1, f"{arm.upper()} base\n(Top Panel)", (-0.03, 0.09), "right")
        view.frame(tip, 0.1, f"{arm.upper()} tip", (0.03, -0.05))


def in_picture(axes):
    """Each frame at the endoscope's tip as its picture shows it; into the picture: a cross, out of it: a dot."""
    axes.add_patch(plt.Rectangle((0, 0), 4.2, 3.0, facecolor="#f4f6f7", edgecolor=INK, lw=1.2))
    page = page_names()
    frames = {
        "camera\nDepthData": np.eye(3),
        "optical\npictures, camera_info": page["R_camera_optical"],
        "ISI view\nPSMs with view: ECM": page["R_camera_isi"],
        "ECM tip (straight)\nkinematics of the ECM": page["R_camera_tip"],
    }
    for i, (name, R_camera_frame) in enumerate(frames.items()):
        three = np.array([[0, 1, 0], [0, 0, 1], [-1, 0, 0]]) @ R_camera_frame  # right, up, away
        at = np.array([1.0 + 2.1 * (i % 2), 2.22 - 1.45 * (i // 2)])
        for k, (right, up, away) in enumerate(three.T):
            end = at + 0.42 * np.array([right, up])
            if away == 0:
                arrow(axes, at, end, COLOURS[k])
                write(axes, at + 0.54 * np.array([right, up]), "xyz"[k], "center")
                continue
            axes.plot(*at, "o", ms=11, mfc="white", mec=COLOURS[k], mew=1.8, zorder=7)
            axes.plot(*at, "x" if away > 0 else "o", ms=5 if away > 0 else 3, color=COLOURS[k], mew=1.8, zorder=8)
            write(axes, at + np.array([0.17, -0.17]), "xyz"[k], "center")
        side = -1 if name.startswith("ISI") else 1
        write(axes, at + np.array([side * -0.12, -0.42 if i != 1 else 0.4]), name, "center", 9)
    note = "The picture as the user sees it. Cross: away from the user; dot: towards."
    axes.text(2.1, -0.2, note, ha="center", fontsize=9, color=INK)


def of_adf(axes):
    outline = np.array([(0, 0), (1.5, -0.25), (2.1, 0.4), (1.7, 1.1), (0.3, 0.95), (0, 0)])
    axes.fill(*outline.T, facecolor="#e8eaed", edgecolor=GREY, lw=1.5, zorder=0)
    axes.fill(*(outline * (0.8, -0.75) + (2.02, 0.66)).T, facecolor="#f4efe6", edgecolor=GREY, lw=1.5, zorder=-1)

    def flat(at, angle, size, names="xy"):
        for k in range(2):
            turn = angle + k * np.pi / 2
            arrow(axes, at, np.array(at) + size * np.array([np.cos(turn), np.sin(turn)]), COLOURS[k])
        axes.plot(*at, "o", color=INK, ms=3, zorder=5)

    flat((0, 0), 0.0, 0.45)
    write(axes, (0.0, -0.26), "body (mesh) frame:\nlocation, State", "center")
    flat((1.05, 0.42), 0.5, 0.4)
    write(axes, (0.98, 0.15), "inertia: inertial offset", "center")
    at = np.array((2.02, 0.46))
    arrow(axes, at, at + (0.0, 0.75), "#7d3c98")
    axes.plot(*at, "o", ms=7, mfc="white", mec="#7d3c98", mew=2, zorder=6)
    write(axes, at + (0.0, 0.85), "joint: pivot and axis,\nin parent and child", "center")
    write(axes, (0.75, 0.88), "parent", "center", style="italic")
    write(axes, (3.0, 0.35), "child", "center", style="italic")


def draw(path):
    plt.rcParams.update({"svg.hashsalt": "frames", "font.family": "DejaVu Sans"})
    figure, panels = plt.subplots(2, 2, figsize=(11.5, 9.5), gridspec_kw={"height_ratios": (1.1, 1)})
    drawn = {
        "Patient's side of launch_dvrk.yaml": patient_side,
        "Masters": masters,
        "At the tip of the endoscope": in_picture,
        "In a file (ADF)": of_adf,
    }
    for axes, (title, what) in zip(panels.flat, drawn.items(), strict=True):
        what(axes)
        axes.set_title(title, fontsize=12, color=INK)
        axes.set_aspect("equal", adjustable="datalim")
        axes.margins(0.14)
        axes.axis("off")
    for k, colour in enumerate(COLOURS):
        figure.text(0.46 + 0.04 * k, 0.015, "xyz"[k], color=colour, fontsize=13, weight="bold", ha="center")
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    figure.savefig(path, dpi=110, metadata={"Date": None} if str(path).endswith("svg") else None)


if __name__ == "__main__":
    draw(sys.argv[1] if len(sys.argv) > 1 else ROOT / "docs/images/frames.svg")
