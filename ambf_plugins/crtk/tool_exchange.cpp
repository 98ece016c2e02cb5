#include "crtk/tool_exchange.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <set>

#include "adf/crtk/mount.h"
#include "crtk/arm_kind.h"
#include "scene/lookup.h"

namespace ambf::crtk {

namespace {

using namespace std::chrono_literals;

constexpr auto kFrameWait = 20ms;
constexpr int kFrames = 250;  // that many waits for a frame are enough

class Exchange {
 public:
  Exchange(const state::Abilities& simulation, const adf::CrtkArm& arm, state::ObjectId base,
           const adf::CrtkInstrument& instrument, const std::atomic<bool>& stopping)
      : simulation_(simulation),
        arm_(arm),
        base_(base),
        instrument_(instrument),
        stopping_(stopping),
        reader_(simulation.observe.make_reader()) {}

  ExchangeResult run() {
    if (reader_ == nullptr) return {"too many parts read the simulation's frames", false};
    const state::Frame* frame = reader_->latest();
    if (frame == nullptr || frame->structure == nullptr) return {"there is no frame yet", false};
    if (std::string problem = read_place(*frame, true); !problem.empty()) return {problem, false};
    state::LoadRequest request;
    if (std::string problem = make_request(request); !problem.empty()) return {problem, false};
    request.check_only = true;
    if (std::string problem = load(std::move(request)); !problem.empty()) return {problem, false};
    frame = reader_->latest();  // its joints may have moved meanwhile
    if (std::string problem = read_place(*frame, true); !problem.empty()) return {problem, false};
    remove(*frame->structure);
    if (stopping_) return {"the program is ending", true};
    // Where the arm is without it.
    frame = frame_without();
    if (frame == nullptr) return {"the old instrument did not go", true};
    if (std::string problem = read_place(*frame, false); !problem.empty()) return {problem, true};
    state::LoadRequest mounted;
    if (std::string problem = make_request(mounted); !problem.empty()) return {problem, true};
    return {load(std::move(mounted)), true};
  }

 private:
  template <class Ask>
  state::Outcome ask(const Ask& ask) {
    const auto answer = std::make_shared<std::promise<state::Outcome>>();
    std::future<state::Outcome> given = answer->get_future();
    ask([answer](const state::Outcome& outcome) { answer->set_value(outcome); });
    return given.get();
  }

  std::string load(state::LoadRequest request) {
    const state::Outcome outcome =
        ask([&](state::Completion done) { simulation_.edit.load(std::move(request), std::move(done)); });
    if (outcome.success) return {};
    for (const base::Diagnostic& found : outcome.diagnostics) {
      if (found.severity == base::Severity::error) return base::to_string(found);
    }
    return outcome.message;
  }

  // Its namespace, the carrier's pose, and, of the arm as it was, its joints' positions.
  std::string read_place(const state::Frame& frame, bool with_joints) {
    const state::Structure& structure = *frame.structure;
    const std::uint32_t base = state::find(structure, base_);
    if (base == state::kNone) return "the arm's model is gone";
    const state::ObjectInfo& object = structure.objects[base];
    place_.name_space = object.name.substr(0, object.name.size() - object.local_name.size());
    place_.carrier = instrument_.carrier;
    // Only what hangs on the base: another arm may have the same name space, and conflict numbers behind its names.
    const state::BodyInfo& body = structure.bodies[object.slot];
    place_.identifiers.clear();
    for (const std::uint32_t child : body.children) place_.identifiers.push_back(structure.objects[child].identifier);
    const auto carrier = scene::find_numbered(place_.identifiers, place_.name_space + place_.carrier);
    if (!carrier) return "the arm's model has no body '" + place_.carrier + "' that could carry the instrument";
    place_.T_world_carrier = frame.bodies[structure.objects[body.children[*carrier]].slot].T_world_body;
    if (!with_joints) return {};
    for (const std::uint32_t slot : body.joints) {
      place_.positions[without_blanks(structure.joints[slot].name)] = frame.joints[slot].position;
    }
    return {};
  }

  std::string make_request(state::LoadRequest& request) {
    adf::Mounted mounted = adf::mounted(instrument_.file, place_);
    if (!mounted.text) {
      return mounted.diagnostics.empty() ? "its file is refused" : base::to_string(mounted.diagnostics.front());
    }
    request.path = instrument_.file;
    request.text = std::move(*mounted.text);
    return {};
  }

  // Bodies of any of the arm's instruments, and such as have lost the joints by which they hung on it.
  std::set<std::string> old_bodies(const state::Structure& structure) const {
    std::set<std::string> loose;
    for (const state::BodyInfo& body : structure.bodies) loose.insert(structure.objects[body.object].identifier);
    for (const state::BodyInfo& body : structure.bodies) {
      for (const std::uint32_t child : body.children) loose.erase(structure.objects[child].identifier);
    }
    std::vector<std::string> hanging;
    if (const std::uint32_t base = state::find(structure, base_); base != state::kNone) {
      for (const std::uint32_t child : structure.bodies[structure.objects[base].slot].children) {
        hanging.push_back(structure.objects[child].identifier);
      }
    }
    std::set<std::string> made;
    for (const adf::CrtkInstrument& each : arm_.instruments) {
      for (const std::string& block : each.bodies) {
        const std::string name = place_.name_space + block;
        if (const auto found = scene::find_numbered(hanging, name)) made.insert(hanging[*found]);
        if (loose.find(name) != loose.end()) made.insert(name);
      }
    }
    return made;
  }

  // A model that an exchange has brought goes as a whole, so that nothing of it is left.
  void remove(const state::Structure& structure) {
    std::set<std::string> old = old_bodies(structure);
    for (const state::ModelInfo& model : structure.models) {
      std::vector<std::string> bodies;
      for (const state::BodyInfo& body : structure.bodies) {
        const state::ObjectInfo& object = structure.objects[body.object];
        if (object.model == model.id) bodies.push_back(object.identifier);
      }
      const bool is_instrument = std::all_of(bodies.begin(), bodies.end(),
                                             [&](const std::string& name) { return old.find(name) != old.end(); });
      if (bodies.empty() || !is_instrument) continue;
      ask([&](state::Completion done) { simulation_.edit.unload(model.name, std::move(done)); });
      for (const std::string& name : bodies) old.erase(name);
    }
    for (const std::string& name : old) {
      ask([&](state::Completion done) { simulation_.edit.remove(name, std::move(done)); });
    }
  }

  const state::Frame* frame_without() {
    std::uint64_t sequence = 0;
    for (int i = 0; i < kFrames && !stopping_; ++i) {
      const state::Frame* frame = reader_->latest();
      if (old_bodies(*frame->structure).empty()) return frame;
      sequence = frame->sequence;
      reader_->wait_newer(sequence, kFrameWait);
    }
    return nullptr;
  }

  const state::Abilities& simulation_;
  const adf::CrtkArm& arm_;
  const state::ObjectId base_;
  const adf::CrtkInstrument& instrument_;
  const std::atomic<bool>& stopping_;
  std::unique_ptr<state::FrameReader> reader_;
  adf::Place place_;
};

}  // namespace

ExchangeResult exchange_tool(const state::Abilities& simulation, const adf::CrtkArm& arm, state::ObjectId base,
                             const adf::CrtkInstrument& instrument, const std::atomic<bool>& stopping) {
  return Exchange(simulation, arm, base, instrument, stopping).run();
}

}  // namespace ambf::crtk
