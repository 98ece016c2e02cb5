// Where windows are put on a monitor. Pure functions, any thread.
#pragma once

namespace ambf::render {

struct Area {
  int left = 0, top = 0, width = 0, height = 0;
  bool operator==(const Area&) const = default;
};

// The place of number `index` of `count` windows within a monitor's `work` area (without the desktop's bars), 16:10:
// alone, 80 % of it one way and at most 80 % the other, in the middle; else as large as windows are that do not hide
// each other.
Area place_window(unsigned index, unsigned count, const Area& work);

// Number `index` of `count` equal tiles that together fill `screen`, side by side.
Area tile(unsigned index, unsigned count, const Area& screen);

}  // namespace ambf::render
