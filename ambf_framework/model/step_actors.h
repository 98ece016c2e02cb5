// What acts in each step, by phase, in a fixed order: kinds in the order of their registration, each actor in the order
// in which its kind added it. Made once with the world; running it allocates nothing. Physics thread only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace ambf::model {

// The phases of a step after commands were taken; physics (collision, our solver, integration) runs between forces and
// readings.
enum class StepPhase : std::uint8_t {
  laws,     // controllers and what else turns commands and states into forces
  forces,   // forces that see what all laws did: resistance, anchors, grasps
  readings  // sensors and judgements, on the new poses
};
inline constexpr std::size_t kStepPhases = 3;

class StepActors {
 public:
  using Act = std::function<void(double h_s)>;

  // `name` is static text, for reports.
  void add(StepPhase phase, const char* name, Act act) {
    actors_[static_cast<std::size_t>(phase)].push_back({name, std::move(act)});
  }
  void run(StepPhase phase, double h_s) const {
    for (const Actor& actor : actors_[static_cast<std::size_t>(phase)]) actor.act(h_s);
  }
  // visit(name) of each actor of a phase, in the order in which they act.
  template <class Visit>
  void each(StepPhase phase, Visit&& visit) const {
    for (const Actor& actor : actors_[static_cast<std::size_t>(phase)]) visit(actor.name);
  }

 private:
  struct Actor {
    const char* name;
    Act act;
  };
  std::array<std::vector<Actor>, kStepPhases> actors_;
};

}  // namespace ambf::model
