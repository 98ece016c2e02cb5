#include "state/frame.h"

#include <algorithm>

#include "state/columns.h"

namespace ambf::state {

std::unique_ptr<Frame> make_frame(std::shared_ptr<const Structure> structure) {
  auto frame = std::make_unique<Frame>();
  for_each_column([&](const FrameColumn& column) { column.make(*structure, *frame); });
  for (std::size_t i = 0; i < structure->cameras.size(); ++i) frame->cameras[i].lens = structure->cameras[i].lens;
  for (std::size_t i = 0; i < structure->lights.size(); ++i) frame->lights[i].beam = structure->lights[i].beam;
  frame->structure = std::move(structure);
  return frame;
}

std::string frozen_text(const Frame& frame) {
  const auto first =
      std::find_if(frame.bodies.begin(), frame.bodies.end(), [](const BodyState& body) { return body.frozen; });
  if (first == frame.bodies.end()) return {};
  const auto slot = static_cast<std::size_t>(first - frame.bodies.begin());
  const std::string& name = frame.structure->objects[frame.structure->bodies[slot].object].name;
  if (frame.frozen_bodies == 1) return name + " is frozen";
  const std::uint32_t more = frame.frozen_bodies - 1;
  return name + " and " + std::to_string(more) + (more == 1 ? " more body are frozen" : " more bodies are frozen");
}

std::uint64_t state_hash(const Frame& frame) {
  StateHash hash;
  for_each_column([&](const FrameColumn& column) {
    if (column.traits().hashed) column.hash(frame, hash);
  });
  return hash.value();
}

}  // namespace ambf::state
