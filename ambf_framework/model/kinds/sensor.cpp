// Sensors: a pose in a parent, elements and what they sense. What a type does is in model/kinds/sensor/.
#include "model/kinds/sensor.h"

#include <algorithm>
#include <variant>

#include "base/hash.h"
#include "mesh/cache.h"
#include "model/kinds/placed.h"
#include "model/kinds/registry.h"
#include "model/kinds/sensor/detail/judgement.h"
#include "model/kinds/sensor/detail/ray_layout.h"
#include "model/kinds/sensor/detail/resistance_limits.h"
#include "physics/soft_body.h"
#include "state/readings.h"
#include "state/soft_bodies.h"

namespace ambf::model {
namespace {

constexpr std::size_t kUsualRays = 300;    // a step; more are reported with what they cost
constexpr double kSecondsPerRay = 0.5e-6;  // measured among some ten bodies (docs/sensors.md)

struct SavedSensor final : SavedPlaced {
  std::vector<double> numbers;
  Judgement judgement;
  std::uint32_t sensed_object = state::kNone, partner = state::kNone;  // indices into Structure::objects
};

// What a row of the catalogue holds.
struct SensorRow {
  state::SensorInfo info;
  state::ObjectId joint;  // that it measures
  std::size_t rays_per_step = 0;
};

class SensorKind final : public PlacedKind {
 public:
  SensorKind() : PlacedKind(state::sensor_kind().kind) {}

  void load(Catalogue::Impl& all, const LoadedModel& model, const LoadOptions& options,
            Findings& findings) const override {
    for (const scene::KindBlock& block : model.description.blocks)
      if (block.kind == &scene::kind::kSensor) load_sensor(all, block, model, options, findings);
    for (const scene::KindBlock& block : model.description.blocks)
      if (block.kind == &scene::kind::kSensor) report_lonely_key(all, block, findings);
  }

  void erase_block(scene::Model& model, const std::string& identifier) const override {
    std::erase_if(model.blocks, [&](const scene::KindBlock& block) {
      return block.kind == &scene::kind::kSensor && block.identity.identifier == identifier;
    });
  }
  void each_parent(const scene::Model& model, const ParentVisit& visit) const override {
    for (const scene::KindBlock& block : model.blocks)
      if (block.kind == &scene::kind::kSensor) visit(block.identity, block.as<scene::Sensor>().parent);
  }

  void add_row(const Entry& entry, const StructureDraft& draft, state::Structure& structure) const override {
    state::SensorInfo info = entry.row_as<SensorRow>().info;
    set_placed(info, entry, draft);
    const std::uint32_t joint = state::find(structure, entry.row_as<SensorRow>().joint);
    info.joint = joint == state::kNone ? state::kNone : structure.objects[joint].slot;
    auto& rows = state::table<state::SensorInfo>(structure, number());
    info.first_element = rows.empty() ? 0 : rows.back().first_element + rows.back().elements;
    rows.push_back(std::move(info));
  }

  bool accepts(const state::Command& command) const override {
    const auto* own = std::get_if<state::KindCommand>(&command);
    return own != nullptr && std::any_cast<state::SensorCommand>(&own->value) != nullptr;
  }
  bool merge(LiveWorld::Impl&, std::uint32_t, const CommandSlots&) const override { return false; }
  void transfer(StateArchive& archive, state::Command& command) const override {
    if (archive.reads()) command = state::KindCommand{state::SensorCommand{}};
  }

  void link(LiveWorld::Impl& live, std::uint32_t slot, bool) const override {
    live.resisted.resize(live.structure->bodies.size());
    read_anew(live, slot);
    if (slot + 1 < live.tables.of(number()).size()) return;
    number_keys(live);
    // Soft bodies are linked after sensors: what these would be judged by is seen with the next step.
    if (state::soft_bodies(*live.structure).empty()) judge_sensors(live, 0);
  }

  void add_actors(LiveWorld::Impl& live) const override {
    live.actors.add(StepPhase::forces, "sensors", [this, &live](double h_s) {
      std::fill(live.resisted.begin(), live.resisted.end(), 0U);
      for (std::uint32_t slot = 0; slot < live.tables.of(number()).size(); ++slot)
        sensor_at(live, slot).prepare(live, slot);
      for (std::uint32_t slot = 0; slot < live.tables.of(number()).size(); ++slot)
        sensor_at(live, slot).act(live, slot, h_s);
    });
    live.actors.add(StepPhase::readings, "sensors", [this, &live](double) {
      for (std::uint32_t slot = 0; slot < live.tables.of(number()).size(); ++slot)
        sensor_at(live, slot).read(live, slot);
    });
    live.actors.add(StepPhase::readings, "success", [&live](double) { judge_sensors(live, 1); });
  }

  void fill(const LiveWorld::Impl& live, state::Frame& frame) const override {
    const auto& infos = state::sensors(*live.structure);
    auto& rows = state::rows(frame, state::sensor_kind().column);
    auto& elements = state::sensed_elements(frame);
    if (state::SensorEventLog* log = state::sensor_events(frame)) copy_new(*live.sensor_events, *log);
    elements.resize(infos.empty() ? 0 : infos.back().first_element + infos.back().elements);
    state::sensed_contacts(frame).clear();
    for (std::uint32_t slot = 0; slot < rows.size(); ++slot) {
      LiveSensor& sensor = sensor_at(live, slot);
      sensor.refresh(live, slot);
      rows[slot] = {};
      rows[slot].T_parent_object = sensor.T_parent;
      rows[slot].T_world_object = pose(live, slot);
      rows[slot].active = sensor.active;
      rows[slot].matched = sensor.judgement.matched;
      rows[slot].success = sensor.judgement.success;
      rows[slot].success_since_s = sensor.judgement.success_since_s;
      for (std::uint32_t i = 0; i < infos[slot].elements; ++i) {
        const math::Vec3 ray = (*infos[slot].rays)[i].end - (*infos[slot].rays)[i].start;
        state::SensedElement& element = elements[infos[slot].first_element + i];
        element = element_of(sensor.hits[i], math::norm(ray));
        if (element.triggered()) element.distance_m = std::max(0.0, element.distance_m + sensor.error_m(live.steps, i));
        if (i < sensor.effects.size()) {
          element.force_world = sensor.effects[i].force_world;
          element.slipped = sensor.effects[i].slipped;
        }
        if (sensor.hits[i].any()) ++rows[slot].triggered;
      }
      state::sensor_readings(frame)[slot] = {};
      sensor.fill(live, slot, frame);
    }
  }

  void reset(LiveWorld::Impl& live, std::uint32_t slot) const override {
    set_judgement(live, slot, {});
    PlacedKind::reset(live, slot);
    bodies_reset(live, slot);
  }

  void bodies_reset(LiveWorld::Impl& live, std::uint32_t slot) const override {
    sensor_at(live, slot).reset();
    sensor_at(live, slot).refresh(live, slot);
  }

  void all_placed(LiveWorld::Impl& live, std::uint32_t slot) const override {
    sensor_at(live, slot).settle(live, slot);
  }

  std::unique_ptr<SavedObject> make_saved() const override { return std::make_unique<SavedSensor>(); }
  // Saving restarts physics, for the world that goes on as for the one that is restored: both read anew.
  void save(const LiveWorld::Impl& live, std::uint32_t slot, SavedObject& saved) const override {
    PlacedKind::save(live, slot, saved);
    read_anew(live, slot);
    auto& to = static_cast<SavedSensor&>(saved);
    sensor_at(live, slot).save(live, to.numbers);
    to.judgement = sensor_at(live, slot).judgement;
    to.sensed_object = state::find(*live.structure, to.judgement.sensed_object);
    to.partner = state::find(*live.structure, to.judgement.partner);
  }
  using PlacedKind::transfer;
  void transfer(StateArchive& archive, SavedObject& saved, const SavedContext& context) const override {
    PlacedKind::transfer(archive, saved, context);
    auto& numbers = static_cast<SavedSensor&>(saved).numbers;
    const state::SensorInfo& row = state::sensors(context.structure)[context.slot];
    const SensorType& type = *sensor_type(row.type);
    if (archive.reads()) numbers.resize(type.saved_numbers == nullptr ? 0 : type.saved_numbers(row));
    for (double& number : numbers) archive.number(number, -kMaxSaved, kMaxSaved, "what a sensor remembers");
    transfer_judgement(archive, static_cast<SavedSensor&>(saved), context.structure);
  }
  void restore(LiveWorld::Impl& live, std::uint32_t slot, const SavedObject& saved) const override {
    PlacedKind::restore(live, slot, saved);
    read_anew(live, slot);
    const auto& from = static_cast<const SavedSensor&>(saved);
    sensor_at(live, slot).restore(live, from.numbers);
    Judgement judgement = from.judgement;
    const auto id = [&](std::uint32_t object) {
      return object == state::kNone ? state::ObjectId{} : live.structure->objects[object].id;
    };
    judgement.sensed_object = id(from.sensed_object);
    judgement.partner = id(from.partner);
    set_judgement(live, slot, judgement);
  }

 private:
  static void transfer_judgement(StateArchive& archive, SavedSensor& saved, const state::Structure& structure) {
    Judgement& judgement = saved.judgement;
    archive.flag(judgement.sensed, "whether something is sensed");
    archive.flag(judgement.matched, "whether it matches");
    archive.flag(judgement.success, "whether its task is done");
    archive.count(judgement.held_steps, 0, std::uint64_t{1} << 53, "how long its condition has held");
    archive.number(judgement.success_since_s, 0.0, kMaxSaved, "since when its task is done");
    for (std::uint32_t* object : {&saved.sensed_object, &saved.partner}) {
      // The number of objects stands for none.
      std::uint64_t index = *object == state::kNone ? structure.objects.size() : *object;
      archive.count(index, 0, structure.objects.size(), "what it senses");
      *object = index == structure.objects.size() ? state::kNone : static_cast<std::uint32_t>(index);
    }
  }

  static void read_anew(const LiveWorld::Impl& live, std::uint32_t slot) {
    sensor_at(live, slot).forget();
    sensor_at(live, slot).refresh(live, slot);
  }

  // A frame comes back with the events that it had.
  static void copy_new(const state::SensorEventLog& from, state::SensorEventLog& to) {
    std::uint64_t at = to.total > from.total ? 0 : to.total;
    if (from.total - at > state::SensorEventLog::kSize) at = from.total - state::SensorEventLog::kSize;
    for (; at < from.total; ++at)
      to.last[at % state::SensorEventLog::kSize] = from.last[at % state::SensorEventLog::kSize];
    to.total = from.total;
  }

  static state::SensedElement element_of(const ElementHit& hit, double length_m) {
    state::SensedElement element;
    element.fraction = hit.fraction;
    element.distance_m = hit.fraction * length_m;
    element.point_world = hit.point;
    element.normal_world = hit.normal;
    if (!hit.any()) return element;
    if (hit.body != nullptr) element.body = hit.body->user_index();
    if (hit.soft != nullptr) element.soft_body = hit.soft->user_index();
    element.triangle = hit.triangle;
    return element;
  }

  void load_sensor(Catalogue::Impl& all, const scene::KindBlock& block, const LoadedModel& model,
                   const LoadOptions& options, Findings& findings) const {
    const auto& described = block.as<scene::Sensor>();
    const SensorType* type = sensor_type(described.type);
    if (type == nullptr) {
      return findings.information(
          block.identity, "type",
          std::string("sensors of type ") + state::name_of(described.type) + " are not simulated yet; it is left out");
    }
    SensorRow row;
    std::vector<state::SensorRay> rays;
    if (type->casts_rays && !lay_rays(all.meshes, described, block.identity, rays, findings, row.info)) return;
    const Entry* joint = nullptr;
    if (described.type == state::SensorType::force_torque) {
      joint = find_joint(all, described.joint, model.info.id);
      if (joint == nullptr)
        return findings.error(block.identity, "joint", "there is no joint \"" + described.joint + "\"",
                              "the sensor is left out");
      row.joint = joint->info.id;
    }
    row.info.contact_details = described.contact_details;
    row.info.type = described.type;
    row.info.elements = static_cast<std::uint32_t>(rays.size());
    row.info.visible = described.visible;
    row.info.visible_size_m = described.visible_size_m;
    row.info.matching_key = described.matching_key;
    row.info.success_when = described.success_when;
    row.info.hold_s = described.hold_s;
    const auto limit = static_cast<std::size_t>(std::max(0, described.rays_per_step));
    row.rays_per_step = limit == 0 ? rays.size() : std::min(limit, rays.size());
    auto live = type->make(described, rays);
    LiveSensor* sensor = live.get();
    row.info.rays = std::make_shared<const std::vector<state::SensorRay>>(std::move(rays));
    const std::string& parent =
        described.parent.empty() && joint != nullptr ? joint->child->info.identifier : described.parent;
    Entry* entry =
        add(all, std::move(live), block.identity, parent, described.T_parent_sensor, model, options, findings);
    if (entry == nullptr) return;
    base::Fnv1a identity;
    identity.add_text(entry->info.identifier);
    sensor->noise_seed = identity.value();
    entry->row = std::move(row);
    report_cost(all, *entry, block.identity, findings);
    if (described.type != state::SensorType::resistance) return;
    const Entry* carrier = all.find_parent(*entry, parent);
    for (const scene::Body& body : model.description.bodies)
      if (carrier != nullptr && carrier->info.model == model.info.id && body.mass > 0.0 &&
          body.identity.identifier == carrier->identifier)
        report_passed_limits(described, *entry->row_as<SensorRow>().info.rays, body.mass, all.options.step_s,
                             block.identity, findings);
  }

  // By its identifier in the sensor's file, else by its whole identifier.
  static const Entry* find_joint(const Catalogue::Impl& all, const std::string& wanted, state::ModelId model) {
    const Entry* found = nullptr;
    for (const auto& entry : all.entries) {
      if (!state::info_of(entry->info.kind).connects_bodies) continue;
      if (entry->info.model == model && entry->identifier == wanted) return entry.get();
      if (entry->info.identifier == wanted) found = entry.get();
    }
    return found;
  }

  void report_lonely_key(const Catalogue::Impl& all, const scene::KindBlock& block, Findings& findings) const {
    const std::string& key = block.as<scene::Sensor>().matching_key;
    if (key.empty()) return;
    const auto has_key = [&](const auto& entry) {
      return entry->info.kind == number() && entry->row.has_value() &&
             entry->template row_as<SensorRow>().info.matching_key == key;
    };
    if (std::count_if(all.entries.begin(), all.entries.end(), has_key) == 1)
      findings.information(block.identity, "matching key", "no other sensor has the key \"" + key + "\"",
                           "it matches nothing until one is loaded");
  }

  // Once: with the sensor that goes beyond what is usual.
  void report_cost(const Catalogue::Impl& all, const Entry& last, const scene::Identity& at, Findings& findings) const {
    std::size_t rays = 0;
    for (const auto& entry : all.entries)
      if (entry->info.kind == number() && entry->row.has_value()) rays += entry->row_as<SensorRow>().rays_per_step;
    if (rays <= kUsualRays || rays - last.row_as<SensorRow>().rays_per_step > kUsualRays) return;
    findings.warning(at, "range",
                     std::to_string(rays) + " rays are cast in each step, which takes about " +
                         std::to_string(std::lround(static_cast<double>(rays) * kSecondsPerRay * 1e6)) + " us",
                     "`rays per step` spreads those of a sensor over several steps");
  }
};

}  // namespace

LiveSensor& sensor_at(const LiveWorld::Impl& live, std::uint32_t slot) {
  return static_cast<LiveSensor&>(*live.tables.of(state::sensor_kind().kind)[slot]);
}

math::Pose pose_of_sensor(const LiveWorld::Impl& live, std::uint32_t slot) {
  return kind_of(state::sensor_kind().kind).pose(live, slot);
}

const physics::Body* carrier_of(const LiveWorld::Impl& live, std::uint32_t slot) {
  std::uint32_t object = state::sensors(*live.structure)[slot].parent_object;
  while (object != state::kNone) {
    const state::ObjectInfo& info = live.structure->objects[object];
    const state::KindInfo& kind = state::info_of(info.kind);
    if (kind.has_mass) return live.tables.bodies()[info.slot].body.get();
    if (!kind.has_parent) return nullptr;
    object = state::rows_of(info.kind).placed(*live.structure, info.slot)->parent_object;
  }
  return nullptr;
}

std::unique_ptr<Kind> make_sensor_kind() { return std::make_unique<SensorKind>(); }

}  // namespace ambf::model
