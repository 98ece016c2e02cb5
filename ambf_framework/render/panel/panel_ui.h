// The panel as a user sees it: takes what happens in its window, shows PanelModel and calls its actions. Makes a list
// of triangles and draws nothing itself (panel_renderer.h does), so it runs without a window. Main thread. Private to
// render/.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "render/panel/panel_model.h"
#include "render/window/input.h"

struct ImDrawData;
struct ImFontAtlas;

namespace ambf::render {

class ViewCamera;
struct WindowMoment;
struct PanelPaper;
struct WidgetPlace;

// What the panel can do with the program around it; each may be missing.
struct PanelHost {
  std::function<void(const std::string&)> set_clipboard;
  std::function<std::string()> clipboard;
};

class PanelUi {
 public:
  PanelUi(PanelModel& model, PanelHost host);
  ~PanelUi();
  PanelUi(const PanelUi&) = delete;
  PanelUi& operator=(const PanelUi&) = delete;

  bool open() const;
  void set_open(bool open);

  // What happened in the window that shows the panel. True when it was meant for the panel or, in the
  // scene, for the gizmo of what is selected.
  bool on_input(const WindowMoment& moment, const Input& input);

  // Lays out this picture. Nothing but an empty list while closed.
  void build(const WindowMoment& moment);
  const ImDrawData* drawing() const;  // of the last build(); null: nothing
  ImFontAtlas& fonts();               // may have changed when fonts_version() has
  unsigned fonts_version() const;

  // Where a widget was in the last picture, in its pixels; null: it was not shown. For tests, and for what points at
  // it.
  const WidgetPlace* place(const std::string& widget) const;
  PanelPaper paper() const;
  float left_edge() const;  // of the panel, px
  int covered() const;      // of the window's width in the last picture, px; 0 while closed

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ambf::render
