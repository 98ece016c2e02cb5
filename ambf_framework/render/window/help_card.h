// The help over a window's picture: keys and mouse in as many columns as fit, in letters that stay readable, and on
// several pages where the window is too small for all. Main thread.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "render/text/text_drawing.h"
#include "render/window/keys.h"

namespace ambf::render {

// How a table is laid out on a picture.
struct HelpLayout {
  double scale = 1.0;                            // of the letters
  std::size_t rows = 1, columns = 1, pages = 1;  // columns: of one page
};

// In the largest letters that show all of it on one page; in the smallest that can still be read, on several pages,
// when there are none. `density`: of the screen.
HelpLayout help_layout(const std::vector<HelpLine>& table, int width_px, int height_px, double density);

class HelpCard {
 public:
  bool shown() const { return page_ > 0; }
  void turn();  // shows it, then its other pages, then hides it

  // What to draw on a picture of this size; null while hidden. Valid until the next call.
  const TextDrawing* drawing(int width_px, int height_px, double density);

 private:
  void draw(int width_px, int height_px);

  std::size_t page_ = 0;  // from 1; 0: hidden
  HelpLayout layout_;
  double density_ = 0.0;
  std::size_t drawn_page_ = 0;
  std::optional<TextDrawing> drawing_;  // of that page
};

}  // namespace ambf::render
