// Groups of keys that only tables of scene/ refer to, and words that several of them share. Constant data.
#pragma once

#include "scene/description.h"
#include "scene/keys.h"

namespace ambf::scene {

struct BlockKind;

template <class Enum>
constexpr Word word(std::string_view text, Enum value) {
  return {text, static_cast<int>(value)};
}

inline constexpr Word kOutputWords[] = {
    word("FORCE", ControllerOutput::force),       word("force", ControllerOutput::force),
    word("EFFORT", ControllerOutput::force),      word("effort", ControllerOutput::force),
    word("VELOCITY", ControllerOutput::velocity), word("velocity", ControllerOutput::velocity),
    word("POSITION", ControllerOutput::position), word("position", ControllerOutput::position)};

namespace group {
extern const Group kRates, kShaders, kGains, kGeometry, kDrawnItem, kPlacedShape, kRgb, kAmbient, kInertia, kFriction,
    kBodyDamping, kCartesianController, kJointGains, kJointLimits, kMimic, kRangeXyz, kLinearAngular, kClippingPlane,
    kStereo, kResolution, kDepthNoise, kMouse, kAttenuation, kSoftBody, kSoftConfig, kGhostObject, kVehicle, kWheel,
    kSuspension, kSteeringLimits, kVolume, kImages, kPointCloud, kIntrinsics, kWindowResolution, kGeometryData, kSensor,
    kRay, kParametric, kRayWrap, kSensorFriction, kSurfaceFriction, kSensorNoise, kActuator, kTrigger, kEdgePoint,
    kArcPoint, kHapticGain, kControllerGain, kDeviceGains, kDeviceDriver, kButtonMapping, kEnclosure, kSkybox,
    kConflictNumber, kPlacement;
}  // namespace group

// One file each in blocks/.
namespace kind {
extern const BlockKind kBody, kSoftBody, kGhostObject, kSensor, kActuator, kJoint, kVehicle, kCamera, kLight, kVolume,
    kPointCloud;
}  // namespace kind

}  // namespace ambf::scene
