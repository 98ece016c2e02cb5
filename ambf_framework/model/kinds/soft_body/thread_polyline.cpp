// The places of a thread that a mesh gives: its lines, in a row.
#include <algorithm>
#include <cstdio>

#include "model/kinds/soft_body/detail/builder.h"

namespace ambf::model {
namespace {

const char* const kLeftOut = "; the soft body is left out";

std::string place(const math::Vec3& at) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g) m", at.x, at.y, at.z);
  return text;
}

// The lines of a mesh as a graph of its nodes.
class Lines {
 public:
  explicit Lines(const SoftNodes& nodes) : nodes_(nodes), near_(nodes.at.size()), seen_(nodes.at.size()) {
    for (const auto& line : nodes.lines)
      for (const std::size_t end : {0U, 1U}) near_[line[end]].push_back(line[1 - end]);
  }
  // A node of more than two; none: the count of nodes.
  std::size_t branch() const {
    const auto found = std::find_if(near_.begin(), near_.end(),
                                    [](const std::vector<std::uint32_t>& each) { return each.size() > 2; });
    return static_cast<std::size_t>(found - near_.begin());
  }
  std::size_t degree(std::size_t node) const { return near_[node].size(); }
  // From the ends that the file names first; then what has none. Without branches.
  std::vector<std::vector<math::Vec3>> in_rows(bool& closed) {
    std::vector<std::vector<math::Vec3>> rows;
    closed = false;
    for (const std::size_t ends : {1U, 2U})
      for (const auto& line : nodes_.lines)
        for (const std::uint32_t first : line) {
          if (near_[first].size() != ends || seen_[first]) continue;
          closed = closed || ends == 2;
          rows.push_back(from(first));
        }
    return rows;
  }

 private:
  std::vector<math::Vec3> from(std::uint32_t node) {
    std::vector<math::Vec3> row;
    for (bool goes_on = true; goes_on;) {
      seen_[node] = true;
      row.push_back(nodes_.at[node]);
      goes_on = false;
      for (const std::uint32_t next : near_[node]) {
        if (seen_[next]) continue;
        node = next;
        goes_on = true;
        break;
      }
    }
    return row;
  }

  const SoftNodes& nodes_;
  std::vector<std::vector<std::uint32_t>> near_;
  std::vector<bool> seen_;
};

}  // namespace

std::vector<math::Vec3> polyline_of(const scene::KindBlock& block, const SoftNodes& nodes, Findings& findings) {
  const auto fail = [&](const std::string& message, const std::string& hint) -> std::vector<math::Vec3> {
    findings.error(block.identity, "mesh", message, hint + kLeftOut);
    return {};
  };
  if (nodes.lines.empty())
    return fail("expected a polyline along which the thread runs, found a mesh of " +
                    std::to_string(nodes.triangles.size()) + " triangles and no lines",
                "export its edges as a line (`l` in an OBJ file), or give `points`");
  Lines lines(nodes);
  if (const std::size_t at = lines.branch(); at < nodes.at.size())
    return fail("expected a polyline that does not branch, found " + std::to_string(lines.degree(at)) +
                    " segments that meet at " + place(nodes.at[at]),
                "take the branches away, or give each a soft body of its own");
  bool closed = false;
  std::vector<std::vector<math::Vec3>> rows = lines.in_rows(closed);
  if (rows.size() > 1)
    return fail("expected one polyline, found " + std::to_string(rows.size()) + ", of which the second begins at " +
                    place(rows[1].front()),
                "join them, or give each a soft body of its own");
  if (closed)
    return fail("expected a polyline with two ends, found a closed one through " + place(rows.front().front()),
                "take one of its segments away");
  if (!nodes.triangles.empty())
    findings.warning(
        block.identity, "mesh",
        std::to_string(nodes.triangles.size()) + " triangles beside the polyline have no effect on a thread",
        "it is drawn as a tube of its radius");
  return std::move(rows.front());
}

}  // namespace ambf::model
