#include "render/window/detail/window_place.h"

#include <algorithm>

namespace ambf::render {

namespace {

constexpr int kTitleBar = 36;  // what a window manager adds above a window, about

}  // namespace

Area place_window(unsigned index, unsigned count, const Area& work) {
  const int width = work.width * 8 / 10, height = work.height / 2;
  if (count <= 1) return {work.left + (work.width - width) / 2, work.top + (work.height - height) / 2, width, height};
  const int columns = static_cast<int>((count + 1) / 2);
  const int column = static_cast<int>(index / 2) % columns, row = static_cast<int>(index % 2);
  const int rest = work.width - width;
  const int left = columns > 1 ? rest * column / (columns - 1) : rest / 2;
  // Two rows of half the height, less their title bars.
  const int bar = std::min(kTitleBar, height / 4);
  return {work.left + left, work.top + row * height + bar, width, height - bar};
}

Area tile(unsigned index, unsigned count, const Area& screen) {
  const int parts = static_cast<int>(std::max(count, 1U)), part = static_cast<int>(index);
  const int left = screen.width * part / parts, right = screen.width * (part + 1) / parts;
  return {screen.left + left, screen.top, right - left, screen.height};
}

}  // namespace ambf::render
