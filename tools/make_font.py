#!/usr/bin/env python3
"""Writes ambf_framework/render/font_data.cpp: printable ASCII of DejaVu Sans Mono as text that the renderer reads.

Needs Pillow and the font (Debian: python3-pil, fonts-dejavu-core). Run it again only to change size or font.
"""

import pathlib

from PIL import Image, ImageDraw, ImageFont

FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf"
SIZE = 15  # px
COLUMNS, ROWS = 16, 6
LEVELS = " .:-=+*%#@"  # darkness of a texel, ten steps
OUT = pathlib.Path(__file__).resolve().parents[1] / "ambf_framework/render/font_data.cpp"

HEAD = """// Made by tools/make_font.py; do not edit. Glyphs of DejaVu Sans Mono (Bitstream Vera licence).
#include "render/font.h"

namespace ambf::render {

// clang-format off
const char* const kFontRows[kFontAtlasHeight] = {
"""
TAIL = """};
// clang-format on

}  // namespace ambf::render
"""


def main():
    font = ImageFont.truetype(FONT, SIZE)
    ascent, descent = font.getmetrics()
    width, height = round(font.getlength("M")), ascent + descent
    atlas = Image.new("L", (COLUMNS * width, ROWS * height))
    draw = ImageDraw.Draw(atlas)
    for i in range(95):
        draw.text((i % COLUMNS * width, i // COLUMNS * height), chr(32 + i), fill=255, font=font)
    lines = []
    for y in range(atlas.height):
        row = "".join(LEVELS[round(atlas.getpixel((x, y)) / 255 * 9)] for x in range(atlas.width))
        lines.append(f'    "{row}",\n')
    OUT.write_text(HEAD + "".join(lines) + TAIL)
    print(f"{OUT.name}: glyphs of {width} x {height} texels, atlas {atlas.width} x {atlas.height}")


if __name__ == "__main__":
    main()
