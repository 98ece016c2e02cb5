// The shaders of world_shapes_renderer.h. Private to render/.
#pragma once

namespace ambf::render {

extern const char* const kDebugLineVertex;
extern const char* const kDebugLineFragment;
extern const char* const kDebugFillVertex;
extern const char* const kDebugFillFragment;
extern const char* const kDebugMeshVertex;
extern const char* const kDebugMeshFragment;

}  // namespace ambf::render
