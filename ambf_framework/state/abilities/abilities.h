// What one simulation can do for others, one small interface per ability. Readers take the abilities they need; this
// aggregate is for code that passes them on. Implemented by runtime/. C++17.
#pragma once

#include "state/abilities/command.h"
#include "state/abilities/devices.h"
#include "state/abilities/edit.h"
#include "state/abilities/effector.h"
#include "state/abilities/observe.h"
#include "state/abilities/pick.h"
#include "state/abilities/run.h"
#include "state/abilities/tune.h"

namespace ambf::state {

struct Abilities {
  ObserveAbility& observe;
  RunAbility& run;
  EditAbility& edit;
  TuneAbility& tune;
  CommandAbility& command;
  PickAbility& pick;
  EffectorAbility& effector;
  DeviceAbility* devices = nullptr;  // null: no input devices. Implemented by devices/hub.h
};

}  // namespace ambf::state
