#include "render/panel/actions/edit_actions.h"

#include <utility>

namespace ambf::render {

void EditActions::load(const std::string& path, const std::string& prefix) {
  state::LoadRequest request;
  request.path = path;
  request.name_prefix = prefix;
  notices_.show("loading '" + path + "'");
  settings_.used_file(path);
  edit_.load(std::move(request), notices_.outcome("loaded '" + path + "'", "not loaded: '" + path + "'"));
}

void EditActions::unload(const std::string& model) {
  edit_.unload(model, notices_.outcome("unloaded '" + model + "'", "not unloaded"));
}

void EditActions::remove(const std::string& object) {
  edit_.remove(object, notices_.outcome("removed '" + object + "'", "not removed"));
}

void EditActions::save(state::SaveModelRequest request) {
  const std::string what = request.model.empty() ? "the scene" : "'" + request.model + "'";
  const std::string where = request.path.empty() ? "the file that it was read from" : "'" + request.path + "'";
  edit_.save(std::move(request), notices_.outcome("saved " + what + " in " + where, "not saved: " + what));
}

}  // namespace ambf::render
