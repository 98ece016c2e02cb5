// The texts of loaded models, for writing them again, within a bound on their size. Loader thread only.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>

namespace ambf::runtime {

inline constexpr std::size_t kMaxKeptTextBytes = std::size_t{64} << 20;  // of all models together

class KeptTexts {
 public:
  using Text = std::shared_ptr<const std::string>;

  // False, and nothing is kept, where there is no room left.
  bool keep(const std::string& model, Text text);
  void forget(const std::string& model);
  // Null when none is kept of that model.
  Text find(const std::string& model) const;

 private:
  std::map<std::string, Text> texts_;
  std::size_t bytes_ = 0;
};

}  // namespace ambf::runtime
