// The texts of loaded models, for writing them again, within a bound on their size. Loader thread only.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>

#include "math/types.h"

namespace ambf::runtime {

inline constexpr std::size_t kMaxKeptTextBytes = std::size_t{64} << 20;  // of all models together

// How a model was loaded.
struct LoadedFrom {
  std::string name_prefix;
  math::Pose T_world_model;
  bool of_device = false;  // an input device brought it
  bool not_saved = false;  // LoadRequest::not_saved
};

struct KeptText {
  std::shared_ptr<const std::string> text;  // null: it had none, or there was no room for it
  LoadedFrom loaded;
  std::shared_ptr<const std::string> written;  // over the file that it was read from; null: nothing
};

class KeptTexts {
 public:
  using Text = std::shared_ptr<const std::string>;

  // False, and no text is kept, where there is none, or no room left.
  bool keep(const std::string& model, Text text, const LoadedFrom& loaded);
  void forget(const std::string& model);
  // What Save has written over the model's own file.
  void has_written(const std::string& model, Text text);
  // Null when no such model was loaded.
  const KeptText* find(const std::string& model) const;

 private:
  std::map<std::string, KeptText> texts_;
  std::size_t bytes_ = 0;
};

}  // namespace ambf::runtime
