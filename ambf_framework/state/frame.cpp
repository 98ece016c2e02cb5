#include "state/frame.h"

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

std::uint64_t state_hash(const Frame& frame) {
  StateHash hash;
  for_each_column([&](const FrameColumn& column) {
    if (column.traits().hashed) column.hash(frame, hash);
  });
  return hash.value();
}

}  // namespace ambf::state
