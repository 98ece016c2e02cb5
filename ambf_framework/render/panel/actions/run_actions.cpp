#include "render/panel/actions/run_actions.h"

#include <utility>

#include "render/panel/relations.h"

namespace ambf::render {

namespace {

constexpr const char* kStepBackName = "panel: before step ";
constexpr unsigned kStepsBack = 20;

}  // namespace

void RunActions::toggle_pause() {
  run_.set_paused(!frame_->run.paused);
  notices_.show(frame_->run.paused ? "running" : "paused");
}

// The state before each step is kept for a while: going back is restoring it.
void RunActions::step(unsigned steps) {
  if (steps == 0) return;
  if (steps_back_epoch_ != frame_->epoch) steps_back_.clear();
  steps_back_epoch_ = frame_->epoch;
  const std::string name = kStepBackName + std::to_string(next_step_back_);
  next_step_back_ = (next_step_back_ + 1) % kStepsBack;
  std::erase(steps_back_, name);
  steps_back_.push_back(name);
  run_.snapshot(name, "", [&run = run_, steps](const state::Outcome&) { run.step_paused(steps); });
}

void RunActions::step_back() {
  if (!can_step_back()) return;
  const std::string name = steps_back_.back();
  steps_back_.pop_back();
  ++steps_back_epoch_;  // what restoring makes of it
  run_.restore(name, "", notices_.outcome("", "cannot step back"));
}

void RunActions::reset_world() {
  held_.release_all();
  run_.reset_world();
  notices_.show("world reset");
}

void RunActions::reset_bodies() {
  run_.reset_bodies();
  notices_.show("bodies reset");
}

void RunActions::reset_mechanism(state::ObjectId body) {
  std::vector<state::ObjectId> bodies = mechanism_of(*frame_->structure, body);
  if (bodies.empty()) return;
  notices_.show(bodies.size() == 1 ? "body reset" : std::to_string(bodies.size()) + " bodies reset");
  run_.reset_bodies(std::move(bodies));
}

void RunActions::push(state::ObjectId body, const state::Push& push) {
  command_.push(body, push, notices_.outcome("", "not pushed"));
}

void RunActions::take_snapshot(const std::string& name, const std::string& path) {
  const std::string done = "snapshot " + (name.empty() ? std::string() : "'" + name + "' ") + "taken";
  run_.snapshot(name, path, notices_.outcome(done, "no snapshot"));
}

void RunActions::restore_snapshot(const std::string& name, const std::string& path) {
  held_.release_all();
  run_.restore(name, path, notices_.outcome("restored '" + (path.empty() ? name : path) + "'", "not restored"));
}

void RunActions::forget_snapshot(const std::string& name) { run_.forget(name, notices_.outcome("", "not forgotten")); }

std::vector<std::string> RunActions::snapshots() const {
  std::vector<std::string> names = run_.snapshots();
  std::erase_if(names, [](const std::string& name) { return name.rfind(kStepBackName, 0) == 0; });
  return names;
}

}  // namespace ambf::render
