// How large soft bodies may be; what is larger is left out with an error. Rooms of a step are taken at load.
#pragma once

#include <cstddef>

namespace ambf::scene {

inline constexpr std::size_t kMaxSoftNodes = 8000;  // vertices of `config`, and of the surface of tissue
// Bullet's tables for bending links grow with the square of the nodes, and beyond a distance of 2 its time with the
// cube.
inline constexpr std::size_t kMaxNodesOfFarBending = 1500;
inline constexpr std::size_t kMaxTissueElements = 20000;
inline constexpr std::size_t kMaxThreadNodes = 2000;

}  // namespace ambf::scene
