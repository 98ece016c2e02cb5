#include "comm/server.h"

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>
#include <unordered_map>
#include <vector>

#include "base/clock.h"
#include "comm/detail/advertiser.h"
#include "comm/detail/instance.h"

namespace ambf::comm {

namespace {

using namespace std::chrono_literals;

constexpr auto kPublisherIdleWait =
    5ms;  // a simulation in a long step publishes no frames, but its last state stays due
constexpr double kWorldLowHz = 50.0, kWorldHighHz = 1000.0;
constexpr std::int64_t kReportEvery_ns = 1'000'000'000;
constexpr int kMaxStepsAtOnce = 256;  // a free run makes them as fast as they are published: others wait no longer
constexpr std::uint64_t kWorldKey = ~std::uint64_t{0};

std::uint64_t key_of(state::ObjectId id) { return (std::uint64_t{id.generation} << 32) | id.index; }

// CPU time of the publisher thread per frame, reported once a second. The thread's CPU clock is read only then.
class Cost {
 public:
  void count(std::int64_t now_ns, bool newer, state::ObserveAbility& observe) {
    frames_ += newer ? 1 : 0;
    if (now_ns - reported_ns_ < kReportEvery_ns) return;
    const std::int64_t cpu_ns = base::thread_cpu_ns();
    if (reported_ns_ != 0 && frames_ > 0) {
      observe.report_comm(base::to_seconds(cpu_ns - cpu_ns_) / static_cast<double>(frames_));
    }
    reported_ns_ = now_ns;
    cpu_ns_ = cpu_ns;
    frames_ = 0;
  }

 private:
  std::int64_t reported_ns_ = 0, cpu_ns_ = 0;
  std::uint64_t frames_ = 0;
};

}  // namespace

struct Server::Impl {
  Impl(state::ObserveAbility& observe_in, Middleware& middleware_in, ServerOptions options_in)
      : observe(observe_in),
        middleware(middleware_in),
        options(std::move(options_in)),
        advertiser(middleware_in, options.advertising_threads),
        publisher([this] { publish(); }) {}

  ~Impl() {
    stopping = true;
    publisher.join();
    // The advertising threads close them, several at once: each closing waits for the master.
    // The world is the first of them and goes last.
    for (auto instance = current.rbegin(); instance != current.rend(); ++instance) drop(*instance);
  }

  void drop(const InstancePtr& instance) {
    advertiser.close(instance);
    middleware.release(instance->address);
  }

  // `object`: null for the world.
  InstancePtr make_instance(const state::Structure& structure, const state::ObjectInfo* object) {
    if (object == nullptr) {
      return std::make_shared<Instance>(std::nullopt, middleware.reserve(structure.world_name),
                                        PublishRate(kWorldLowHz, kWorldHighHz, options.rates));
    }
    return std::make_shared<Instance>(*object, middleware.reserve(object->name),
                                      PublishRate(object->rate_low_hz, object->rate_high_hz, options.rates));
  }

  // Compares the instances with the objects that exist now; opens and closes accordingly.
  void adopt(const state::Structure& structure) {
    std::vector<std::pair<std::uint64_t, const state::ObjectInfo*>> wanted{{kWorldKey, nullptr}};
    for (const state::ObjectInfo& object : structure.objects) {
      if (!object.passive && middleware.serves(object)) wanted.emplace_back(key_of(object.id), &object);
    }
    // Removed objects first, so that new ones can reuse their addresses.
    std::unordered_map<std::uint64_t, InstancePtr> kept;
    for (const auto& [key, object] : wanted) {
      const auto found = instances.find(key);
      if (found != instances.end()) kept.insert(*found);
    }
    for (const auto& [key, instance] : instances) {
      if (kept.count(key) == 0) drop(instance);
    }
    current.clear();
    for (auto& [key, object] : wanted) {
      InstancePtr& instance = kept[key];
      if (instance == nullptr) {
        instance = make_instance(structure, object);
        advertiser.open(instance);
      }
      if (object != nullptr) instance->slot = object->slot;
      current.push_back(instance);
    }
    instances = std::move(kept);
  }

  // Publishes the steps that recorders requested, each to its own endpoints. Adopts newer structures on the way. False:
  // some may be left, because the recorders have no room for them, or there are too many.
  bool publish_steps() {
    const bool wanted = middleware.steps_wanted();
    if (!wanted) steps.reset();
    if (wanted && steps == nullptr) steps = observe.read_steps();
    if (steps == nullptr) return true;
    for (int left = kMaxStepsAtOnce; left > 0; --left) {
      if (!real_time && !middleware.room_for_step()) return false;
      const state::Frame* step = steps->next();
      if (step == nullptr) return true;
      real_time = !step->run.fixed_step && !step->run.throttled;
      // A step of before a load or an unload is older than what is adopted only at the very begin of recording.
      if (adopted_version && step->structure->version < *adopted_version) continue;
      adopt_if_new(*step->structure);
      step_ns = step->steady_ns;
      bool published = false;
      for (const InstancePtr& instance : current) {
        Endpoint* endpoint = instance->open_endpoint();
        if (endpoint == nullptr || !endpoint->has_subscribers()) continue;
        const std::uint32_t interval = endpoint->step_interval();
        if (interval == 0 || step->sim_step % interval != 0) continue;
        endpoint->publish(*step, instance->slot);
        published = true;
      }
      if (published) middleware.step_published(*step);
    }
    return false;
  }

  void adopt_if_new(const state::Structure& structure) {
    if (adopted_version == structure.version) return;
    adopt(structure);
    adopted_version = structure.version;
  }

  void publish() {
    if (options.publisher_thread_started) options.publisher_thread_started();
    const std::unique_ptr<state::FrameReader> reader = observe.make_reader();
    if (reader == nullptr) return;
    std::uint64_t sequence = 0, toggles = 0, epoch = 0;
    bool reset_unrecorded = false;  // one that is not shown yet where steps are recorded
    Cost cost;
    while (!stopping) {
      const bool newer = reader->wait_newer(sequence, kPublisherIdleWait);
      const state::Frame* frame = reader->latest();
      if (frame == nullptr) continue;
      sequence = frame->sequence;
      const bool all_steps = publish_steps();
      if (adopted_version && frame->structure->version < *adopted_version) continue;  // the steps are newer
      adopt_if_new(*frame->structure);
      // A finished throttle toggle (or a reset) shows at once, whatever the rates say: the client waits for it.
      const bool all = frame->toggles != toggles || frame->epoch != epoch;
      reset_unrecorded |= frame->epoch != epoch;
      toggles = frame->toggles;
      epoch = frame->epoch;
      const std::int64_t now = base::steady_ns();
      for (const InstancePtr& instance : current) {
        Endpoint* endpoint = instance->open_endpoint();
        if (endpoint == nullptr) continue;
        const bool active = instance->active(*frame);
        if (newer) endpoint->watch(*frame, active);
        if (!endpoint->has_subscribers()) continue;
        if (steps != nullptr && endpoint->step_interval() > 0) {
          // Its steps are published above. A reset, or somebody who subscribes while the world waits, shows at once.
          if ((reset_unrecorded || endpoint->has_newcomers()) && all_steps && frame->steady_ns >= step_ns) {
            endpoint->publish(*frame, instance->slot);
          }
          continue;
        }
        const bool due = instance->rate.due(now, active, newer);
        if (due || all) endpoint->publish(*frame, instance->slot);
      }
      if (all_steps) reset_unrecorded = false;
      cost.count(now, newer, observe);
    }
    steps.reset();
  }

  state::ObserveAbility& observe;
  Middleware& middleware;
  const ServerOptions options;
  Advertiser advertiser;

  std::unordered_map<std::uint64_t, InstancePtr> instances;  // publisher thread
  std::vector<InstancePtr> current;                          // publisher thread: the same, in load order
  std::optional<std::uint64_t> adopted_version;              // publisher thread: the structure they belong to
  std::unique_ptr<state::StepReader> steps;                  // publisher thread: while recorders request steps
  bool real_time = false;                                    // publisher thread: as the last step said
  std::int64_t step_ns = 0;                                  // publisher thread: time of the last step it read
  std::atomic<bool> stopping{false};
  std::thread publisher;  // last: uses all of the above
};

Server::Server(state::ObserveAbility& observe, Middleware& middleware, ServerOptions options)
    : impl_(std::make_unique<Impl>(observe, middleware, std::move(options))) {}

Server::~Server() = default;

std::size_t Server::open_endpoints() const { return impl_->advertiser.open_count(); }

}  // namespace ambf::comm
