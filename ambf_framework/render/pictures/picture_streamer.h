// Draws the pictures that cameras publish, with or without windows, on a thread and an OpenGL context of its own,
// opened when the first picture is wanted. Reads frames like everybody else, at low priority: when drawing is slow,
// pictures are left out and nothing else happens. Published pictures show the scene only: no panel, labels or marks
// of a window. Threads: made and destroyed on one; works on one of its own.
#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "base/log.h"
#include "render/gl/offscreen_backend.h"
#include "state/abilities/observe.h"
#include "state/picture.h"

namespace ambf::render {

class PictureStreamer {
 public:
  // All three must outlive it.
  PictureStreamer(state::ObserveAbility& observe, state::PictureSink& sink, base::Log& log,
                  OffscreenBackend backend = OffscreenBackend::automatic);
  ~PictureStreamer();
  PictureStreamer(const PictureStreamer&) = delete;
  PictureStreamer& operator=(const PictureStreamer&) = delete;

 private:
  class Work;
  void run();

  state::ObserveAbility& observe_;
  state::PictureSink& sink_;
  base::Log& log_;
  const OffscreenBackend backend_;
  std::atomic<bool> stop_{false};
  std::thread thread_;  // started when a camera that publishes comes
};

}  // namespace ambf::render
