// What changes the structure, and what saves and restores the state: files become prepared changes, which the physics
// loop puts in force. Runs on the loader thread of a Simulation or on the caller's thread of a LocalSimulation;
// structure(), commands() and snapshots() on any thread.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "base/log.h"
#include "inputs/recorder.h"
#include "mesh/cache.h"
#include "model/catalogue.h"
#include "model/command_table.h"
#include "runtime/detail/kept_texts.h"
#include "runtime/detail/requests.h"
#include "runtime/detail/snapshots.h"
#include "runtime/options.h"
#include "scene/colors.h"
#include "scene/description.h"
#include "state/abilities/edit.h"

namespace ambf::runtime {

class LoaderWork {
 public:
  // Has the physics loop run a request, and answers it, at once or later.
  using Submit = std::function<void(RequestPtr)>;
  // `log` and `recorder` must outlive it. `recorder`: where each change is noted; null: nowhere.
  LoaderWork(const SimulationOptions& options, const scene::World& world, scene::ColorTable colors, base::Log& log,
             Submit submit, inputs::Recorder* recorder = nullptr, std::shared_ptr<mesh::MeshCache> meshes = nullptr);

  state::Outcome load_world(const scene::World& world);
  state::Outcome load_model(const state::LoadRequest& request);
  // `text`: what Save writes again; null: nothing does.
  state::Outcome load(const scene::Model& model, base::Diagnostics diagnostics, const model::LoadOptions& options,
                      std::shared_ptr<const std::string> text = nullptr, bool of_device = false,
                      bool not_saved = false);
  state::Outcome unload(const std::string& model);
  state::Outcome remove(const std::string& object);
  // A model, or the whole scene. `now`: a frame of the structure in force, for the current pose; may be null else. Not
  // noted by the recorder.
  state::Outcome save(const state::SaveModelRequest& request, const state::Frame* now);
  state::Outcome set_parent(state::ObjectId object, const std::string& parent);
  state::Outcome reset_parents();  // cameras and lights hang as they were loaded
  state::Outcome take_snapshot(const std::string& name, const std::string& path);
  state::Outcome restore_snapshot(const std::string& name, const std::string& path);
  state::Outcome forget_snapshot(const std::string& name);
  // The state from which a recording starts. `expected`: what it was when it was recorded; empty: it is recorded now.
  state::Outcome save_start(const std::vector<std::uint8_t>& expected);
  // What a recording says that was done.
  state::Outcome repeat(const inputs::SceneChangeRecord& change, const scene::World& world);

  // The structure in force.
  std::shared_ptr<const state::Structure> structure() const;
  model::CommandTable& commands() { return commands_; }
  const Snapshots& snapshots() const { return snapshots_; }

  static state::Outcome stopped();  // the outcome of whatever is not done any more

 private:
  state::Outcome save_model(const state::SaveModelRequest& request, const state::Frame* now);  // save_model.cpp
  state::Outcome save_scene(const state::SaveModelRequest& request, const state::Frame* now);  // save_scene.cpp
  // Hands a prepared change to the physics loop and waits until it is in force.
  state::Outcome apply(model::Prepared prepared, base::Diagnostics diagnostics, const std::string& done_text);
  void publish_structure();
  state::Outcome parse_and_load(const state::LoadRequest& request, bool environment);
  SaveRequest::Saved save_state();
  state::Outcome restore(const std::string& name, const std::vector<std::uint8_t>& bytes);
  // A change begins.
  void count_change(inputs::SceneChangeRecord&& change);

  base::Log& log_;
  const SimulationOptions options_;
  const scene::World world_;  // as it was described
  const scene::ColorTable colors_;
  const double step_s_;
  const Solver solver_;
  const Submit submit_;
  inputs::Recorder* const recorder_;
  std::uint64_t changes_ = 0;                      // so far: their number in a recording
  const std::shared_ptr<mesh::MeshCache> meshes_;  // its own, or shared with other worlds
  model::CommandTable commands_;
  model::Catalogue catalogue_;
  Snapshots snapshots_;
  KeptTexts texts_;
  std::shared_ptr<const std::string> world_written_;  // over the world's own file; null: nothing
  mutable std::mutex structure_mutex_;
  std::shared_ptr<const state::Structure> structure_;  // guarded
};

}  // namespace ambf::runtime
