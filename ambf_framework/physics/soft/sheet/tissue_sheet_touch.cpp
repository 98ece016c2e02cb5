// Sheets on solids. A sheet is light beside what it lies on, and the two stepped one after the other would tremble: so
// their touches are in the sheet's solve alone, with the solid as a wall that moves as it does, and the solid feels the
// forces of that in the same step, as rigid bodies do.
#include <algorithm>

#include "physics/soft/detail/tissue_data.h"

namespace ambf::physics::detail {

// Springs are held to what moves the solid's corners, within a step, to where they are to be (EQUATIONS 16).
void lay_on(TissueData& sheet, TissueData& solid, std::size_t first, double h) {
  TouchRooms& rooms = sheet.touch;
  std::vector<double>& load = solid.of_corner;  // 1/s^2
  load.assign(solid.solid.corner_count(), 0.0);
  const auto each = [&](const TissueTouch& touch, const TissueTouch& at, const auto& use) {
    for (std::size_t k = 0; k < at.corners; ++k)
      if (!solid.solid.fixed(at.corner[k]))
        use(at.corner[k], std::max(touch.normal_stiffness, touch.side_stiffness) * at.weight[k] * at.weight[k] /
                              solid.solid.masses()[at.corner[k]]);
  };
  for (std::size_t i = first; i < rooms.made.size(); ++i)
    each(rooms.made[i], rooms.felt[i].at, [&](std::uint32_t corner, double more) { load[corner] += more; });
  for (std::size_t i = first; i < rooms.made.size(); ++i) {
    double most = 0.0;
    each(rooms.made[i], rooms.felt[i].at, [&](std::uint32_t corner, double) { most = std::max(most, load[corner]); });
    TissueTouch& touch = rooms.made[i];
    const double held = 1.0 / (1.0 + h * h * most);
    touch.pull = touch.pull * held;
    touch.push *= held;
    touch.normal_stiffness *= held;
    touch.side_stiffness *= held;
    rooms.felt[i].solid = &solid;
  }
}

void press_on_solids(TissueData& sheet, double h) {
  for (std::size_t i = 0; i < sheet.touch.felt.size(); ++i) {
    const TouchRooms::Felt& felt = sheet.touch.felt[i];
    if (felt.solid == nullptr || felt.solid->owner->frozen()) continue;
    const math::Vec3 force = sheet.solid.force_of(sheet.touch.made[i], h);
    for (std::size_t k = 0; k < felt.at.corners; ++k)
      felt.solid->solid.add_force(felt.at.corner[k], force * felt.at.weight[k]);
  }
}

}  // namespace ambf::physics::detail
