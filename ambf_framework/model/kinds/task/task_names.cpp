#include "model/kinds/task/detail/task_names.h"

#include "scene/lookup.h"
#include "state/kinds.h"
#include "state/sensors.h"

namespace ambf::model {

TaskNames::TaskNames(const Catalogue::Impl& all, const scene::Identity& identity, const LoadedModel& model,
                     const LoadOptions& options, Findings& findings)
    : all_(all),
      identity_(identity),
      model_(model.info.id),
      name_space_(all.full_namespace(identity, options)),
      findings_(findings) {}

const Entry* TaskNames::body(const std::string& wanted, scene::Location where, const std::string& key) {
  return find(wanted, "body", where, key, [](state::ObjectKind kind) { return state::info_of(kind).has_mass; });
}

const Entry* TaskNames::placed(const std::string& wanted, scene::Location where, const std::string& key) {
  return find(wanted, "object", where, key,
              [](state::ObjectKind kind) { return !state::info_of(kind).connects_bodies; });
}

const Entry* TaskNames::sensor(const std::string& wanted, scene::Location where, const std::string& key) {
  return find(wanted, "sensor", where, key, [](state::ObjectKind kind) { return kind == state::sensor_kind().kind; });
}

void TaskNames::error(scene::Location where, const std::string& key, const std::string& message) {
  good_ = false;
  scene::Identity at = identity_;
  if (where.line > 0) at.where = where;
  findings_.error(at, key, message, "the task is left out");
}

// Those of the task's own file come first.
const Entry* TaskNames::find(const std::string& wanted, const char* what, scene::Location where, const std::string& key,
                             bool (*allowed)(state::ObjectKind)) {
  std::vector<std::string> own, world;
  std::vector<const Entry*> own_entries, world_entries;
  for (const auto& entry : all_.entries) {
    if (!allowed(entry->info.kind)) continue;
    world.push_back(entry->info.identifier);
    world_entries.push_back(entry.get());
    if (entry->info.model != model_) continue;
    own.push_back(entry->own_identifier);
    own_entries.push_back(entry.get());
  }
  const scene::Lookup found = scene::find_joint_body(own, world, wanted, name_space_, {});
  if (found.index) return (found.in_world ? world_entries : own_entries)[*found.index];
  good_ = false;
  scene::Identity at = identity_;
  if (where.line > 0) at.where = where;
  if (found.candidates.empty()) {
    report_absent(at, key, wanted, what, world);
  } else {
    findings_.error(at, key, "\"" + wanted + "\" may mean several", "the task is left out: write the whole name");
  }
  return nullptr;
}

void TaskNames::report_absent(const scene::Identity& at, const std::string& key, const std::string& wanted,
                              const char* what, const std::vector<std::string>& known) {
  if (all_.options.frames == 0 && known.empty())  // a file of tasks alone that is checked, not loaded
    return findings_.information(at, key, "no " + std::string(what) + " of this file is called \"" + wanted + "\"",
                                 "it must come from a file that is loaded, or checked, before");
  const std::string near = scene::nearest(wanted, known);
  findings_.error(at, key, "there is no " + std::string(what) + " \"" + wanted + "\"",
                  near.empty() ? "the task is left out; load what it names first"
                               : "did you mean \"" + near + "\"? The task is left out");
}

}  // namespace ambf::model
