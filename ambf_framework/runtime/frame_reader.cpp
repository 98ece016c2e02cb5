#include "runtime/detail/frame_reader.h"

namespace ambf::runtime {

std::unique_ptr<PoolFrameReader> PoolFrameReader::make(FramePool& pool, exchange::Signal& published) {
  auto reader = pool.make_reader();
  if (!reader) return nullptr;
  return std::unique_ptr<PoolFrameReader>(new PoolFrameReader(std::move(*reader), published));
}

bool PoolFrameReader::wait_newer(std::uint64_t sequence, std::chrono::nanoseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (true) {
    const auto count = published_.count();
    const state::Frame* frame = reader_.latest();
    if (frame != nullptr && frame->sequence > sequence) return true;
    const auto left = deadline - std::chrono::steady_clock::now();
    if (left <= std::chrono::nanoseconds::zero()) return false;
    published_.wait_beyond(count, left);
  }
}

}  // namespace ambf::runtime
