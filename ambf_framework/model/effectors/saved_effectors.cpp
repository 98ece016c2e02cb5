#include "model/effectors/saved_effectors.h"

#include <utility>

#include "base/limits.h"
#include "model/detail/state_bytes.h"

namespace ambf::model {
namespace {

constexpr double kMaxPlace_m = 1e6, kMaxGain = 1e9, kMaxRate = 1e12, kMaxPeriod_s = 10.0;
constexpr std::uint64_t kMaxSteps = std::uint64_t{1} << 40, kMaxCount = std::uint64_t{1} << 62;

void transfer_gains(StateArchive& archive, state::EffectorGains& gains) {
  for (math::Vec3* gain :
       {&gains.linear_stiffness, &gains.linear_damping, &gains.angular_stiffness, &gains.angular_damping}) {
    transfer_vector(archive, *gain, kMaxGain, "a device's gain");
    archive.require(gain->x >= 0.0 && gain->y >= 0.0 && gain->z >= 0.0, "a device's gain must not be negative");
  }
}

void transfer_set_point(StateArchive& archive, state::SetPoint& set_point) {
  transfer_pose(archive, set_point.T_world_ref, kMaxPlace_m, "a set-point");
  transfer_gains(archive, set_point.gains);
  archive.number(set_point.period_s, 0.0, kMaxPeriod_s, "a device's period");
  archive.flag(set_point.pulls, "whether a device pulls");
  archive.flag(set_point.engaged, "whether a device is engaged");
  archive.flag(set_point.moves_jaw, "whether a device moves the jaw");
  archive.number(set_point.jaw, -kMaxSaved, kMaxSaved, "a device's opening");
  archive.count(set_point.sample, 0, kMaxCount, "the number of a device's sample");
}

void transfer_law(StateArchive& archive, EffectorLaw::State& law) {
  transfer_pose(archive, law.T_world_from, kMaxPlace_m, "a reference");
  transfer_pose(archive, law.T_world_to, kMaxPlace_m, "a reference");
  transfer_pose(archive, law.T_world_ref, kMaxPlace_m, "a reference");
  transfer_vector(archive, law.twist_ref_world.linear, kMaxRate, "the velocity of a reference");
  transfer_vector(archive, law.twist_ref_world.angular, kMaxRate, "the velocity of a reference");
  transfer_gains(archive, law.gains);
  archive.count(law.steps, 1, kMaxSteps, "the steps of a reference");
  archive.count(law.done, 0, law.steps, "the steps that a reference has done");
  archive.count(law.sampled_steps, 0, kMaxSteps, "the steps between a device's samples");
  archive.count(law.since_sample, 0, EffectorLaw::kLongAgo_steps, "the steps since a device's sample");
}

}  // namespace

void transfer_effectors(StateArchive& archive, std::vector<SavedEffector>& effectors,
                        const state::Structure& structure) {
  archive.size(effectors, base::kMaxEffectors, 9 * sizeof(double), "the number of bodies that devices hold");
  std::pair<std::uint64_t, int> last{0, -1};
  for (SavedEffector& effector : effectors) {
    const std::uint64_t max_body = structure.bodies.empty() ? 0 : structure.bodies.size() - 1;
    archive.count(effector.body, 0, max_body, "the body that a device holds");
    archive.choice(effector.source, 0, base::kMaxSources - 1, "the source of a device");
    const std::pair<std::uint64_t, int> at{effector.body, static_cast<int>(effector.source)};
    archive.require(effector.body < structure.bodies.size() && structure.bodies[effector.body].mass != 0.0,
                    "devices hold moving bodies only");
    archive.require(at > last, "what devices hold must come by body and source, each once");
    last = at;
    archive.number(effector.age_s, 0.0, kMaxSaved, "the age of a set-point");
    transfer_set_point(archive, effector.set_point);
    transfer_law(archive, effector.law);
    archive.flag(effector.bounded, "whether a device's gains were cut");
    archive.flag(effector.leads_jaw, "whether a device leads the jaw");
    archive.number(effector.jaw_in_force, 0.0, 1.0, "the opening of a jaw");
    archive.count(effector.jaw_steps_left, 0, kMaxSteps, "the steps that are left to a jaw");
    archive.number(effector.jaw_seen, 0.0, 1.0, "a device's opening");
    archive.number(effector.jaw_mark, 0.0, 1.0, "a device's opening");
  }
}

}  // namespace ambf::model
