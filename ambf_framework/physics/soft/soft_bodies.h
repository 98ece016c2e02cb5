// The soft bodies of a world and their step. The only header of the room that the rest of physics/ includes. Private to
// physics/. Physics thread.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "physics/soft_body.h"

namespace ambf::physics::detail {

struct BladeData;
struct BodyData;
struct NeedleData;
struct SoftData;
struct ThreadData;
class ThreadTangles;
struct TissueData;
struct WorldData;

class SoftBodies {
 public:
  SoftBodies();
  ~SoftBodies();
  SoftBodies(const SoftBodies&) = delete;
  SoftBodies& operator=(const SoftBodies&) = delete;

  void add(SoftBody& body);
  void remove(SoftBody& body);
  void add(BladeData& blade);
  void remove(BladeData& blade);
  void add(NeedleData& needle);
  void remove(NeedleData& needle);
  const std::vector<SoftBody*>& all() const { return bodies_; }

  void step(WorldData& world);
  void forget(const BodyData& body);  // it leaves the world
  void restart();                     // what grows with history begins anew
  void reset();

 private:
  struct Rooms;
  void meet(SoftBody& soft, BodyData& body, double h);
  void meet_each_other();
  void touch(BodyData& body, double h);
  void step_threads(WorldData& world, double h);                                         // thread_step.cpp
  void gather_pulls(ThreadData& thread, WorldData& world, std::size_t count, double h);  // likewise
  void use_pulls(ThreadData& thread, double h);                                          // likewise
  void step_tissue(TissueData& tissue, WorldData& world, double h);                      // tissue_step.cpp
  bool rests(TissueData& tissue, const WorldData& world);                                // soft_sleep.cpp
  bool rests(SoftData& links, const WorldData& world);                                   // likewise
  template <class Use>
  void each_other_near(const TissueData& tissue, const Use& use) const;                // likewise
  std::uint64_t surroundings(const TissueData& tissue, const WorldData& world) const;  // likewise
  std::uint64_t surroundings(const SoftData& links, const WorldData& world) const;     // likewise
  bool bears_what_is_awake(const TissueData& tissue) const;                            // likewise
  bool may_meet_others(const SoftData& links) const;                                   // likewise
  void add_blades(TissueData& tissue, WorldData& world, double h);
  void add_needles(TissueData& tissue, WorldData& world, double h);
  void begin_threads(WorldData& world, double h);
  void give_reactions(double h);

  std::vector<SoftBody*> bodies_;
  std::vector<BladeData*> blades_;
  std::vector<NeedleData*> needles_;
  std::unique_ptr<ThreadTangles> tangles_;  // null: there was no thread yet
  std::unique_ptr<Rooms> rooms_;
};

}  // namespace ambf::physics::detail
