#include "runtime/detail/replayed_scene.h"

#include <utility>

namespace ambf::runtime {

ReplayedScene::ReplayedScene(const SimulationOptions& options, const scene::World& world, scene::ColorTable colors,
                             inputs::Recording& recording, base::Log& log)
    : world_(world),
      recording_(recording),
      work_(options, world, std::move(colors), log, [this](RequestPtr request) { submit(std::move(request)); }) {}

ReplayedScene::~ReplayedScene() {
  RequestPtr left;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    left = std::move(request_);
  }
  if (left != nullptr) left->answer(false);
  loader_.stop();
}

void ReplayedScene::submit(RequestPtr request) {
  RequestPtr refused;
  {
    const std::lock_guard lock(mutex_);
    (stopping_ ? refused : request_) = std::move(request);
  }
  if (refused != nullptr) refused->answer(false);
  changed_.notify_all();
}

bool ReplayedScene::start_next(std::string& problem) {
  const inputs::RawRecord* raw = recording_.next(inputs::kSceneStream);
  while (raw != nullptr && raw->type != inputs::Type::scene_change) raw = recording_.next(inputs::kSceneStream);
  const auto change = raw == nullptr ? std::nullopt : raw->as<inputs::SceneChangeRecord>();
  if (!change) {
    // A recording that was cut off may lack what physics did last.
    const bool cut = raw == nullptr && (!recording_.ended_properly() || recording_.gap());
    if (!cut) problem = "a change of the scene is missing in the recording";
    return false;
  }
  ++started_;
  at_start_ = change->kind == inputs::SceneChangeRecord::Kind::start_state;
  {
    const std::lock_guard lock(mutex_);
    busy_ = true;
  }
  loader_.post([this, change = *change](bool run) {
    const state::Outcome outcome = run ? work_.repeat(change, world_) : LoaderWork::stopped();
    {
      const std::lock_guard lock(mutex_);
      busy_ = false;
      failed_ = !outcome.success;
      done_ = outcome.message;
    }
    changed_.notify_all();
  });
  return true;
}

RequestPtr ReplayedScene::next_request(std::uint64_t change, std::string& problem) {
  while (true) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return request_ != nullptr || !busy_; });
      if (request_ != nullptr && started_ == change) return std::move(request_);
      if (request_ != nullptr || started_ >= change) {
        problem = "what is loaded differs from the recording: " + done_;
        return nullptr;
      }
    }
    if (!start_next(problem)) return nullptr;
  }
}

bool ReplayedScene::is_as_recorded(std::string& problem) {
  if (!at_start_) return true;
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !busy_; });
  if (failed_) problem = done_;
  start_seen_ = !failed_;
  return !failed_;
}

}  // namespace ambf::runtime
