// A state::FrameReader over the frame pool: how comm, render and devices see the simulation. One thread each.
#pragma once

#include <memory>

#include "exchange/frame_pool.h"
#include "exchange/signal.h"
#include "state/abilities/observe.h"

namespace ambf::runtime {

using FramePool = exchange::FramePool<state::Frame>;

class PoolFrameReader final : public state::FrameReader {
 public:
  // Null when all readers are taken. Both references must outlive it.
  static std::unique_ptr<PoolFrameReader> make(FramePool& pool, exchange::Signal& published);

  const state::Frame* latest() override { return reader_.latest(); }
  const state::Frame* previous() override { return reader_.previous(); }
  bool wait_newer(std::uint64_t sequence, std::chrono::nanoseconds timeout) override;

 private:
  PoolFrameReader(FramePool::Reader reader, exchange::Signal& published)
      : reader_(std::move(reader)), published_(published) {}

  FramePool::Reader reader_;
  exchange::Signal& published_;
};

}  // namespace ambf::runtime
