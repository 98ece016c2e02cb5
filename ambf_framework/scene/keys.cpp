#include "scene/keys.h"

#include <algorithm>
#include <array>

#include "scene/detail/keys_internal.h"

namespace ambf::scene {

namespace {

using namespace table;

constexpr std::array kGroups = {&kModel,
                                &kWorld,
                                &kLaunch,
                                &kIdentity,
                                &kBody,
                                &kVisualKeys,
                                &kCollisionKeys,
                                &kColorKeys,
                                &kJoint,
                                &kCamera,
                                &kLight,
                                &kPose,
                                &kGeometry,
                                &kPlacedShape,
                                &kInertia,
                                &kFriction,
                                &kBodyDamping,
                                &kCartesianController,
                                &kGains,
                                &kRates,
                                &kColorRgba,
                                &kColorComponents,
                                &kRgb,
                                &kAmbient,
                                &kShaders,
                                &kJointLimits,
                                &kRangeXyz,
                                &kLinearAngular,
                                &kClippingPlane,
                                &kStereo,
                                &kResolution,
                                &kDepthNoise,
                                &kMouse,
                                &kAttenuation,
                                &kEnclosure,
                                &kSkybox,
                                &kPlugin,
                                &kSoftBody,
                                &kSoftConfig,
                                &kGhostObject,
                                &kVehicle,
                                &kWheel,
                                &kSuspension,
                                &kSteeringLimits,
                                &kVolume,
                                &kImages,
                                &kSensor,
                                &kRay,
                                &kParametric,
                                &kSensorFriction,
                                &kResistiveSurface,
                                &kActuator,
                                &kInputDevices,
                                &kInputDevice,
                                &kHapticGain,
                                &kControllerGain,
                                &kButtonMapping};

constexpr HeaderList kModelLists[] = {
    {"bodies", Group::body, true},
    {"soft bodies", Group::soft_body, false},
    {"ghost objects", Group::ghost_object, false},
    {"sensors", Group::sensor, false},
    {"actuators", Group::actuator, false},
    {"joints", Group::joint, true},
    {"vehicles", Group::vehicle, false},
    {"cameras", Group::camera, true},
    {"lights", Group::light, true},
    {"volumes", Group::volume, false},
};

const GroupInfo kNothing{};

}  // namespace

std::span<const GroupInfo* const> all_groups() { return kGroups; }

const GroupInfo& group_info(Group group) {
  for (const GroupInfo* info : kGroups) {
    if (info->group == group) return *info;
  }
  return kNothing;
}

const Key* find_key(Group group, std::string_view name) {
  const GroupInfo& info = group_info(group);
  for (const Key& key : info.keys) {
    if (key.name == name) return &key;
  }
  for (Group included : info.includes) {
    if (const Key* key = find_key(included, name)) return key;
  }
  return nullptr;
}

bool knows_choice(const Key& key, std::string_view word) {
  for (std::string_view rest = key.choices; !rest.empty();) {
    const std::size_t end = rest.find('|');
    if (rest.substr(0, end) == word) return true;
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  }
  return false;
}

std::vector<const Key*> keys_of(Group group) {
  const GroupInfo& info = group_info(group);
  std::vector<const Key*> keys;
  for (const Key& key : info.keys) keys.push_back(&key);
  for (Group included : info.includes) {
    for (const Key& key : group_info(included).keys) keys.push_back(&key);
  }
  return keys;
}

std::vector<std::string> key_names(Group group) {
  std::vector<std::string> names;
  for (const Key* key : keys_of(group)) names.emplace_back(key->name);
  return names;
}

std::string other_blocks_with(std::string_view name, Group group) {
  std::string text;
  for (const GroupInfo* info : kGroups) {
    if ((!info->is_block && !info->is_header) || info->group == group || !find_key(info->group, name)) continue;
    if (!text.empty()) text += ", ";
    text += info->title;
  }
  return text;
}

std::span<const HeaderList> model_lists() { return kModelLists; }

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
  }
  return "";
}

}  // namespace ambf::scene
