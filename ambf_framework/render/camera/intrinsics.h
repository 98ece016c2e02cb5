// Where in a picture a point is, as numbers that programs calculate with. Pure functions, any thread.
#pragma once

#include "render/camera/camera.h"
#include "state/picture.h"

namespace ambf::render {

state::Intrinsics intrinsics_of(const Camera& camera, int width, int height);

// One eye of a stereo camera whose middle is `middle`. Both eyes look the same way; their pictures are shifted so
// that what is at the focal length is in the same place of both.
Camera eye_of(const Camera& middle, const state::Lens& lens, state::Eye eye);

}  // namespace ambf::render
