// Values of the fixed-function state that users' shaders read (gl_LightSource, gl_FrontMaterial, gl_EyePlaneS ...):
// sets the uniforms of shader_shim.h in the program in use. Main thread, context current. Private to render/.
#pragma once

#include <vector>

#include "render/drawing/shadow_map.h"
#include "render/scene/lights.h"
#include "render/scene/scene_batches.h"
#include "render/shaders/user_shaders.h"

namespace ambf::render {

// Lights and matrices of a picture, in eye coordinates. Lights beyond those of the scene are off: black.
void set_fixed_function_picture(Program& program, const Mat4& world_to_eye, const Mat4& eye_to_clip,
                                const std::vector<Light>& lights);

// gl_EyePlaneS/T/R/Q[1]: dot products with a position in eye coordinates are the coordinates of shadow2DProj in the
// map of the first light that has one picture in `shadows`. Without such a light, coordinates at which everything is
// lit.
void set_fixed_function_shadow(Program& program, const Mat4& world_to_eye, const ShadowMap& shadows);

void set_fixed_function_material(Program& program, const Surface& surface);
void set_fixed_function_place(Program& program, const Mat4& world_to_eye, const Mat4& eye_to_clip,
                              const InstanceData& instance);

}  // namespace ambf::render
