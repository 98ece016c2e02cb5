// Judges which sensors match and whose task is done, and logs what begins and ends. Physics thread.
#pragma once

#include "model/kinds/sensor.h"

namespace ambf::model {

// After a swap: which sensors have equal keys.
void number_keys(const LiveWorld::Impl& live);
// On the present hits of all sensors. `steps`: made since the last call, 0 or 1.
void judge_sensors(LiveWorld::Impl& live, std::uint64_t steps);
// Brings another judgement into force, with the events that lead to it.
void set_judgement(LiveWorld::Impl& live, std::uint32_t slot, const Judgement& now);

}  // namespace ambf::model
