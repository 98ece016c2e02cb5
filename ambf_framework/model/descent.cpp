// The lists of Alg. 1 without its tables: a link's time is its place in load order, and a body's list is replayed from
// the links below it.
#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>

#include "model/detail/lineage.h"

namespace ambf::model {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

}  // namespace

struct Descent::Node {
  std::uint32_t body = 0;
  std::vector<std::uint32_t> links;                   // to children, by time
  std::uint32_t parents = 0;                          // links from them
  std::uint32_t first_below = kNone, last_below = 0;  // times of links anywhere below; in trees only
  std::uint32_t mechanism = kNone;                    // with loops
  std::uint32_t place = 0;                            // in it
};

// Alg. 1 itself, for mechanisms in which there are several ways from one body to another.
struct Descent::Mechanism {
  struct Member {
    std::vector<std::uint32_t> descendants, found_by, closing;  // places; joints; joints
    std::vector<bool> knows_body, knows_link;                   // by place and by link of the mechanism
    std::vector<std::uint32_t> parents;
  };
  std::vector<std::uint32_t> bodies;  // by place
  std::vector<std::uint32_t> links;   // indices, by time
  std::vector<Member> members;

  void replay(const std::vector<Lineage::Link>& all, const std::function<std::uint32_t(std::uint32_t)>& place_of) {
    members.resize(bodies.size());
    for (Member& member : members) {
      member.knows_body.assign(bodies.size(), false);
      member.knows_link.assign(links.size(), false);
    }
    std::unordered_map<std::uint32_t, std::size_t> number;  // joint -> its place in `links`
    for (std::size_t i = 0; i < links.size(); ++i) number[all[links[i]].joint] = i;
    for (const std::uint32_t link : links)
      connect(place_of(all[link].parent), place_of(all[link].child), all[link].joint, number);
  }

  // Everything above learns of everything below.
  void connect(std::uint32_t parent, std::uint32_t child, std::uint32_t joint,
               const std::unordered_map<std::uint32_t, std::size_t>& number) {
    // Copies: in a directed cycle a body is above and below at once.
    const std::vector<std::uint32_t> below = members[child].descendants, found_by = members[child].found_by,
                                     closing = members[child].closing;
    const auto list = [&](Member& above, std::uint32_t above_place, std::uint32_t place, std::uint32_t by) {
      if (above.knows_link[number.at(by)]) return;
      above.knows_link[number.at(by)] = true;
      if (place != above_place && !above.knows_body[place]) {
        above.knows_body[place] = true;
        above.descendants.push_back(place);
        above.found_by.push_back(by);
      } else {
        above.closing.push_back(by);
      }
    };
    for (const std::uint32_t above : with_ancestors(parent)) {
      Member& member = members[above];
      for (std::size_t i = 0; i < below.size(); ++i) list(member, above, below[i], found_by[i]);
      list(member, above, child, joint);
      for (const std::uint32_t by : closing) {
        if (!member.knows_link[number.at(by)]) member.closing.push_back(by);
        member.knows_link[number.at(by)] = true;
      }
    }
    members[child].parents.push_back(parent);
  }

  std::vector<std::uint32_t> with_ancestors(std::uint32_t place) const {
    std::vector<std::uint32_t> all{place};
    std::vector<bool> known(bodies.size(), false);
    known[place] = true;
    for (std::size_t i = 0; i < all.size(); ++i)
      for (const std::uint32_t parent : members[all[i]].parents) {
        if (known[parent]) continue;
        known[parent] = true;
        all.push_back(parent);
      }
    return all;
  }
};

Descent::Descent(const Lineage& lineage) : links_(lineage.links()) {
  for (std::uint32_t time = 0; time < links_.size(); ++time) {
    const std::uint32_t parent = node_of(links_[time].parent), child = node_of(links_[time].child);
    nodes_[parent].links.push_back(time);
    ++nodes_[child].parents;
    children_.push_back(child);
  }
  find_loops();
  find_times();
}

Descent::~Descent() = default;

std::uint32_t Descent::node_of(std::uint32_t body) {
  const auto [at, is_new] = numbers_.try_emplace(body, static_cast<std::uint32_t>(nodes_.size()));
  if (is_new) nodes_.emplace_back().body = body;
  return at->second;
}

// A mechanism with as many links as bodies has a second way between two of them.
void Descent::find_loops() {
  std::vector<std::uint32_t> root(nodes_.size());
  std::iota(root.begin(), root.end(), 0U);
  const auto root_of = [&root](std::uint32_t node) {
    while (root[node] != node) node = root[node] = root[root[node]];
    return node;
  };
  std::vector<bool> loops(nodes_.size(), false);
  for (const Lineage::Link& link : links_) {
    const std::uint32_t a = root_of(numbers_[link.parent]), b = root_of(numbers_[link.child]);
    loops[b] = loops[a] || loops[b] || a == b;
    root[a] = b;
  }
  std::vector<std::uint32_t> mechanism(nodes_.size(), kNone);  // by root
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    const std::uint32_t of = root_of(node);
    if (!loops[of]) continue;
    if (mechanism[of] == kNone) {
      mechanism[of] = static_cast<std::uint32_t>(mechanisms_.size());
      mechanisms_.push_back(std::make_unique<Mechanism>());
    }
    Mechanism& whole = *mechanisms_[mechanism[of]];
    nodes_[node].mechanism = mechanism[of];
    nodes_[node].place = static_cast<std::uint32_t>(whole.bodies.size());
    whole.bodies.push_back(nodes_[node].body);
  }
  for (std::uint32_t time = 0; time < links_.size(); ++time)
    if (const std::uint32_t of = mechanism[root_of(numbers_[links_[time].parent])]; of != kNone)
      mechanisms_[of]->links.push_back(time);
  for (const auto& whole : mechanisms_)
    whole->replay(links_, [this](std::uint32_t body) { return nodes_[numbers_[body]].place; });
}

void Descent::find_times() {
  const std::vector<Placed> order = from_the_roots();
  for (std::size_t i = order.size(); i-- > 0;) {
    Node& node = nodes_[numbers_[order[i].body]];
    if (node.mechanism != kNone) continue;
    for (const std::uint32_t time : node.links) {
      const Node& child = nodes_[children_[time]];
      node.first_below = std::min({node.first_below, time, child.first_below});
      node.last_below = std::max({node.last_below, time, child.last_below});
    }
  }
}

// Kahn's order: a node follows once all its parents came. What is left lies on directed cycles or below them.
std::vector<Descent::Placed> Descent::from_the_roots() const {
  std::vector<Placed> order;
  std::vector<std::uint32_t> missing(nodes_.size());
  std::vector<std::uint32_t> ready;
  std::vector<bool> placed(nodes_.size(), false);
  const auto place = [&](std::uint32_t node, std::uint32_t parent) {
    placed[node] = true;
    order.push_back({nodes_[node].body, nodes_[parent].body});
    ready.push_back(node);
  };
  const auto follow = [&](bool all_parents) {
    for (std::size_t i = 0; i < ready.size(); ++i)
      for (const std::uint32_t time : nodes_[ready[i]].links) {
        const std::uint32_t child = children_[time];
        if (missing[child] > 0) --missing[child];
        if (!placed[child] && (!all_parents || missing[child] == 0)) place(child, ready[i]);
      }
    ready.clear();
  };
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) missing[node] = nodes_[node].parents;
  for (std::uint32_t node = 0; node < nodes_.size(); ++node)
    if (missing[node] == 0) place(node, node);
  follow(true);
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    if (placed[node]) continue;
    place(node, node);
    follow(false);
  }
  return order;
}

Descent::Below Descent::below(std::uint32_t body) const {
  const auto at = numbers_.find(body);
  if (at == numbers_.end()) return {};
  const Node& node = nodes_[at->second];
  if (node.mechanism == kNone) return below_in_tree(at->second);
  const Mechanism& whole = *mechanisms_[node.mechanism];
  const Mechanism::Member& member = whole.members[node.place];
  Below below;
  for (const std::uint32_t place : member.descendants) below.bodies.push_back(whole.bodies[place]);
  below.joints = member.found_by;
  below.joints.insert(below.joints.end(), member.closing.begin(), member.closing.end());
  return below;
}

// Replays the links below one body, by time. A link brings what hung below its child at that time, then the child;
// later links below these come at their own times.
Descent::Below Descent::below_in_tree(std::uint32_t node) const {
  using Queue = std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>>;
  struct Replay {
    Queue due;               // times of links
    std::uint32_t until;     // only links before it
    std::uint32_t link = 0;  // whose child's list is being replayed
    std::size_t begin = 0;   // of that list in the result
    bool waits = false;
  };
  std::vector<std::uint32_t> found;  // links to what hangs below, in the order of the result
  std::vector<Replay> open;          // replays within replays
  const auto add_links = [&](Replay& replay, std::uint32_t of, std::uint32_t after) {
    const auto& links = nodes_[of].links;
    for (auto time = std::lower_bound(links.begin(), links.end(), after); time != links.end() && *time < replay.until;
         ++time)
      replay.due.push(*time);
  };
  open.push_back({{}, kNone});
  add_links(open.back(), node, 0);
  while (!open.empty()) {
    Replay& replay = open.back();
    const std::uint32_t child = replay.waits ? children_[replay.link] : kNone;
    if (replay.waits) {
      replay.waits = false;
      if (nodes_[child].last_below > replay.link) {
        for (std::size_t i = replay.begin; i < found.size(); ++i) add_links(replay, children_[found[i]], replay.link);
        add_links(replay, child, replay.link);
      }
      found.push_back(replay.link);
    } else if (replay.due.empty()) {
      open.pop_back();
    } else {
      replay.link = replay.due.top();
      replay.due.pop();
      replay.begin = found.size();
      replay.waits = true;
      const std::uint32_t brought = children_[replay.link], until = replay.link;
      if (nodes_[brought].first_below < until) {
        open.push_back({{}, until});
        add_links(open.back(), brought, 0);
      }
    }
  }
  Below below;
  for (const std::uint32_t link : found) {
    below.bodies.push_back(links_[link].child);
    below.joints.push_back(links_[link].joint);
  }
  return below;
}

}  // namespace ambf::model
