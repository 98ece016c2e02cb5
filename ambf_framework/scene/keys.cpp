#include "scene/keys.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "scene/block_kinds.h"
#include "scene/detail/group_owners.h"
#include "scene/detail/groups.h"
#include "scene/task.h"
#include "scene/tissue.h"

namespace ambf::scene {

namespace {

using namespace group;

constexpr std::array kGroups = {&kModel,
                                &kWorld,
                                &kLaunch,
                                &kIdentity,
                                &kBody,
                                &kVisual,
                                &kCollision,
                                &kColor,
                                &kJoint,
                                &kCamera,
                                &kLight,
                                &kPose,
                                &kGeometry,
                                &kDrawnItem,
                                &kPlacedShape,
                                &kInertia,
                                &kFriction,
                                &kBodyDamping,
                                &kCartesianController,
                                &kGains,
                                &kJointGains,
                                &kRates,
                                &kColorRgba,
                                &kColorComponents,
                                &kRgb,
                                &kAmbient,
                                &kShaders,
                                &kJointLimits,
                                &kMimic,
                                &kRangeXyz,
                                &kLinearAngular,
                                &kGeometryData,
                                &kClippingPlane,
                                &kIntrinsics,
                                &kWindowResolution,
                                &kStereo,
                                &kResolution,
                                &kDepthNoise,
                                &kMouse,
                                &kAttenuation,
                                &kEnclosure,
                                &kSkybox,
                                &kConflictNumber,
                                &kPlacement,
                                &kPlugin,
                                &kSoftBody,
                                &kSoftConfig,
                                &kTissue,
                                &kTissueRelaxation,
                                &kTissueRegion,
                                &kGhostObject,
                                &kVehicle,
                                &kWheel,
                                &kSuspension,
                                &kSteeringLimits,
                                &kVolume,
                                &kImages,
                                &kPointCloud,
                                &kSensor,
                                &kRay,
                                &kParametric,
                                &kRayWrap,
                                &kSensorFriction,
                                &kSensorNoise,
                                &kResistiveSurface,
                                &kSurfaceFriction,
                                &kActuator,
                                &kTrigger,
                                &kEdgePoint,
                                &kThreadPoint,
                                &kArcPoint,
                                &kTask,
                                &kTaskGoal,
                                &kInputDevices,
                                &kInputDevice,
                                &kDeviceDriver,
                                &kHapticGain,
                                &kControllerGain,
                                &kDeviceGains,
                                &kButtonMapping};

std::vector<const BlockKind*>& registered_kinds() {
  static std::vector<const BlockKind*> kinds = {&kind::kBody,     &kind::kSoftBody, &kind::kGhostObject, &kind::kSensor,
                                                &kind::kActuator, &kind::kJoint,    &kind::kVehicle,     &kind::kCamera,
                                                &kind::kLight,    &kind::kVolume,   &kind::kPointCloud,  &kind::kTask};
  return kinds;
}

void add_group(const Group& added, std::vector<const Group*>& groups) {
  if (std::find(groups.begin(), groups.end(), &added) != groups.end()) return;
  groups.push_back(&added);
  for (const Key& key : added.keys) {
    if (key.sub != nullptr) add_group(*key.sub, groups);
  }
}

std::string components_of(const math::Vec3& v) {
  if (v.x == v.y && v.y == v.z) return text_of(v.x);
  return text_of(v.x) + ", " + text_of(v.y) + ", " + text_of(v.z);
}

struct DefaultText {
  const Key& key;

  std::string operator()(const bool* value) const { return *value ? "true" : "false"; }
  std::string operator()(const int* value) const { return std::to_string(*value); }
  std::string operator()(const unsigned* value) const { return std::to_string(*value); }
  std::string operator()(const double* value) const { return text_of(*value); }
  std::string operator()(const std::string* value) const { return *value; }
  std::string operator()(const math::Vec3* value) const {
    return key.type == KeyType::map ? std::string() : components_of(*value);
  }
  std::string operator()(const std::optional<double>* value) const { return *value ? text_of(**value) : std::string(); }
  std::string operator()(const std::optional<math::Vec3>* value) const {
    return *value ? components_of(**value) : std::string();
  }
  std::string operator()(const EnumMember& member) const {
    for (const Word& word : key.words) {
      if (word.value == member.get(member.value)) return std::string(word.text);
    }
    return {};
  }
  // Poses, lists and inner descriptions: what matters of them is said in words, or by the keys in them.
  std::string operator()(const math::Pose*) const { return {}; }
  std::string operator()(const std::optional<math::Pose>*) const { return {}; }
  std::string operator()(const std::vector<std::string>*) const { return {}; }
  std::string operator()(const InnerMember&) const { return {}; }
  std::string operator()(std::monostate) const { return {}; }
};

}  // namespace

const std::vector<const BlockKind*>& block_kinds() { return registered_kinds(); }

void register_block_kind(const BlockKind& kind) { registered_kinds().push_back(&kind); }

std::vector<const Group*> all_groups() {
  std::vector<const Group*> groups(kGroups.begin(), kGroups.end());
  for (const BlockKind* kind : block_kinds()) add_group(*kind->group, groups);
  return groups;
}

std::vector<const Key*> own_keys(const Group& group) {
  std::vector<const Key*> keys;
  for (const Key& key : group.keys) keys.push_back(&key);
  if (&group == &kModel) {
    for (const BlockKind* kind : block_kinds()) keys.push_back(&kind->list);
  }
  return keys;
}

std::vector<const Key*> keys_of(const Group& group) {
  std::vector<const Key*> keys = own_keys(group);
  for (const Group* included : group.includes) {
    for (const Key& key : included->keys) keys.push_back(&key);
  }
  return keys;
}

const Key* find_key(const Group& group, std::string_view name) {
  for (const Key* key : keys_of(group)) {
    if (key->name == name) return key;
  }
  return nullptr;
}

const Word* find_word(const Key& key, std::string_view text) {
  const auto found =
      std::find_if(key.words.begin(), key.words.end(), [&](const Word& word) { return word.text == text; });
  return found == key.words.end() ? nullptr : &*found;
}

std::vector<std::string> key_names(const Group& group) {
  std::vector<std::string> names;
  for (const Key* key : keys_of(group)) names.emplace_back(key->name);
  return names;
}

std::string other_blocks_with(std::string_view name, const Group& group) {
  std::string text;
  for (const Group* other : all_groups()) {
    if ((!other->is_block && !other->is_header) || other == &group || find_key(*other, name) == nullptr) continue;
    if (!text.empty()) text += ", ";
    text += other->title;
  }
  return text;
}

std::string text_of(double number) {
  std::array<char, 32> text{};
  const auto [end, problem] = std::to_chars(text.data(), text.data() + text.size(), number);
  return problem == std::errc() ? std::string(text.data(), end) : std::string();
}

bool fills_owner(const Key& key) {
  return !key.member && key.sub != nullptr && key.type != KeyType::maps &&
         std::any_of(key.sub->keys.begin(), key.sub->keys.end(), [](const Key& inner) { return bool(inner.member); });
}

std::string default_text(const Key& key, const void* owner) {
  if (!key.fallback.empty() || key.required || !key.member || owner == nullptr) return std::string(key.fallback);
  if (key.status == KeyStatus::older || !key.preferred.empty()) return {};
  // Members are only read here; the binding has one form for both.
  return std::visit(DefaultText{key}, key.member.find(const_cast<void*>(owner)));
}

std::string_view describe(KeyType type) {
  switch (type) {
    case KeyType::boolean: return "true or false";
    case KeyType::integer: return "a whole number";
    case KeyType::number: return "a number";
    case KeyType::text: return "text";
    case KeyType::file: return "a file name";
    case KeyType::folder: return "a folder";
    case KeyType::choice: return "one of the known words";
    case KeyType::vector: return "a vector {x, y, z}";
    case KeyType::rotation: return "a rotation {r, p, y}";
    case KeyType::map: return "a map";
    case KeyType::maps: return "a list of maps";
    case KeyType::texts: return "a list of names";
    case KeyType::integers: return "a list of whole numbers";
    case KeyType::number_or_vector: return "a number or a vector {x, y, z}";
    case KeyType::number_or_map: return "a number or a map";
    case KeyType::text_or_map: return "a name or a map";
    case KeyType::vector_or_map: return "a pose or a vector {x, y, z}";
    case KeyType::matrix: return "four lists of four numbers";
  }
  return "";
}

}  // namespace ambf::scene
