#!/usr/bin/env python3
"""Writes the font of labels: ambf_framework/render/marks/font_atlas.png, and font_data.cpp, where its glyphs lie.

Printable ASCII and Latin-1 of DejaVu Sans in three sizes, so that text is sharp on screens of usual, high and very high
density; and a disc for round corners. Needs Pillow and the font (Debian: python3-pil, fonts-dejavu-core). Run it again
only to change size or font.
"""

import pathlib

from PIL import Image, ImageDraw, ImageFont

FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
SIZES = (14, 21, 28)  # px
RADII = (6, 9, 12)  # px, of the disc
WIDTH = 512
CHARACTERS = [chr(c) for c in (*range(32, 127), *range(160, 256))]
FOLDER = pathlib.Path(__file__).resolve().parents[1] / "ambf_framework/render/marks"

HEAD = """// Made by tools/make_font.py; do not edit. Glyphs of DejaVu Sans (Bitstream Vera licence).
#include "render/marks/detail/font.h"

namespace ambf::render {

// clang-format off
const int kFontAtlasWidth = %d, kFontAtlasHeight = %d;
const FontFace kFontFaces[kFontFaceCount] = {
"""
TAIL = """};
// clang-format on

}  // namespace ambf::render
"""


class Atlas:
    def __init__(self):
        self.image = Image.new("L", (WIDTH, 1024))
        self.x = self.y = 1
        self.row = 0

    def put(self, picture):
        """Where it lies; one texel stays empty around each."""
        if self.x + picture.width + 1 > WIDTH:
            self.x, self.y, self.row = 1, self.y + self.row + 1, 0
        place = (self.x, self.y)
        self.image.paste(picture, place)
        self.x += picture.width + 1
        self.row = max(self.row, picture.height)
        return place


def glyph(atlas, font, character):
    left, top, right, bottom = font.getbbox(character)
    advance = round(64 * font.getlength(character))
    if right <= left or bottom <= top:
        return (0, 0, 0, 0, 0, 0, advance)
    picture = Image.new("L", (right - left, bottom - top))
    ImageDraw.Draw(picture).text((-left, -top), character, fill=255, font=font)
    return (*atlas.put(picture), right - left, bottom - top, left, top, advance)


def disc(atlas, radius):
    fine = 8
    picture = Image.new("L", (2 * radius * fine, 2 * radius * fine))
    ImageDraw.Draw(picture).ellipse((0, 0, 2 * radius * fine - 1, 2 * radius * fine - 1), fill=255)
    side = 2 * radius
    return (*atlas.put(picture.resize((side, side), Image.BOX)), side, side, 0, 0, 64 * side)


def main():
    atlas = Atlas()
    faces = []
    for size, radius in zip(SIZES, RADII, strict=True):
        font = ImageFont.truetype(FONT, size)
        ascent, descent = font.getmetrics()
        glyphs = [glyph(atlas, font, character) for character in CHARACTERS] + [disc(atlas, radius)]
        faces.append((size, ascent + descent, glyphs))
    used = atlas.y + atlas.row + 1
    atlas.image.crop((0, 0, WIDTH, used)).save(FOLDER / "font_atlas.png", optimize=True)
    out = HEAD % (WIDTH, used)
    for size, height, glyphs in faces:
        out += f"  {{{size}, {height}, {{\n"
        line = "   "
        for x, y, width, height, left, top, advance in glyphs:
            entry = f" {{{x},{y},{width},{height},{left},{top},{advance}}},"
            if len(line) + len(entry) > 120:
                out += line + "\n"
                line = "   "
            line += entry
        out += line + "\n  }},\n"
    (FOLDER / "font_data.cpp").write_text(out + TAIL)
    print(f"font_atlas.png: {WIDTH} x {used}")


if __name__ == "__main__":
    main()
