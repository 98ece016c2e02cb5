#include "adf/detail/actuator_parser.h"

#include <algorithm>

#include "adf/detail/bind.h"
#include "scene/actuator.h"
#include "scene/soft_body.h"

namespace ambf::adf {

namespace {

using state::Trigger;

constexpr std::size_t kMaxEdgePoints = 32;

// A word, or a map that names a jaw.
void read_trigger(const Fields& fields, scene::Actuator& actuator, Report& report) {
  const auto trigger = fields.find("trigger");
  if (!trigger) return;
  if (trigger->is_map()) {
    actuator.trigger = Trigger::jaw;
    fill(*trigger, *scene::find_key(*scene::kind::kActuator.group, "trigger")->sub, actuator);
    return;
  }
  const std::string word = fields.text("trigger");
  if (word == "sensor") {
    actuator.trigger = Trigger::sensor;
  } else if (word == "contact" && actuator.type == state::ActuatorType::blade) {
    actuator.trigger = Trigger::contact;
  } else if (word != "command") {
    report.warning(fields.mark("trigger"), "trigger", "expected command, sensor or {jaw: BODY}, found " + word,
                   "it counts as command");
  }
}

// Keys that only one type has.
void refuse_keys_of_others(const Fields& fields, state::ActuatorType type, Report& report) {
  struct Own {
    const char* key;
    state::ActuatorType type;
    const char *of, *instead;
  };
  using state::ActuatorType;
  constexpr Own kOwn[] = {
      {"edge", ActuatorType::blade, "is of blades, and has no effect", "`type: Blade` cuts"},
      {"sharpness", ActuatorType::blade, "is of blades, and has no effect", "`type: Blade` cuts"},
      {"arc", ActuatorType::needle, "is of needles, and has no effect", "`type: Needle` sews"},
      {"puncture force", ActuatorType::needle, "is of needles, and has no effect", "`type: Needle` sews"},
      {"friction", ActuatorType::needle, "is of needles, and has no effect", "`type: Needle` sews"},
      {"thread", ActuatorType::needle, "is of needles, and has no effect", "`type: Needle` sews"}};
  for (const Own& each : kOwn)
    if (each.type != type && fields.has(each.key))
      report.warning(fields.mark(each.key), each.key, each.of, each.instead);
}

// False: there is none.
bool read_places(const Fields& fields, const scene::Actuator& actuator, const char* key, const char* what,
                 std::vector<math::Vec3>& places, Report& report) {
  const std::string left_out = std::string("the ") + what + " is left out";
  double length = 0.0;
  for (const Fields& each : fields.maps(key)) {
    for (const char* axis : {"x", "y", "z"})
      if (!each.has(axis))
        report.warning(each.mark(), std::string(key) + "/" + axis, "missing: it counts as 0", "give it");
    const math::Vec3 at{each.number("x", 0.0), each.number("y", 0.0), each.number("z", 0.0)};
    if (!places.empty()) length += math::norm(at - places.back());
    places.push_back(at);
  }
  if (places.size() < 2 || !(length > 0.0)) {
    report.error(fields.mark(key), key,
                 "expected at least two places that differ, found " + std::to_string(places.size()),
                 std::string("give the ") + key + " as [{x, y, z}, {x, y, z}] in the parent's body frame; " + left_out);
    return false;
  }
  if (places.size() > kMaxEdgePoints) {
    report.error(
        fields.mark(key), key,
        "expected at most " + std::to_string(kMaxEdgePoints) + " places, found " + std::to_string(places.size()),
        left_out);
    return false;
  }
  if (actuator.parent.empty()) {
    report.error(fields.mark("parent"), "parent", std::string("missing: a ") + what + " is a body's", left_out);
    return false;
  }
  return true;
}

// False: it has no edge or arc.
bool read_shape(const Fields& fields, scene::Actuator& actuator, Report& report) {
  refuse_keys_of_others(fields, actuator.type, report);
  if (actuator.type == state::ActuatorType::blade)
    return read_places(fields, actuator, "edge", "blade", actuator.edge, report);
  if (actuator.type != state::ActuatorType::needle) return true;
  constexpr double kStrength_N = 5.0;
  if (!fields.has("strength")) actuator.strength_N = kStrength_N;
  if (actuator.strength_N == 0.0)
    report.warning(fields.mark("strength"), "strength", "0: each puncture tears out at once", "give it in N");
  for (const char* key : {"trigger", "sensor"})
    if (fields.has(key))
      report.warning(fields.mark(key), key, "has no effect: a needle sews what its tip is pressed into",
                     "leave it out");
  return read_places(fields, actuator, "arc", "needle", actuator.arc, report);
}

// Whether a joint with limits is below a body of `model`; true for what it does not have.
bool may_be_jaw(const scene::Model& model, const std::string& root) {
  const auto is_root = [&](const scene::Body& body) { return body.identity.identifier == root; };
  if (std::none_of(model.bodies.begin(), model.bodies.end(), is_root)) return true;
  std::vector<std::string> below{root};
  for (std::size_t at = 0; at < below.size(); ++at)
    for (const scene::Joint& joint : model.joints) {
      if (joint.parent != below[at]) continue;
      if (joint.limits) return true;
      if (std::find(below.begin(), below.end(), joint.child) == below.end()) below.push_back(joint.child);
    }
  return false;
}

// False for what the model does not have.
bool is_other_than_thread(const scene::Model& model, const std::string& name) {
  return std::any_of(model.blocks.begin(), model.blocks.end(), [&](const scene::KindBlock& block) {
    if (block.kind != &scene::kind::kSoftBody || block.identity.identifier != name) return false;
    const auto& soft = block.as<scene::SoftBody>();
    return !soft.is_tissue || soft.tissue.kind != scene::TissueKind::thread;
  });
}

// Another needle of the file, before this one, that draws the same thread; null: none.
const scene::KindBlock* other_needle(const scene::Model& model, const scene::KindBlock& needle) {
  const std::string& thread = needle.as<scene::Actuator>().thread;
  for (const scene::KindBlock& block : model.blocks) {
    if (&block == &needle) return nullptr;
    if (block.kind == &scene::kind::kActuator && !thread.empty() && block.as<scene::Actuator>().thread == thread)
      return &block;
  }
  return nullptr;
}

}  // namespace

std::optional<scene::KindBlock> parse_actuator(const Block& block, const FileContext& file, NameBook& names) {
  const Fields& fields = block.fields;
  auto actuator = std::make_shared<scene::Actuator>(
      read<scene::Actuator>(fields.value(), *scene::kind::kActuator.group, file.options.defaults));
  Report& report = file.report;
  read_trigger(fields, *actuator, report);
  if (!read_shape(fields, *actuator, report)) return std::nullopt;
  if (actuator->type == state::ActuatorType::needle) actuator->trigger = Trigger::command;
  const bool needs_sensor =
      actuator->type == state::ActuatorType::blade || actuator->type == state::ActuatorType::needle
          ? actuator->trigger == Trigger::sensor
          : actuator->trigger != Trigger::command;
  if (needs_sensor && actuator->sensor.empty()) {
    report.error(fields.mark("trigger"), "sensor", "missing: the trigger grasps what a sensor senses",
                 "name the sensor with `sensor`");
    return std::nullopt;
  }
  if (actuator->type == state::ActuatorType::magnet) {
    if (actuator->sensor.empty()) {
      report.error(fields.mark("sensor"), "sensor", "missing: a magnet pulls what a sensor senses",
                   "name the sensor with `sensor`");
      return std::nullopt;
    }
    if (actuator->strength_N == 0.0)
      report.warning(fields.mark("strength"), "strength", "0: the magnet pulls nothing", "give it in N");
  }
  if (actuator->max_impulse == 0.0)
    report.warning(fields.mark("max impulse"), "max impulse", "0: what it holds is held by no force",
                   "leave the key out for no bound");
  if (actuator->tau == 0.0)
    report.warning(fields.mark("tau"), "tau", "0: errors are never taken back", "1 is the default");
  return scene::KindBlock{&scene::kind::kActuator, parse_identity(block, file, names), std::move(actuator)};
}

void check_actuators(const scene::Model& model, Report& report) {
  for (const scene::KindBlock& block : model.blocks) {
    if (block.kind != &scene::kind::kActuator) continue;
    const auto& actuator = block.as<scene::Actuator>();
    if (is_other_than_thread(model, actuator.thread)) {
      report.set_block(block.identity.identifier);
      report.warning({block.identity.where.line, block.identity.where.column}, "thread",
                     in_quotes(actuator.thread) + " is no thread: the needle draws none",
                     "give that soft body `tissue: {kind: thread, points: [...]}`");
    }
    if (const scene::KindBlock* const other = other_needle(model, block)) {
      report.set_block(block.identity.identifier);
      report.warning({block.identity.where.line, block.identity.where.column}, "thread",
                     in_quotes(actuator.thread) + " is drawn by " + in_quotes(other->identity.identifier) +
                         ", too: it hangs on the one that took it last, and sews by that one only",
                     "give each needle a thread of its own");
    }
    if (actuator.trigger != Trigger::jaw || may_be_jaw(model, actuator.jaw)) continue;
    report.set_block(block.identity.identifier);
    report.warning({block.identity.where.line, block.identity.where.column}, "trigger/jaw",
                   "no joint with limits is below " + in_quotes(actuator.jaw) + " in this file",
                   "without one it is neither open nor closed, and nothing is held");
  }
  report.set_block({});
}

}  // namespace ambf::adf
