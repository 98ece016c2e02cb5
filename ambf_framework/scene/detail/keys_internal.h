// Private to scene/keys*.cpp: where the parts of the table are. Constant data.
#pragma once

#include "scene/keys.h"

namespace ambf::scene::table {

// keys_files.cpp
extern const GroupInfo kModel, kWorld, kLaunch, kInputDevices, kEnclosure, kSkybox, kPlugin, kShaders;
// keys_bodies.cpp
extern const GroupInfo kIdentity, kBody, kVisualKeys, kCollisionKeys, kColorKeys, kPose, kGeometry, kPlacedShape,
    kInertia, kFriction, kBodyDamping, kCartesianController, kGains, kRates, kColorRgba, kRgb, kColorComponents,
    kAmbient;
// keys_joints.cpp
extern const GroupInfo kJoint, kJointLimits, kRangeXyz, kLinearAngular;
// keys_views.cpp
extern const GroupInfo kCamera, kLight, kClippingPlane, kStereo, kResolution, kDepthNoise, kMouse, kAttenuation;
// keys_later.cpp
extern const GroupInfo kSoftBody, kGhostObject, kVehicle, kVolume, kSensor, kActuator, kResistiveSurface,
    kSensorFriction, kRay, kParametric, kSoftConfig, kWheel, kSuspension, kSteeringLimits, kImages;
// keys_devices.cpp
extern const GroupInfo kInputDevice, kHapticGain, kControllerGain, kButtonMapping;

}  // namespace ambf::scene::table
