// Reads what a device file says about a driver (DriverRequest::options) and collects what is wrong with it. A driver
// reads its options when it is made; open() returns the problems. C++17.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "devices/driver.h"

namespace ambf::devices {

// One of a device's axes, perhaps reversed. number < 0: none.
struct SourceAxis {
  int number = -1;
  double sign = 1.0;
};

class Options {
 public:
  explicit Options(const DriverRequest& request) : request_(request), known_{"library"} {}

  std::string text(const std::string& name, const std::string& fallback = {});
  double number(const std::string& name, double fallback, double min, double max);
  unsigned count(const std::string& name, unsigned fallback, unsigned max);
  // The number of one of `words`; the first one when absent.
  std::size_t choice(const std::string& name, const std::vector<std::string>& words);
  // One of `names`, with a minus before it to reverse it, or "none". `fallback` is written alike.
  SourceAxis axis(const std::string& name, const std::string& fallback, const std::vector<std::string>& names);
  // A path; relative ones start at the folder of the device file. Empty when absent.
  std::string path(const std::string& name);

  // What is wrong, options that were not read among it; empty: nothing.
  std::string problems() const;

 private:
  const std::string* find(const std::string& name);
  void complain(const std::string& name, const std::string& value, const std::string& wanted);

  const DriverRequest& request_;
  std::set<std::string> known_;
  std::vector<std::string> problems_;
};

}  // namespace ambf::devices
