#include "runtime/detail/kept_texts.h"

namespace ambf::runtime {

bool KeptTexts::keep(const std::string& model, Text text, const LoadedFrom& loaded) {
  forget(model);
  const bool fits = text != nullptr && text->size() <= kMaxKeptTextBytes - bytes_;
  if (fits) bytes_ += text->size();
  texts_[model] = {fits ? std::move(text) : nullptr, loaded, nullptr};
  return fits;
}

void KeptTexts::forget(const std::string& model) {
  const auto found = texts_.find(model);
  if (found == texts_.end()) return;
  if (found->second.text != nullptr) bytes_ -= found->second.text->size();
  texts_.erase(found);
}

void KeptTexts::has_written(const std::string& model, Text text) {
  if (const auto found = texts_.find(model); found != texts_.end()) found->second.written = std::move(text);
}

const KeptText* KeptTexts::find(const std::string& model) const {
  const auto found = texts_.find(model);
  return found == texts_.end() ? nullptr : &found->second;
}

}  // namespace ambf::runtime
