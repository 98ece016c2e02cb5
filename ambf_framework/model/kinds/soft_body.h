// The kind of soft bodies (model/kinds/soft_body.cpp).
#pragma once

#include <memory>

namespace ambf::model {

class Kind;  // model/kinds/kind.h

std::unique_ptr<Kind> make_soft_body_kind();

}  // namespace ambf::model
