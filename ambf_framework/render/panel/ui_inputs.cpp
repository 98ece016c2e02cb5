#include "render/panel/detail/ui_inputs.h"

#include <cmath>

namespace ambf::render {

int key_of(const std::string& name) {
  struct Named {
    const char* name;
    ImGuiKey key;
  };
  constexpr Named kNames[] = {{"Tab", ImGuiKey_Tab},
                              {"Left", ImGuiKey_LeftArrow},
                              {"Right", ImGuiKey_RightArrow},
                              {"Up", ImGuiKey_UpArrow},
                              {"Down", ImGuiKey_DownArrow},
                              {"PgUp", ImGuiKey_PageUp},
                              {"PgDn", ImGuiKey_PageDown},
                              {"Home", ImGuiKey_Home},
                              {"End", ImGuiKey_End},
                              {"Insert", ImGuiKey_Insert},
                              {"Delete", ImGuiKey_Delete},
                              {"Backspace", ImGuiKey_Backspace},
                              {"Space", ImGuiKey_Space},
                              {"Enter", ImGuiKey_Enter},
                              {"Esc", ImGuiKey_Escape},
                              {"A", ImGuiKey_A},
                              {"C", ImGuiKey_C},
                              {"V", ImGuiKey_V},
                              {"X", ImGuiKey_X},
                              {"Y", ImGuiKey_Y},
                              {"Z", ImGuiKey_Z}};
  for (const Named& named : kNames) {
    if (name == named.name) return named.key;
  }
  return -1;
}

ImVec2 whole_pixel(double x, double y) {
  return {static_cast<float>(std::floor(x)), static_cast<float>(std::floor(y))};
}

int button_of(MouseButton button) { return button == MouseButton::left ? 0 : button == MouseButton::right ? 1 : 2; }

}  // namespace ambf::render
