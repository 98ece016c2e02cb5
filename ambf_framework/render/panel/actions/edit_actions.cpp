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

}  // namespace ambf::render
