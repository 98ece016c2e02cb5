// Knots around the stitches of a needle's thread.
#include <algorithm>

#include "physics/soft/detail/needle_data.h"

namespace ambf::physics {
namespace detail {

bool NeedleData::has_knot(std::uint32_t number) const {
  return std::any_of(knots.begin(), knots.end(), [&](const Knot& each) { return each.number == number; });
}

void NeedleData::lose_stitches() {
  for (Knot& knot : knots) {
    const Stitch *first = nullptr, *last = nullptr;
    bool end_lost = false, last_lost = false;
    for (const Stitch& each : stitches) {
      if (each.knot != knot.number) continue;
      last_lost = each.lost;
      if (first == nullptr) end_lost |= each.lost;
      if (each.lost) continue;
      if (first == nullptr) first = &each;
      last = &each;
    }
    if (first != nullptr && (end_lost || last_lost)) knot.length = math::norm(now(last->at) - now(first->at));
    if (first == nullptr) knot.number = 0;
  }
  std::erase_if(knots, [](const Knot& knot) { return knot.number == 0; });
  std::erase_if(stitches, [](const Stitch& each) { return each.lost; });
}

}  // namespace detail

bool Needle::tie() {
  detail::NeedleData& data = *data_;
  const auto is_free = [](const detail::Stitch& each) { return each.knot == 0; };
  const auto first = std::find_if(data.stitches.begin(), data.stitches.end(), is_free);
  const auto last = std::find_if(data.stitches.rbegin(), data.stitches.rend(), is_free);
  if (first == data.stitches.end() || &*first == &*last || data.knots.size() == kMaxKnots) return false;
  std::uint32_t number = 1;
  while (data.has_knot(number)) ++number;
  const math::Vec3 way = detail::now(last->at) - detail::now(first->at);
  data.knots.push_back({number, math::norm(way)});
  for (detail::Stitch& each : data.stitches)
    if (each.knot == 0) each.knot = number;
  return true;
}

void Needle::untie() {
  data_->knots.clear();
  for (detail::Stitch& each : data_->stitches) each.knot = 0;
}

std::size_t Needle::bites() const {
  std::size_t count = 0;
  bool has_come_out = false;  // from the needle on: what the thread came out of, then what it went in by
  for (const detail::Stitch& each : data_->stitches) {
    if (detail::comes_out(each.kind)) has_come_out = true;
    if (!detail::goes_in(each.kind)) continue;
    if (has_come_out) ++count;
    has_come_out = false;
  }
  return count;
}

bool Needle::too_many_holders() const { return data_->holder_left_out; }
bool Needle::too_many_stitches() const { return data_->stitch_left_out; }

std::size_t Needle::tied() const {
  const std::vector<detail::Stitch>& all = data_->stitches;
  return static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [](const detail::Stitch& each) { return each.knot != 0; }));
}

}  // namespace ambf::physics
