// The objects of a structure as rows of a tree: models, their bodies with the joints that hang on them, cameras and
// lights. Open rows show their children; a search shows matches with their models. No drawing. Main thread.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "state/structure.h"

namespace ambf::render {

struct TreeRow {
  int depth = 0;
  std::string label;
  std::string text;          // the full name, for tool tips
  state::ObjectKind kind{};  // the world: none
  state::ObjectId object;    // invalid: a model
  std::string key;           // of open()
  bool has_children = false, open = false;
};

class ObjectTree {
 public:
  void take(const std::shared_ptr<const state::Structure>& structure);
  // Shows names that contain all words of `text`; empty: all names.
  void search(const std::string& text);
  void set_open(const std::string& key, bool open);
  // Opens the rows above the object.
  void reveal(state::ObjectId object);

  const std::vector<TreeRow>& rows() const { return rows_; }
  // Row of the object among rows(), or kNoRow.
  std::size_t row_of(state::ObjectId object) const;
  static constexpr std::size_t kNoRow = static_cast<std::size_t>(-1);

 private:
  void build();
  bool found(const std::string& name) const;

  std::shared_ptr<const state::Structure> structure_;
  std::vector<std::string> words_;  // in lower case
  std::set<std::string> closed_models_, open_bodies_;
  std::vector<TreeRow> rows_;
};

// Words of `text` in lower case; whether all of them occur in `name`, whatever the case.
std::vector<std::string> search_words(const std::string& text);
bool has_words(const std::string& name, const std::vector<std::string>& words);

}  // namespace ambf::render
