// How fast a commanded value moves, known only from the values themselves, which arrive in steps: the change divided by
// the time since the change before, held for as long, then zero. A stream of set-points thus gives its true rate
// whatever its frequency, and a single jump after a pause gives next to none; differencing once a step would give
// spikes of (jump / h). Plain data.
#pragma once

#include <algorithm>

namespace ambf::model {

// Value and Rate: doubles, or anything with +, -, * double and ==. `difference(from, to)` gives the change as a Rate *
// s.
template <class Value, class Rate>
struct ReferenceRate {
  Value last{};
  Rate rate{};
  double since_change_s = 0.0;
  double hold_left_s = 0.0;
  bool running = false;

  void reset() { *this = ReferenceRate{}; }

  // Once an internal step of h seconds, with the value in force in it.
  template <class Difference>
  const Rate& update(const Value& value, double h_s, Difference&& difference) {
    if (!running) {
      running = true;
      last = value;
      since_change_s = kLongAgo_s;
      return rate;
    }
    since_change_s = std::min(since_change_s + h_s, kLongAgo_s);
    if (!(value == last)) {
      rate = difference(last, value) * (1.0 / since_change_s);
      hold_left_s = since_change_s;
      since_change_s = 0.0;
      last = value;
    } else {
      hold_left_s -= h_s;
      if (hold_left_s < 0.5 * h_s) rate = Rate{};
    }
    return rate;
  }

  static constexpr double kLongAgo_s = 0.5;  // the watchdog's period: a slower source does not stream
};

}  // namespace ambf::model
