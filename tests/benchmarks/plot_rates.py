"""Draws docs/images/rates.svg from the output of ambf_device_sessions_tests --gtest_filter='Rates.*': error against the
rate of the physics thread (the dissertation's Fig. 3.20).

Usage: plot_rates.py OUTPUT PICTURE
"""

import math
import re
import sys

STYLES = {  # row of the output: colour, dashes
    "1 kg, 1 device": ("#2471a3", "none"),
    "1 kg, 2 devices": ("#2471a3", "6 4"),
    "1 kg, a force held over the iteration": ("#c0392b", "none"),
    "0.1 kg, 1 device": ("#1e8449", "none"),
    "0.1 kg, 2 devices": ("#1e8449", "6 4"),
    "0.1 kg, a force held over the iteration": ("#d68910", "none"),
}
WIDTH, HEIGHT, MARGIN = 640, 420, 60
RATES, ERRORS = (0.95, 3.05), (-0.5, 2.0)  # decades shown: Hz; mm


def read(output):
    """{row: [(rate in Hz, rms error in mm)]}"""
    rates = [float(rate) for rate in re.findall(r"([\d.]+) Hz", re.search(r"^rms, mm.*$", output, re.M)[0])]
    curves = {}
    for line in output.splitlines():
        name, *values = line.split(" | ")
        if name in STYLES:
            curves[name] = list(zip(rates, map(float, values), strict=True))
    return curves


def place(rate, error):
    x = (math.log10(rate) - RATES[0]) / (RATES[1] - RATES[0])
    y = (min(math.log10(error), ERRORS[1]) - ERRORS[0]) / (ERRORS[1] - ERRORS[0])
    return MARGIN + x * (WIDTH - 2 * MARGIN), HEIGHT - MARGIN - y * (HEIGHT - 2 * MARGIN)


def text(x, y, content, colour="#333"):
    return f'<text x="{x:.0f}" y="{y:.0f}" fill="{colour}" font-family="sans-serif" font-size="12">{content}</text>'


def picture(curves):
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}">']
    parts.append('<rect width="100%" height="100%" fill="white"/>')
    for error in (1.0, 10.0, 100.0):
        (left, y), (right, _) = place(10 ** RATES[0], error), place(10 ** RATES[1], error)
        parts.append(f'<line x1="{left:.0f}" y1="{y:.1f}" x2="{right:.0f}" y2="{y:.1f}" stroke="#ddd"/>')
        parts.append(text(8, y + 4, f"{error:g} mm"))
    for rate in (10, 25, 50, 100, 250, 1000):
        x, y = place(rate, 10 ** ERRORS[0])
        parts.append(text(x - 14, y + 20, f"{rate} Hz"))
    for row, (name, points) in enumerate(curves.items()):
        colour, dashes = STYLES[name]
        # Unstable runs leave the picture at its upper edge.
        shown = " ".join(f"{x:.1f},{y:.1f}" for x, y in (place(*point) for point in points))
        parts.append(
            f'<polyline points="{shown}" fill="none" stroke="{colour}" stroke-width="2" stroke-dasharray="{dashes}"/>'
        )
        parts.append(text(WIDTH - 320, 20 + 15 * row, name + ("" if dashes == "none" else " (dashed)"), colour))
    return "\n".join([*parts, "</svg>", ""])


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as file:
        drawn = picture(read(file.read()))
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write(drawn)
