"""Draws docs/images/accuracy.svg from the output of ambf_accuracy_benchmark: error against step.

Usage: plot_accuracy.py OUTPUT PICTURE
"""

import math
import re
import sys

SHOWN = {  # figure: colour
    ("heavy top", "tilt, rad"): "#c0392b",
    ("simple pendulum A01", "position, m"): "#2471a3",
    ("ladder A02", "position, m"): "#1e8449",
    ("gyroscope", "energy lost, share"): "#7d3c98",
}
WIDTH, HEIGHT, MARGIN = 640, 420, 60
STEPS, ERRORS = (-4.1, -2.3), (-12.0, 1.0)  # decades shown: s; of the error


def read(output):
    """{(case, figure): [(step in s, error)]}"""
    curves, case, steps = {}, "", []
    for line in output.splitlines():
        head = re.match(r"(\S.*?)\s{2,}(.*ms)$", line)
        if head:
            case, steps = head[1], [float(step) * 1e-3 for step in re.findall(r"([\d.]+) ms", head[2])]
        elif line.startswith("  "):
            name, *values = re.split(r"\s{2,}", line.strip())
            curves[case, name] = list(zip(steps, map(float, values), strict=True))
    return curves


def place(step, error):
    x = (math.log10(step) - STEPS[0]) / (STEPS[1] - STEPS[0])
    y = (math.log10(max(abs(error), 1e-12)) - ERRORS[0]) / (ERRORS[1] - ERRORS[0])
    return MARGIN + x * (WIDTH - 2 * MARGIN), HEIGHT - MARGIN - y * (HEIGHT - 2 * MARGIN)


def text(x, y, content, colour="#333"):
    return f'<text x="{x:.0f}" y="{y:.0f}" fill="{colour}" font-family="sans-serif" font-size="12">{content}</text>'


def picture(curves):
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}">']
    parts.append('<rect width="100%" height="100%" fill="white"/>')
    for decade in range(int(ERRORS[0]), int(ERRORS[1]) + 1, 2):
        (left, y), (right, _) = place(10 ** STEPS[0], 10.0**decade), place(10 ** STEPS[1], 1.0)
        parts.append(f'<line x1="{left:.0f}" y1="{y:.1f}" x2="{right:.0f}" y2="{y:.1f}" stroke="#ddd"/>')
        parts.append(text(8, y + 4, f"1e{decade}"))
    for step in (1e-4, 1e-3, 4e-3):
        x, y = place(step, 10 ** ERRORS[0])
        parts.append(text(x - 14, y + 20, f"{step * 1e3:g} ms"))
    for row, (key, colour) in enumerate(SHOWN.items()):
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in (place(*point) for point in curves[key]))
        parts.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2"/>')
        parts.append(text(MARGIN + 10, 20 + 15 * row, ": ".join(key), colour))
    return "\n".join([*parts, "</svg>", ""])


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as file:
        drawn = picture(read(file.read()))
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write(drawn)
