#include "runtime/detail/kept_texts.h"

namespace ambf::runtime {

bool KeptTexts::keep(const std::string& model, Text text) {
  forget(model);
  if (text == nullptr || text->size() > kMaxKeptTextBytes - bytes_) return false;
  bytes_ += text->size();
  texts_[model] = std::move(text);
  return true;
}

void KeptTexts::forget(const std::string& model) {
  const auto found = texts_.find(model);
  if (found == texts_.end()) return;
  bytes_ -= found->second->size();
  texts_.erase(found);
}

KeptTexts::Text KeptTexts::find(const std::string& model) const {
  const auto found = texts_.find(model);
  return found == texts_.end() ? nullptr : found->second;
}

}  // namespace ambf::runtime
