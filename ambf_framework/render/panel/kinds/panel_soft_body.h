// The entry of soft bodies in the panel's table of kinds.
#pragma once

#include "render/panel/kinds/panel_kinds.h"

namespace ambf::render {

PanelKind soft_body_panel_kind();

}  // namespace ambf::render
