#include "adf/save.h"

#include <cmath>
#include <map>
#include <set>

#include "adf/detail/bundle.h"
#include "adf/detail/exact_rpy.h"
#include "adf/detail/fields.h"
#include "adf/detail/files.h"
#include "adf/detail/save_paths.h"
#include "adf/detail/text_edit.h"
#include "adf/report.h"
#include "math/rotation.h"
#include "scene/block_kinds.h"

namespace ambf::adf {

namespace {

constexpr double kReadBack = 1e-9;  // m, rad: a written pose that reads back worse is refused

double angle_between(const math::Pose& a, const math::Pose& b) {
  return math::norm(math::log(math::inverse(a.orientation) * b.orientation));
}

bool is_near(const math::Pose& a, const math::Pose& b, double tolerance) {
  return math::norm(a.position - b.position) <= tolerance && angle_between(a, b) <= tolerance;
}

// Identifiers of a model's blocks by the header list of their kind.
std::map<std::string, std::set<std::string>> blocks_by_list(const scene::Model& model) {
  std::map<std::string, std::set<std::string>> blocks;
  const auto add = [&blocks](const scene::Group& group, const auto& objects) {
    for (const scene::BlockKind* kind : scene::block_kinds())
      if (kind->group == &group)
        for (const auto& object : objects) blocks[std::string(kind->list.name)].insert(object.identity.identifier);
  };
  add(scene::group::kBody, model.bodies);
  add(scene::group::kJoint, model.joints);
  add(scene::group::kCamera, model.cameras);
  add(scene::group::kLight, model.lights);
  for (const scene::KindBlock& block : model.blocks)
    blocks[std::string(block.kind->list.name)].insert(block.identity.identifier);
  return blocks;
}

bool lists(const Value& root, const std::string& list, const std::string& block) {
  const auto found = root.find(list);
  for (std::size_t i = 0; found && i < found->size(); ++i)
    if (found->is_list() && found->item(i).text() == block) return true;
  return false;
}

void leave_out_gone(const Value& root, const scene::Model& before, const scene::Model& present, Change& change) {
  auto left = blocks_by_list(present);
  for (const auto& [list, blocks] : blocks_by_list(before))
    for (const std::string& block : blocks)
      if (!left[list].contains(block) && lists(root, list, block)) change.key(list).without.insert(block);
}

// The numbers of a map that differ; all of them where there is no such map.
void set_numbers(const std::optional<Value>& map, const math::Vec3& wanted, const char* const (&names)[3],
                 Change& change) {
  const Fields fields(map.value_or(Value{}));
  const double numbers[] = {wanted.x, wanted.y, wanted.z};
  for (int i = 0; i < 3; ++i) {
    const bool same = map && std::abs(fields.number(names[i], 0.0) - numbers[i]) <= kUnmoved;
    if (!same) change.key(names[i]).scalar = scene::text_of(numbers[i] == 0.0 ? 0.0 : numbers[i]);
  }
}

void set_place(const Value& block, const math::Pose& before, const math::Pose& wanted, Change& change) {
  const auto location = block.find("location");
  const auto part = [&location](const char* key) { return location ? location->find(key) : std::nullopt; };
  if (is_near(before, wanted, kUnmoved)) return;
  Change& place = change.key("location");
  if (math::norm(before.position - wanted.position) > kUnmoved)
    set_numbers(part("position"), wanted.position, {"x", "y", "z"}, place.key("position"));
  if (angle_between(before, wanted) > kUnmoved)
    set_numbers(part("orientation"), exact_rpy(wanted.orientation), {"r", "p", "y"}, place.key("orientation"));
}

const scene::Body* find_body(const scene::Model& model, const std::string& block) {
  for (const scene::Body& body : model.bodies)
    if (body.identity.identifier == block) return &body;
  return nullptr;
}

void set_places(const Value& root, const scene::Model& before, const std::vector<BodyPlace>& places, Change& change) {
  for (const BodyPlace& place : places) {
    const scene::Body* body = find_body(before, place.block);
    const auto block = root.find(place.block);
    if (body == nullptr || !block || !lists(root, "bodies", place.block)) continue;
    Change moved;
    set_place(*block, body->T_world_body, place.T_world_body, moved);
    if (!moved.empty()) change.key(place.block) = std::move(moved);
  }
}

std::size_t errors_in(const base::Diagnostics& diagnostics) {
  std::size_t errors = 0;
  for (const base::Diagnostic& diagnostic : diagnostics) errors += diagnostic.severity == base::Severity::error;
  return errors;
}

base::Diagnostic error_at(const SaveOrder& order, const std::string& block, const std::string& message,
                          const std::string& hint) {
  return {base::Severity::error, order.to, 0, 0, block, "", message, hint};
}

// Reads the new text as Load will, and compares.
void check_reading_back(const SaveOrder& order, const Options& options, const ModelResult& before,
                        const std::string& text, SavedModel& saved) {
  ModelResult after = parse_model(text, order.to, options);
  const auto refuse = [&](const std::string& block, const std::string& message, const std::string& hint) {
    saved.diagnostics.push_back(error_at(order, block, message, hint));
  };
  if (!after.model || errors_in(after.diagnostics) > errors_in(before.diagnostics)) {
    for (base::Diagnostic& found : after.diagnostics)
      if (found.severity == base::Severity::error) saved.diagnostics.push_back(std::move(found));
    return refuse("", "the written file would have more errors than the one that was read",
                  "write it to the folder of the original, or give its meshes absolute paths");
  }
  for (const BodyPlace& place : order.places) {
    const scene::Body* body = find_body(*after.model, place.block);
    if (body != nullptr && lists(after.document->root(), "bodies", place.block) &&
        !is_near(body->T_world_body, place.T_world_body, kReadBack))
      refuse(place.block, "its place would not read back", "give it a `location` with `position` and `orientation`");
  }
}

}  // namespace

SavedModel save_model(const SaveOrder& order, const Options& options) {
  SavedModel saved;
  const ModelResult before = parse_model(order.text, order.from, options);
  if (!before.model || !before.document) {
    saved.diagnostics.push_back(error_at(order, "", "the text of the model cannot be read any more", "load it again"));
    return saved;
  }
  const Value root = before.document->root();
  Change change = moved_paths(root, folder_of(order.from), folder_of(order.to));
  if (order.bundle) {
    Bundle bundle = bundle_of(root, order.from, order.to);
    add_to(change, std::move(bundle.change));
    saved.copies = std::move(bundle.copies);
    for (const std::string& mesh : bundle.missing) {
      saved.diagnostics.push_back({base::Severity::warning, order.from, 0, 0, "", "mesh",
                                   "the mesh " + quoted(mesh) + " is nowhere: the bundle is without it",
                                   "put it where the model says, and save again"});
    }
  }
  if (order.present != nullptr) leave_out_gone(root, *before.model, *order.present, change);
  Change places;
  set_places(root, *before.model, order.places, places);
  for (auto& [block, place] : places.keys)
    for (auto& [key, value] : place.keys) change.key(block).key(key) = std::move(value);
  if (change.empty()) {
    saved.text = order.text;
    return saved;
  }
  EditedText edited = edit(order.text, *before.document, change);
  if (edited.error) {
    saved.diagnostics.push_back({base::Severity::error, order.from, edited.error->mark.line, edited.error->mark.column,
                                 "", "", edited.error->message, edited.error->hint});
    return saved;
  }
  Options of_reading = options;
  of_reading.look_for_files = options.look_for_files && !order.bundle;  // nothing has been copied yet
  check_reading_back(order, of_reading, before, *edited.text, saved);
  if (!base::has_errors(saved.diagnostics)) saved.text = std::move(edited.text);
  return saved;
}

}  // namespace ambf::adf
