// How the panel looks, and the few widgets that Dear ImGui does not have. Private to render/panel/. Main thread.
#pragma once

#include <imgui/imgui.h>

#include <deque>
#include <map>
#include <string>

#include "math/types.h"

namespace ambf::render {

struct WidgetPlace {
  float left = 0.0F, top = 0.0F, right = 0.0F, bottom = 0.0F;  // px of the picture
};

struct Ui {
  float scale = 1.0F;  // px a point
  bool dark = true;
  ImVec4 accent, muted, good, warning, bad;
  ImFont* strong = nullptr;             // headings
  std::map<std::string, double> typed;  // into number fields, not finished yet
  std::map<std::string, WidgetPlace>
      places;  // of the widgets of this picture, by name: where a test (or a person) presses

  float points(float value) const { return value * scale; }
};

// Colours and distances of the current context.
void apply_theme(Ui& ui, bool dark);

// Names the widget just made, if it can be seen.
void note(Ui& ui, const std::string& name);

enum class Icon { play, pause, step, back, reset, close, target, parent, copy, curve };
// A square button with a drawn sign; `text` explains it when the pointer rests on it.
bool icon_button(Ui& ui, const std::string& name, Icon icon, const char* text, bool enabled = true);
bool small_icon_button(Ui& ui, const std::string& name, Icon icon, const char* text, float side);
bool button(Ui& ui, const std::string& name, const char* label, bool enabled = true);
bool check_box(Ui& ui, const std::string& name, const char* label, bool* on);
void tool_tip(const char* text);  // of the widget just made
void heading(Ui& ui, const char* text);
void muted_text(Ui& ui, const char* text);          // wrapped: hints
bool section(Ui& ui, const char* text, bool open);  // a heading that folds away what follows

// A label at the left and something at the right, in two columns.
bool begin_rows(const char* id);
void row(Ui& ui, const char* label);  // what follows is in the right column
void text_row(Ui& ui, const char* label, const char* format, ...) __attribute__((format(printf, 3, 4)));
void vector_row(Ui& ui, const char* label, const math::Vec3& v, const char* format, const char* unit);
void end_rows();

// Fields that report a change only when the user has finished typing or dragging by mouse moved them.
bool number_field(Ui& ui, const std::string& name, double* value, double least, double most, const char* format,
                  float width_points);
bool vector_field(Ui& ui, const std::string& name, math::Vec3* value, double least, double most, const char* format);
bool text_field(Ui& ui, const std::string& name, const char* hint, std::string* text, float width_points = 0.0F);

// A curve over equally spaced samples, oldest first, in a box of the given height and all the width there is.
struct Curve {
  const float* values = nullptr;
  int count = 0;
  int capacity = 0;  // the right end is at this sample
  ImVec4 color;
};
void curves(Ui& ui, const char* id, const Curve* list, int count, float lowest, float highest, float height_points);
// Colour number `i` of a series of curves.
ImVec4 curve_color(const Ui& ui, int i);

}  // namespace ambf::render
