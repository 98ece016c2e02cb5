#include <algorithm>
#include <cctype>
#include <unordered_set>

#include "adf/detail/file_context.h"
#include "adf/detail/key_check.h"
#include "adf/detail/scalars.h"

namespace ambf::adf {

namespace {

using scene::Group;
using scene::Key;

bool is_version_key(const std::string& name) {
  constexpr std::string_view kName = "adf version";
  return std::equal(name.begin(), name.end(), kName.begin(), kName.end(),
                    [](unsigned char a, char b) { return std::tolower(a) == b; });
}

bool check_version(const Value& value, Report& report) {
  if (value.is_absent() || (value.is_scalar() && value.text() == "1.0")) return true;
  report.error(value.mark(), "adf version", "expected 1.0, found " + describe(value),
               "the file is refused; 1.0 is the only version of the format");
  return false;
}

// A key that the header does not know: a block (loaded when a list names it), a value kept for its anchor, or an error
// of typing.
void check_other(const Value& name, const Value& value, const Group& group, Report& report) {
  if (value.holds_anchors()) return;
  const std::string near = report.nearest(name.text(), scene::key_names(group));
  if (value.is_map() && near.empty()) return;
  if (report.full()) return report.warning(name.mark(), {}, "unknown key");
  // Blocks that happen to be called like a key are blocks.
  if (value.is_map()) {
    const Key* key = scene::find_key(group, near);
    if (!key || key->type != scene::KeyType::map) return;
    if (name.text().starts_with(near) && name.text().size() > near.size() + 2) return;
  }
  report.warning(name.mark(), printable(name.text()), "unknown key; it has no effect",
                 near.empty() ? "known keys: docs/adf.md, section `" + std::string(group.title) + "`"
                              : "did you mean `" + near + "`?");
}

}  // namespace

bool Header::check(const Value& root, const Group& group, Report& report) {
  report.set_block({});
  if (!root.is_map()) {
    report.error(root.mark(), {}, "expected a map of keys and blocks, found " + describe(root), "the file is refused");
    return false;
  }
  const KeyCheck check{report};
  bool good = true;
  std::unordered_map<std::string_view, int> seen;
  for (std::size_t i = 0; i < root.size(); ++i) {
    const auto [name, value] = root.entry(i);
    if (!name.is_scalar()) {
      report.warning(name.mark(), {}, "a key must be text, found " + describe(name), "the value is left out");
      continue;
    }
    if (const auto [first, is_new] = seen.emplace(name.text(), name.mark().line); !is_new) {
      report.warning(name.mark(), printable(name.text()),
                     "given twice; the first one counts (line " + std::to_string(first->second) + ")",
                     "remove one of them");
      continue;
    }
    if (is_version_key(name.text())) {
      good &= check_version(value, report);
      continue;
    }
    const Key* key = scene::find_key(group, name.text());
    if (!key) {
      check_other(name, value, group, report);
      continue;
    }
    if (value.is_absent() || key->status == scene::KeyStatus::ignored) continue;
    if (key->status == scene::KeyStatus::later) check.later(name.mark(), *key, value, std::string(key->name));
    if (key->status == scene::KeyStatus::unread) check.unread(name.mark(), *key, std::string(key->name));
    if (key->type == scene::KeyType::texts && value.is_list() && value.size() > limits::kListedBlocks) {
      report.error(value.mark(), std::string(key->name),
                   "more than " + std::to_string(limits::kListedBlocks) + " entries: " + std::to_string(value.size()),
                   "split the file");
      good = false;
      continue;
    }
    if (!check.value(value, *key, std::string(key->name))) good = false;
  }
  return good;
}

Header::Header(const Value& root) : fields_(root) {
  for (std::size_t i = 0; i < root.size(); ++i) {
    const auto [name, value] = root.entry(i);
    if (name.is_scalar() && by_name_.emplace(name.text(), value).second && !value.is_null())
      names_.push_back(name.text());
  }
}

std::vector<Block> Header::blocks(const std::string& key, const Group& group, Report& report, bool simulated) {
  std::vector<Block> blocks;
  const auto list = fields_.find(key);
  if (!list) return blocks;
  const std::string kind(group.title);
  // Of what is not simulated yet nothing is dropped, so its wrong values are worth a warning.
  const KeyCheck check{report, simulated ? base::Severity::error : base::Severity::warning};
  std::unordered_set<std::string_view> listed;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Value item = list->item(i);
    if (item.is_absent()) continue;
    report.set_block(item.text());
    if (!listed.insert(item.text()).second) {
      report.warning(item.mark(), {}, "listed twice in `" + key + "`", "it is made once; remove one of the entries");
      continue;
    }
    const auto found = by_name_.find(item.text());
    if (found == by_name_.end()) {
      const std::string near = report.nearest(item.text(), names_);
      report.error(item.mark(), {}, "listed in `" + key + "`, but not defined",
                   near.empty() ? "add a block with this key" : "did you mean " + in_quotes(near) + "?");
      continue;
    }
    const Value& block = found->second;
    if (!block.is_map()) {
      report.error(block.mark(), {}, "expected a block (a map of keys), found " + describe(block),
                   "listed in `" + key + "`");
      continue;
    }
    work_ += block.expanded();
    if (work_ > limits::kExpandedNodes) {
      report.error(item.mark(), {}, "the blocks of this file hold too many values, with those listed again",
                   "split the file");
      break;
    }
    if (!check.map(block, group) && simulated) continue;
    if (!simulated)
      report.information(block.mark(), {}, "this " + kind + " is not simulated yet", "its keys are checked");
    blocks.push_back({item.text(), Fields(block), block.mark()});
  }
  report.set_block({});
  return blocks;
}

}  // namespace ambf::adf
