#include "adf/save.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "adf/detail/bundle.h"
#include "adf/detail/exact_rpy.h"
#include "adf/detail/fields.h"
#include "adf/detail/files.h"
#include "adf/detail/save_paths.h"
#include "adf/detail/save_present.h"
#include "adf/detail/text_edit.h"
#include "adf/report.h"
#include "math/rotation.h"
#include "scene/block_kinds.h"

namespace ambf::adf {

namespace {

constexpr double kReadBack = 1e-9;  // m, rad: a written pose that reads back worse is refused

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

void leave_out_gone(const Value& root, const scene::Model& before, const scene::Model& present, Change& change) {
  auto left = blocks_by_list(present);
  for (const auto& [list, blocks] : blocks_by_list(before))
    for (const std::string& block : blocks)
      if (!left[list].contains(block) && lists(root, list, block)) change.key(list).without.insert(block);
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
  for (const BodyPlace& place : order.present.bodies) {
    const scene::Body* body = find_body(*after.model, place.block);
    if (body != nullptr && lists(after.document->root(), "bodies", place.block) &&
        !is_near(body->T_world_body, place.T_world_body, kReadBack))
      refuse(place.block, "its place would not read back", "give it a `location` with `position` and `orientation`");
  }
}

void set_conflict_numbers(const Value& root, const std::map<std::string, std::string>& numbers, Change& change) {
  constexpr const char* kKey = "conflict numbers";
  const auto old = root.find(kKey);
  for (std::size_t i = 0; old && old->is_map() && i < old->size(); ++i) {
    const auto [block, number] = old->entry(i);
    if (block.is_scalar() && !numbers.contains(block.text()) && number.text() != "0")
      change.key(kKey).key(block.text()).scalar = "0";
  }
  for (const auto& [block, number] : numbers) {
    const auto is = old ? old->find(block) : std::nullopt;
    if (!is || is->text() != number) change.key(kKey).key(block).scalar = number.empty() ? "0" : number;
  }
}

// Writes changed values into a text: those of all blocks at once, or, where one of them cannot be written, each alone.
// `reads`: does a text give a block what is wanted? What cannot be written is said.
template <class Reads>
void add_tuned(std::string& text, const std::string& file, const Present& present, const Reads& reads,
               base::Diagnostics& diagnostics) {
  if (present.tuned_bodies.empty() && present.tuned_joints.empty() && present.cameras.empty() && present.lights.empty())
    return;
  const Document document(text);
  const std::vector<TunedBlock> blocks = tuned_blocks(document.root(), present);
  if (blocks.empty()) return;
  Change all;
  for (const TunedBlock& tuned : blocks) add_to(all.key(tuned.block), tuned.change);
  const auto good = [&](const EditedText& edited) {
    return edited.text && std::all_of(blocks.begin(), blocks.end(),
                                      [&](const TunedBlock& tuned) { return reads(*edited.text, tuned.block); });
  };
  constexpr std::size_t kTogether = 200;  // each is read once: of larger models the whole text counts
  const EditedText edited = edit(text, document, all);
  if (blocks.size() <= kTogether ? good(edited) : edited.text && reads(*edited.text, blocks.front().block)) {
    text = *edited.text;
    return;
  }
  std::string not_written;
  for (const TunedBlock& tuned : blocks) {
    Change one;
    one.key(tuned.block) = tuned.change;
    const EditedText with_it = edit(text, Document(text), one);
    if (with_it.text && reads(*with_it.text, tuned.block)) {
      text = *with_it.text;
    } else {
      not_written += (not_written.empty() ? "" : ", ") + in_quotes(tuned.block);
    }
  }
  if (not_written.empty()) return;
  diagnostics.push_back({base::Severity::information, file, 0, 0, "", "",
                         "values of " + not_written + " that were changed while it ran have no key that gives them",
                         "they are written as they were read"});
}

// Of a simulation without a world file.
std::string text_of_world(const scene::World& world) {
  const auto vector = [](const math::Vec3& v) {
    return "{x: " + scene::text_of(v.x) + ", y: " + scene::text_of(v.y) + ", z: " + scene::text_of(v.z) + "}";
  };
  std::string text = "# The world of a scene that was started without a world file.\n";
  if (!world.name_space.empty()) text += "namespace: " + as_scalar(world.name_space) + "\n";
  text += "enclosure: {length: " + scene::text_of(world.enclosure.x) + ", width: " + scene::text_of(world.enclosure.y) +
          ", height: " + scene::text_of(world.enclosure.z) + "}\n";
  if (world.max_iterations_given) text += "max iterations: " + std::to_string(world.max_iterations) + "\n";
  text += "gravity: " + vector(world.gravity) + "\n";
  if (!world.solver.empty()) text += "solver: " + as_scalar(world.solver) + "\n";
  return text;
}

}  // namespace

double angle_between(const math::Pose& a, const math::Pose& b) {
  return math::norm(math::log(math::inverse(a.orientation) * b.orientation));
}

bool is_near(const math::Pose& a, const math::Pose& b, double tolerance) {
  return math::norm(a.position - b.position) <= tolerance && angle_between(a, b) <= tolerance;
}

bool lists(const Value& root, const std::string& list, const std::string& block) {
  const auto found = root.find(list);
  for (std::size_t i = 0; found && i < found->size(); ++i)
    if (found->is_list() && found->item(i).text() == block) return true;
  return false;
}

void set_numbers(const std::optional<Value>& map, const math::Vec3& wanted, const char* const (&names)[3],
                 Change& change) {
  const Fields fields(map.value_or(Value{}));
  const double numbers[] = {wanted.x, wanted.y, wanted.z};
  for (int i = 0; i < 3; ++i) {
    const bool same = map && std::abs(fields.number(names[i], 0.0) - numbers[i]) <= kUnmoved;
    if (!same) change.key(names[i]).scalar = scene::text_of(numbers[i] == 0.0 ? 0.0 : numbers[i]);
  }
}

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
                                   "the mesh " + in_quotes(mesh) + " is nowhere: the bundle is without it",
                                   "put it where the model says, and save again"});
    }
  }
  if (order.left != nullptr) leave_out_gone(root, *before.model, *order.left, change);
  Change places;
  set_places(root, *before.model, order.present.bodies, places);
  set_views(root, before.model->cameras, before.model->lights, order.present, places);
  for (auto& [block, place] : places.keys) add_to(change.key(block), std::move(place));
  set_conflict_numbers(root, order.conflict_numbers, change);

  Options of_reading = options;
  of_reading.look_for_files = options.look_for_files && !order.bundle;  // nothing has been copied yet
  const auto make = [&](const Change& wanted) -> std::optional<std::string> {
    if (wanted.empty()) return order.text;
    EditedText edited = edit(order.text, *before.document, wanted);
    if (edited.error) {
      saved.diagnostics.push_back({base::Severity::error, order.from, edited.error->mark.line,
                                   edited.error->mark.column, "", "", edited.error->message, edited.error->hint});
      return std::nullopt;
    }
    check_reading_back(order, of_reading, before, *edited.text, saved);
    return base::has_errors(saved.diagnostics) ? std::nullopt : std::move(edited.text);
  };
  saved.text = make(change);
  if (!saved.text) return saved;
  const auto reads = [&](const std::string& text, const std::string& block) {
    const ModelResult after = parse_model(text, order.to, of_reading);
    return after.model && errors_in(after.diagnostics) <= errors_in(before.diagnostics) &&
           reads_as_tuned(*after.model, order.present, block);
  };
  add_tuned(*saved.text, order.to, order.present, reads, saved.diagnostics);
  return saved;
}

SavedModel save_world(const SaveWorldOrder& order, const Options& options) {
  SavedModel saved;
  std::string text = order.text.empty() ? text_of_world(*order.world) : order.text;
  if (order.views != nullptr) text += text_of_moved_defaults(text, *order.views, order.present);
  const WorldResult before = parse_world(text, order.from, options);
  const Document document(text);
  if (!before.world || document.error()) {
    saved.diagnostics.push_back(
        {base::Severity::error, order.to, 0, 0, "", "", "the text of the world cannot be read any more", ""});
    return saved;
  }
  const Value root = document.root();
  Change change = moved_paths(root, folder_of(order.from), folder_of(order.to));
  if (!order.environment.empty()) change.key("environment").scalar = order.environment;
  if (order.gravity) {
    Change gravity;
    set_numbers(root.find("gravity"), *order.gravity, {"x", "y", "z"}, gravity);
    if (!gravity.empty()) change.key("gravity") = std::move(gravity);
  }
  Change views;
  set_views(root, before.world->cameras, before.world->lights, order.present, views);
  for (auto& [block, place] : views.keys) add_to(change.key(block), std::move(place));
  EditedText edited = edit(text, document, change);
  if (edited.error) {
    saved.diagnostics.push_back({base::Severity::error, order.from, edited.error->mark.line, edited.error->mark.column,
                                 "", "", edited.error->message, edited.error->hint});
    return saved;
  }
  const auto reads = [&](const std::string& changed, const std::string& block) {
    const WorldResult after = parse_world(changed, order.from, options);
    if (!after.world || errors_in(after.diagnostics) > errors_in(before.diagnostics)) return false;
    scene::Model views_of_it;
    views_of_it.cameras = after.world->cameras;
    views_of_it.lights = after.world->lights;
    return reads_as_tuned(views_of_it, order.present, block);
  };
  saved.text = std::move(edited.text);
  add_tuned(*saved.text, order.to, order.present, reads, saved.diagnostics);
  return saved;
}

}  // namespace ambf::adf
