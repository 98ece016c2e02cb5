#include "adf/arms.h"

#include <algorithm>
#include <iterator>

#include "adf/detail/arm_parser.h"
#include "adf/detail/arms_text.h"
#include "adf/document.h"

namespace ambf::adf {

using kinematics::Arm;

const Arm* ArmTable::find(const std::string& name, const std::string& tool) const {
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end()) return nullptr;
  const std::string& wanted = tool.empty() ? default_tools[static_cast<std::size_t>(at - names.begin())] : tool;
  const auto found =
      std::find_if(arms.begin(), arms.end(), [&](const Arm& arm) { return arm.name == name && arm.tool == wanted; });
  return found == arms.end() ? nullptr : &*found;
}

ArmsResult parse_arms(const std::string& text, const std::string& path) {
  ArmsResult result;
  const auto report = [&](const ArmMistake& mistake, const std::string& block) {
    result.diagnostics.push_back({base::Severity::error,
                                  path,
                                  mistake.mark.line,
                                  mistake.mark.column,
                                  block,
                                  {},
                                  mistake.message,
                                  mistake.hint});
  };
  const Document document(text);
  if (document.error()) {
    report({document.error()->mark, document.error()->message, document.error()->hint}, {});
    return result;
  }
  const Value root = document.root();
  if (!root.is_map()) {
    report({root.mark(), "a file of arms is a map of their names", {}}, {});
    return result;
  }
  for (std::size_t i = 0; i < root.size(); ++i) {
    const auto [key, own] = root.entry(i);
    ArmReader reader(root);
    ArmDraft draft;
    bool good = reader.read_arm(own, draft);
    std::vector<Arm> arms;
    const std::size_t tools = good && draft.tools.is_map() ? draft.tools.size() : 0;
    for (std::size_t k = 0; good && k < std::max<std::size_t>(tools, 1); ++k) {
      ArmDraft equipped = draft;
      equipped.arm.name = key.text();
      if (tools > 0) {
        const auto [tool, changes] = draft.tools.entry(k);
        equipped.arm.tool = tool.text();
        good = reader.apply(changes, equipped);
      }
      good = good && reader.finish(own, equipped);
      arms.push_back(std::move(equipped.arm));
    }
    if (!good) {
      report(reader.mistake(), key.text());
      continue;
    }
    result.table.names.push_back(key.text());
    result.table.default_tools.push_back(draft.default_tool);
    std::move(arms.begin(), arms.end(), std::back_inserter(result.table.arms));
  }
  return result;
}

const ArmTable& known_arms() {
  static const ArmTable table = parse_arms(kArmsText, "arms.yaml").table;
  return table;
}

}  // namespace ambf::adf
