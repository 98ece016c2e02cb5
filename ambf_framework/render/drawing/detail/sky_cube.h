// A cube of two metres around the origin, for users' sky shaders. One a context. Main thread, context current.
// Private to render/.
#pragma once

#include "render/gl/handle.h"

namespace ambf::render {

class SkyCube {
 public:
  explicit SkyCube(const Gl& gl);
  void draw() const;  // positions are attribute 0

 private:
  const Gl& gl_;
  GlVertexArray vertex_array_;
  GlBuffer corners_, indices_;
};

}  // namespace ambf::render
