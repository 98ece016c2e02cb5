// The input devices file of a saved scene's bundle.
#include "adf/detail/files.h"
#include "adf/detail/save_paths.h"
#include "adf/detail/text_edit.h"
#include "adf/save.h"

namespace ambf::adf {

SavedDevices save_input_devices(const std::string& text, const std::string& from, const std::string& to) {
  constexpr const char* kKey = "simulated multibody";
  SavedDevices saved;
  const Document document(text);
  const auto refuse = [&](const std::string& message, int line, int column, const std::string& hint) {
    saved.diagnostics.push_back({base::Severity::error, from, line, column, "", "", message, hint});
    return saved;
  };
  if (const auto& error = document.error())
    return refuse(error->message, error->mark.line, error->mark.column, error->hint);
  const Value root = document.root();
  Change change = moved_paths(root, folder_of(from), folder_of(to));
  std::map<std::string, std::string> copies;  // the new name by the file
  for (std::size_t i = 0; root.is_map() && i < root.size(); ++i) {
    const auto [key, block] = root.entry(i);
    const auto model = key.is_scalar() && block.is_map() ? block.find(kKey) : std::nullopt;
    if (!model || !model->is_scalar() || model->text().empty()) continue;
    const std::string file = resolve(folder_of(from), model->text());
    // Each has a folder of its own: files of one name stay apart.
    const auto [known, is_new] = copies.try_emplace(
        file, "./devices/" + (copies.empty() ? "" : std::to_string(copies.size() + 1) + "/") + file_name_of(file));
    if (is_new) saved.models.push_back({file, resolve(folder_of(to), known->second)});
    change.key(key.text()).key(kKey).scalar = known->second;
  }
  EditedText edited = edit(text, document, change);
  if (edited.error)
    return refuse(edited.error->message, edited.error->mark.line, edited.error->mark.column, edited.error->hint);
  saved.text = std::move(edited.text);
  return saved;
}

}  // namespace ambf::adf
