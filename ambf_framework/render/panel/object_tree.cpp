#include "render/panel/object_tree.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "render/scene/object_kind.h"

namespace ambf::render {

namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string model_key(state::ModelId id) { return "model " + std::to_string(id); }
std::string body_key(state::ObjectId id) {
  return "body " + std::to_string(id.index) + "." + std::to_string(id.generation);
}

}  // namespace

std::vector<std::string> search_words(const std::string& text) {
  std::istringstream in(lower(text));
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

bool has_words(const std::string& name, const std::vector<std::string>& words) {
  if (words.empty()) return true;
  const std::string text = lower(name);
  return std::all_of(words.begin(), words.end(),
                     [&](const std::string& word) { return text.find(word) != std::string::npos; });
}

void ObjectTree::take(const std::shared_ptr<const state::Structure>& structure) {
  if (structure_ != nullptr && structure_->version == structure->version) return;
  structure_ = structure;
  build();
}

void ObjectTree::search(const std::string& text) {
  std::vector<std::string> words = search_words(text);
  if (words == words_) return;
  words_ = std::move(words);
  if (structure_ != nullptr) build();
}

void ObjectTree::set_open(const std::string& key, bool open) {
  if (key.rfind("model ", 0) == 0) {
    open ? static_cast<void>(closed_models_.erase(key)) : static_cast<void>(closed_models_.insert(key));
  } else {
    open ? static_cast<void>(open_bodies_.insert(key)) : static_cast<void>(open_bodies_.erase(key));
  }
  if (structure_ != nullptr) build();
}

void ObjectTree::reveal(state::ObjectId object) {
  if (structure_ == nullptr || row_of(object) != kNoRow) return;
  const std::uint32_t index = state::find(*structure_, object);
  if (index == state::kNone) return;
  const state::ObjectInfo& info = structure_->objects[index];
  closed_models_.erase(model_key(info.model));
  if (is_joint(info)) {
    const state::BodyInfo& parent = structure_->bodies[structure_->joints[info.slot].parent_body];
    closed_models_.erase(model_key(structure_->objects[parent.object].model));
    open_bodies_.insert(body_key(structure_->objects[parent.object].id));
  }
  build();
}

std::size_t ObjectTree::row_of(state::ObjectId object) const {
  const auto row = std::find_if(rows_.begin(), rows_.end(), [&](const TreeRow& r) { return r.object == object; });
  return row == rows_.end() || !object.valid() ? kNoRow : static_cast<std::size_t>(row - rows_.begin());
}

bool ObjectTree::found(const std::string& name) const { return has_words(name, words_); }

void ObjectTree::build() {
  rows_.clear();
  const state::Structure& structure = *structure_;
  const bool searching = !words_.empty();
  std::vector<std::vector<std::uint32_t>> joints_of(structure.bodies.size());
  for (const state::JointInfo& joint : structure.joints) joints_of[joint.parent_body].push_back(joint.object);

  std::vector<state::ModelInfo> models = structure.models;
  if (std::none_of(models.begin(), models.end(), [](const auto& m) { return m.id == state::kWorldModel; })) {
    models.insert(models.begin(), {state::kWorldModel, "World", ""});
  }
  for (const state::ModelInfo& model : models) {
    TreeRow head;
    head.label = model.id == state::kWorldModel ? "World" : model.name;
    head.text = model.file.empty() ? head.label : model.file;
    head.key = model_key(model.id);
    head.open = searching || closed_models_.count(head.key) == 0;
    const std::size_t at = rows_.size();
    rows_.push_back(head);
    for (std::uint32_t i = 0; i < structure.objects.size(); ++i) {
      const state::ObjectInfo& info = structure.objects[i];
      if (info.model != model.id || is_joint(info)) continue;
      rows_[at].has_children = true;
      if (!head.open) break;
      TreeRow row;
      row.depth = 1;
      row.label = info.local_name;
      row.text = info.name;
      row.kind = info.kind;
      row.object = info.id;
      std::vector<TreeRow> below;
      if (is_body(info)) {
        row.key = body_key(info.id);
        row.has_children = !joints_of[info.slot].empty();
        row.open = row.has_children && (searching || open_bodies_.count(row.key) != 0);
        for (const std::uint32_t joint : joints_of[info.slot]) {
          const state::ObjectInfo& j = structure.objects[joint];
          if (!row.open || (searching && !found(j.name))) continue;
          below.push_back({2, j.local_name, j.name, j.kind, j.id, "", false, false});
        }
      }
      if (searching && below.empty() && !found(info.name)) continue;
      if (below.empty() && searching) row.open = false;
      rows_.push_back(std::move(row));
      rows_.insert(rows_.end(), below.begin(), below.end());
    }
    if (rows_.size() == at + 1 && (searching || !rows_[at].has_children)) rows_.pop_back();
  }
}

}  // namespace ambf::render
