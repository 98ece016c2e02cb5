#include "render/window/detail/window_place.h"

#include <algorithm>

namespace ambf::render {

namespace {

constexpr int kTitleBar = 36;  // what a window manager adds above a window, about

// The largest area of 16:10 in the middle of `cell`.
Area fit(const Area& cell) {
  const int width = std::min(cell.width, cell.height * 16 / 10), height = width * 10 / 16;
  return {cell.left + (cell.width - width) / 2, cell.top + (cell.height - height) / 2, width, height};
}

}  // namespace

Area place_window(unsigned index, unsigned count, const Area& work) {
  if (count <= 1) {
    return fit({work.left + work.width / 10, work.top + work.height / 10, work.width * 8 / 10, work.height * 8 / 10});
  }
  // In as many columns as make the windows largest.
  Area best;
  for (unsigned columns = 1; columns <= count; ++columns) {
    const auto wide = static_cast<int>(columns), high = static_cast<int>((count + columns - 1) / columns);
    const auto column = static_cast<int>(index % columns), row = static_cast<int>(index / columns);
    const int width = work.width / wide, height = work.height / high, bar = std::min(kTitleBar, height / 4);
    const Area place = fit({work.left + column * width, work.top + row * height + bar, width, height - bar});
    if (place.width > best.width) best = place;
  }
  return best;
}

Area tile(unsigned index, unsigned count, const Area& screen) {
  const int parts = static_cast<int>(std::max(count, 1U)), part = static_cast<int>(index);
  const int left = screen.width * part / parts, right = screen.width * (part + 1) / parts;
  return {screen.left + left, screen.top, right - left, screen.height};
}

}  // namespace ambf::render
