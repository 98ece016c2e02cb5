#include "runtime/detail/step_frames.h"

#include <utility>

namespace ambf::runtime {

class StepFrames::Reader final : public state::StepReader {
 public:
  explicit Reader(StepFrames& frames) : frames_(frames) {}
  ~Reader() override { frames_.end(); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  const state::Frame* next() override {
    if (read_ != nullptr) frames_.empty_.try_push(std::move(read_));
    read_ = nullptr;
    frames_.filled_.try_pop(read_);
    return read_.get();
  }

 private:
  StepFrames& frames_;
  std::unique_ptr<state::Frame> read_;
};

std::unique_ptr<state::StepReader> StepFrames::read(const std::shared_ptr<const state::Structure>& structure) {
  if (taken_.exchange(true)) return nullptr;
  for (std::size_t i = 0; i < kCapacity; ++i) empty_.try_push(state::make_frame(structure));
  wanted_.store(true, std::memory_order_release);
  return std::make_unique<Reader>(*this);
}

void StepFrames::end() {
  wanted_.store(false, std::memory_order_release);
  std::unique_ptr<state::Frame> frame;
  while (empty_.try_pop(frame) || filled_.try_pop(frame)) {
  }
  taken_.store(false);
}

std::unique_ptr<state::Frame> StepFrames::take_empty(const std::shared_ptr<const state::Structure>& structure) {
  std::unique_ptr<state::Frame> frame;
  if (!empty_.try_pop(frame)) return nullptr;
  if (frame->structure != structure) frame = state::make_frame(structure);
  return frame;
}

}  // namespace ambf::runtime
