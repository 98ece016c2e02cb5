#include "scene/lookup.h"

#include <algorithm>
#include <cctype>
#include <unordered_set>

namespace ambf::scene {

namespace {

// Longer words are no typing errors of keys, and the distance costs the product of the lengths.
constexpr std::size_t kLongestWord = 64;
constexpr std::size_t kTwoErrors = 5;      // from so many letters on, two errors are taken for typing errors
constexpr std::size_t kShortestBegin = 3;  // letters with which two words must begin to be taken for one

// Is `wanted` all that stands behind a namespace ('/') or behind the prefix of a block ("BODY ")?
bool ends_behind(char separator, std::string_view identifier, std::string_view wanted) {
  if (!identifier.ends_with(wanted)) return false;
  const std::size_t start = identifier.size() - wanted.size();
  return start == 0 || identifier[start - 1] == separator;
}

std::string_view without_slash(std::string_view name) {
  if (name.starts_with('/')) name.remove_prefix(1);
  return name;
}

std::string folded(std::string_view text) {
  std::string out;
  for (char c : text) {
    out += c == '_' || c == '-' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return out;
}

// Optimal string alignment: insertions, deletions, changes and swaps of neighbours.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before, previous(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, previous[j - 1] + (a[i - 1] == b[j - 1] ? 0u : 1u)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        current[j] = std::min(current[j], before[j - 2] + 1);
    }
    before = previous;
    previous = current;
  }
  return previous[b.size()];
}

// The shortest word that `word` begins, else the longest that begins it: "std" -> "std dev", "lower" -> "low".
std::string beginning_alike(const std::string& word, const std::vector<std::string>& known) {
  if (word.size() < kShortestBegin) return {};
  const std::string *longer = nullptr, *shorter = nullptr;
  for (const std::string& candidate : known) {
    if (candidate.size() < kShortestBegin || candidate.size() > kLongestWord) continue;
    const std::string other = folded(candidate);
    if (other.starts_with(word) && (!longer || other.size() < longer->size())) longer = &candidate;
    if (word.starts_with(other) && (!shorter || other.size() > shorter->size())) shorter = &candidate;
  }
  const std::string* best = longer ? longer : shorter;
  return best ? *best : std::string();
}

}  // namespace

Lookup find_identifier(const std::vector<std::string>& identifiers, std::string_view wanted) {
  Lookup result;
  if (wanted.empty()) return result;
  std::vector<std::size_t> behind_namespace, behind_prefix;
  for (std::size_t i = 0; i < identifiers.size(); ++i) {
    if (identifiers[i] == wanted) {
      result.index = i;
      result.candidates.clear();
      return result;
    }
    if (identifiers[i].find(wanted) == std::string::npos) continue;
    result.candidates.push_back(i);
    if (ends_behind('/', identifiers[i], wanted)) behind_namespace.push_back(i);
    if (ends_behind(' ', identifiers[i], wanted)) behind_prefix.push_back(i);
  }
  for (const auto* found : {&result.candidates, &behind_namespace, &behind_prefix}) {
    if (found->size() != 1) continue;
    result.index = found->front();
    result.candidates.clear();
    return result;
  }
  // A namespace may be written with and without its first slash.
  if (result.candidates.empty() && wanted.starts_with('/')) return find_identifier(identifiers, without_slash(wanted));
  return result;
}

Lookup find_joint_body(const std::vector<std::string>& own_bodies, const std::vector<std::string>& world_bodies,
                       std::string_view wanted, std::string_view joint_namespace, std::string_view conflict_number) {
  if (wanted.empty()) return {};
  const std::string full = std::string(joint_namespace) + std::string(wanted);
  // Whole names first: nearly all files write them, and parts cost more.
  for (const std::string& name : {std::string(wanted), full}) {
    const auto found = std::find(own_bodies.begin(), own_bodies.end(), name);
    if (found != own_bodies.end()) return {static_cast<std::size_t>(found - own_bodies.begin()), {}, false};
  }
  Lookup own = find_identifier(own_bodies, wanted);
  if (own.index) return own;
  if (Lookup found = find_identifier(own_bodies, full); found.index) return found;
  Lookup world = find_identifier(world_bodies, full + std::string(conflict_number));
  if (!world.index) world = find_identifier(world_bodies, wanted);
  world.in_world = true;
  if (!world.index && world.candidates.empty()) return own;
  return world;
}

std::string join_namespace(std::string_view header, std::string_view block) {
  std::string joined = block.starts_with('/') ? std::string(block) : std::string(header) + std::string(block);
  joined.erase(std::unique(joined.begin(), joined.end(), [](char a, char b) { return a == '/' && b == '/'; }),
               joined.end());
  return joined;
}

std::string conflict_number(const std::vector<std::string>& taken, std::string_view name) {
  const std::unordered_set<std::string_view> names(taken.begin(), taken.end());
  if (!names.contains(name)) return {};
  for (std::size_t number = 1;; ++number) {
    std::string text = std::to_string(number);
    if (!names.contains(std::string(name) + text)) return text;
  }
}

std::optional<std::size_t> find_numbered(const std::vector<std::string>& identifiers, std::string_view name) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < identifiers.size(); ++i) {
    const std::string& each = identifiers[i];
    const bool numbered = each.starts_with(name) && each.find_first_not_of("0123456789", name.size()) == each.npos;
    if (numbered && (!best || each.size() < identifiers[*best].size())) best = i;
  }
  return best;
}

std::string nearest(std::string_view wanted, const std::vector<std::string>& known) {
  if (wanted.empty() || wanted.size() > kLongestWord) return {};
  const std::string word = folded(wanted);
  const std::string* best = nullptr;
  // Two errors in a short word make another word of it.
  std::size_t best_distance = std::max<std::size_t>(wanted.size() < kTwoErrors ? 1 : 2, wanted.size() / 3) + 1;
  for (const std::string& candidate : known) {
    if (candidate.size() > kLongestWord) continue;
    const std::size_t distance = edit_distance(word, folded(candidate));
    if (distance < best_distance) {
      best_distance = distance;
      best = &candidate;
    }
  }
  return best ? *best : beginning_alike(word, known);
}

}  // namespace ambf::scene
