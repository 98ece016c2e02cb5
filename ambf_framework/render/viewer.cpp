#include "render/viewer.h"

namespace ambf::render {

std::unique_ptr<Viewer> Viewer::open(state::Control&, std::string& why) {
  why = "windows are being built";
  return nullptr;
}

}  // namespace ambf::render
