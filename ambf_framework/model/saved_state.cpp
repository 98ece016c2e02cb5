#include "model/saved_state.h"

#include <cmath>

#include "base/hash.h"
#include "model/detail/state_bytes.h"
#include "model/kinds/placed.h"
#include "model/kinds/registry.h"
#include "physics/world.h"
#include "state/kind_rows.h"

namespace ambf::model {
namespace {

constexpr std::uint64_t kMagic = 0x4554415453464d41;  // "AMFSTATE"
constexpr std::uint32_t kVersion = 10;
constexpr std::uint64_t kMaxSteps = std::uint64_t{1} << 53;
constexpr std::uint64_t kMaxOrder = std::uint64_t{1} << 62;  // of posts: none will ever wrap round

std::uint64_t fnv1a(const std::uint8_t* data, std::size_t size) {
  base::Fnv1a hash;
  hash.add_bytes(data, size);
  return hash.value();
}

// Which objects, of which kinds, in which order: a state fits no other structure.
std::uint64_t fingerprint(const state::Structure& structure) {
  base::Fnv1a hash;
  for (const state::ObjectInfo& object : structure.objects) {
    hash.add_byte(static_cast<unsigned char>(object.kind));
    hash.add_text(object.identifier);
    hash.add_byte(0);
  }
  return hash.value();
}

void transfer_commands(StateArchive& archive, std::vector<SavedCommand>& commands, const Kind& kind,
                       const SavedContext& context) {
  archive.size(commands, base::kMaxSources, 1 + sizeof(double), "the number of sources");
  int last_source = -1;
  for (SavedCommand& saved : commands) {
    archive.choice(saved.source, 0, base::kMaxSources - 1, "the source of a command");
    archive.require(saved.source > last_source, "sources must come in their order, each once");
    last_source = saved.source;
    archive.count(saved.order, 1, context.last_order, "the order of a command");
    archive.number(saved.age_s, 0.0, kMaxSaved, "the age of a command");
    kind.transfer(archive, saved.command, context);
  }
}

void transfer(StateArchive& archive, SavedState& saved, const state::Structure& structure, double step_s) {
  archive.size(saved.physics, std::size_t{1} << 40, 1, "the length of physics' part");
  archive.bytes(saved.physics.data(), saved.physics.size());
  archive.count(saved.steps, 0, kMaxSteps, "the number of steps");
  archive.number(saved.sim_time, 0.0, kMaxSaved, "the time");
  archive.require(
      !(std::abs(saved.sim_time - static_cast<double>(saved.steps) * step_s) > 1e-6 * (1.0 + saved.sim_time)),
      "the time must be that of its steps");
  archive.count(saved.last_order, 0, kMaxOrder, "the number of commands");
  for (const auto& kind : kinds()) {
    const state::KindRows& rows = state::rows_of(kind->number());
    auto& objects = saved.objects[static_cast<std::size_t>(kind->number())];
    for (std::uint32_t slot = 0; slot < objects.size(); ++slot) {
      archive.at("'" + structure.objects[rows.object(structure, slot)].name + "'");
      const SavedContext context{structure, slot, step_s, saved.last_order};
      kind->transfer(archive, *objects[slot], context);
      if (kind->info().has_topics) transfer_commands(archive, objects[slot]->commands, *kind, context);
    }
  }
  archive.at("");
  transfer_effectors(archive, saved.effectors, structure);
}

const SavedPlaced& placed(const SavedState& saved, state::ObjectKind kind, std::uint32_t slot) {
  return static_cast<const SavedPlaced&>(*saved.objects[static_cast<std::size_t>(kind)][slot]);
}

// ---- What holds between several of them.

// Objects may hang on each other, but never in a circle.
std::string check_circles(const SavedState& saved, const state::Structure& structure) {
  const auto parent_of = [&](std::uint32_t object) {
    const state::ObjectInfo& info = structure.objects[object];
    return state::info_of(info.kind).has_parent ? placed(saved, info.kind, info.slot).parent_object : state::kNone;
  };
  for (std::uint32_t start = 0; start < structure.objects.size(); ++start) {
    std::size_t links = 0;
    for (std::uint32_t object = start; object != state::kNone; object = parent_of(object))
      if (++links > structure.objects.size())
        return "'" + structure.objects[start].name + "': what it hangs on must not hang on itself";
  }
  return {};
}

std::string check_physics(const SavedState& saved, const state::Structure& structure, double step_s) {
  physics::StateLayout layout{{}, structure.joints.size(), 0, step_s};
  for (const auto& kind : kinds()) layout.grasps += kind->grasps(structure);
  for (const state::BodyInfo& body : structure.bodies) layout.is_static.push_back(body.mass == 0.0);
  const auto fault = physics::World::check_state(saved.physics, layout);
  if (!fault) return {};
  if (fault->of == physics::StateFault::Of::whole) return fault->message;
  if (fault->of == physics::StateFault::Of::grasp) return "what an actuator holds: " + fault->message;
  const std::uint32_t object = fault->of == physics::StateFault::Of::body ? structure.bodies[fault->index].object
                                                                          : structure.joints[fault->index].object;
  return "'" + structure.objects[object].name + "': " + fault->message;
}

struct Head {
  std::uint64_t magic = 0;
  std::uint32_t version = 0;
  std::uint32_t zero = 0;
  std::uint64_t fingerprint = 0;
};
static_assert(sizeof(Head) == kStateHeadBytes);

}  // namespace

std::vector<ParentChange> parent_changes(const SavedState& state, const state::Structure& structure) {
  std::vector<ParentChange> changes;
  for (const auto& kind : kinds()) {
    if (!kind->info().has_parent) continue;
    const state::KindRows& rows = state::rows_of(kind->number());
    for (std::uint32_t slot = 0; slot < rows.count(structure); ++slot) {
      const state::PlacedInfo& now = *rows.placed(structure, slot);
      const SavedPlaced& saved = placed(state, kind->number(), slot);
      const std::uint32_t parent = saved.parent_object;
      if (parent == now.parent_object && saved.parent_name == now.parent_name) continue;
      changes.push_back({structure.objects[now.object].id,
                         parent == state::kNone ? state::ObjectId{} : structure.objects[parent].id, saved.parent_name});
    }
  }
  return changes;
}

std::vector<std::uint8_t> encode(SavedState& state, const state::Structure& structure) {
  std::vector<std::uint8_t> bytes;
  StateWriter out(bytes);
  Head head{kMagic, kVersion, 0, fingerprint(structure)};
  out.bytes(&head, sizeof head);
  transfer(out, state, structure, 1.0);
  std::uint64_t checksum = fnv1a(bytes.data(), bytes.size());
  out.bytes(&checksum, sizeof checksum);
  return bytes;
}

std::string check_head(const std::vector<std::uint8_t>& bytes) {
  Head head;
  if (bytes.size() < sizeof head) return "not a saved state";
  std::memcpy(&head, bytes.data(), sizeof head);
  if (head.magic != kMagic) return "not a saved state";
  if (head.version != kVersion)
    return "saved by another version of AMBF (format " + std::to_string(head.version) + ", expected " +
           std::to_string(kVersion) + ")";
  return {};
}

std::string decode(const std::vector<std::uint8_t>& bytes, const state::Structure& structure, double step_s,
                   SavedState& out) {
  std::uint64_t checksum = 0;
  Head head;
  if (std::string why = check_head(bytes); !why.empty()) return why;
  if (bytes.size() < sizeof head + sizeof checksum) return "not a saved state";
  const std::size_t size = bytes.size() - sizeof checksum;
  std::memcpy(&checksum, bytes.data() + size, sizeof checksum);
  StateReader in(bytes.data(), size);
  in.bytes(&head, sizeof head);
  if (checksum != fnv1a(bytes.data(), size)) return "the saved state is damaged: its checksum is wrong";
  if (head.zero != 0) return "the saved state is damaged: four bytes of its head must be 0 (at byte 12)";
  if (head.fingerprint != fingerprint(structure)) return "the saved state belongs to other objects than those loaded";

  out.objects.clear();
  out.objects.resize(state::kind_count());
  for (const auto& kind : kinds()) {
    auto& objects = out.objects[static_cast<std::size_t>(kind->number())];
    objects.resize(state::rows_of(kind->number()).count(structure));
    for (auto& object : objects) object = kind->make_saved();
  }
  transfer(in, out, structure, step_s);
  std::string wrong = in.complaint();
  if (wrong.empty() && in.left() != 0) wrong = std::to_string(in.left()) + " bytes too many";
  if (wrong.empty()) wrong = check_circles(out, structure);
  if (wrong.empty()) wrong = check_physics(out, structure, step_s);
  return wrong.empty() ? wrong : "the saved state is damaged: " + wrong;
}

}  // namespace ambf::model
