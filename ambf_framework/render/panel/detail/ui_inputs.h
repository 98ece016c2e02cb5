// Our keys, buttons and positions as Dear ImGui counts them. Private to render/panel/. Pure functions, any thread.
#pragma once

#include <imgui/imgui.h>

#include <string>

#include "render/window/input.h"

namespace ambf::render {

int key_of(const std::string& name);  // -1: it has none
int button_of(MouseButton button);
ImVec2 whole_pixel(double x, double y);  // rounded as it rounds itself

}  // namespace ambf::render
