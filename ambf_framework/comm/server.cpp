#include "comm/server.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <vector>

namespace ambf::comm {

namespace {

using namespace std::chrono_literals;

constexpr auto kRetryInterval = 100ms;    // opening is tried again this often while there is no master
constexpr auto kPublisherIdleWait = 5ms;  // paused or throttled worlds publish no frames, but states stay due

std::int64_t steady_now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::uint64_t key_of(state::ObjectId id) { return (std::uint64_t{id.generation} << 32) | id.index; }
constexpr std::uint64_t kWorldKey = ~std::uint64_t{0};
constexpr double kWorldLowHz = 50.0, kWorldHighHz = 1000.0;

// One object's comm instance. The endpoint is set once by an advertising thread and read by the publisher.
struct Instance {
  Instance(std::uint64_t key_in, state::ObjectInfo object_in, const RateOverride& rates)
      : key(key_in), object(std::move(object_in)), rate(object.rate_low_hz, object.rate_high_hz, rates) {}

  const std::uint64_t key;
  const state::ObjectInfo object;
  PublishRate rate;                    // publisher thread only
  std::uint32_t slot = state::kNone;   // publisher thread only: index in the present structure's array
  std::unique_ptr<Endpoint> endpoint;  // published by `ready`
  std::atomic<bool> ready{false};
  std::atomic<bool> gone{false};  // the object was removed before or after its endpoint opened
};
using InstancePtr = std::shared_ptr<Instance>;

// Objects that publish something themselves; joints speak through their bodies.
bool has_topics(const state::ObjectInfo& object) {
  return !object.passive && object.kind != state::ObjectKind::joint && object.kind != state::ObjectKind::world;
}

bool is_active(const state::Frame& frame, state::ObjectKind kind, std::uint32_t slot) {
  switch (kind) {
    case state::ObjectKind::rigid_body: return frame.bodies[slot].active;
    case state::ObjectKind::camera: return frame.cameras[slot].active;
    case state::ObjectKind::light: return frame.lights[slot].active;
    case state::ObjectKind::world: return frame.run.throttled;
    case state::ObjectKind::joint: break;
  }
  return false;
}

}  // namespace

struct Server::Impl {
  Impl(state::Control& control_in, Middleware& middleware_in, ServerOptions options_in)
      : control(control_in), middleware(middleware_in), options(std::move(options_in)) {
    for (int i = 0; i < options.advertising_threads; ++i) advertisers.emplace_back([this] { advertise(); });
    publisher = std::thread([this] { publish(); });
  }

  ~Impl() {
    {
      const std::lock_guard lock(mutex);
      stopping = true;
      // What is open is closed by the advertisers in parallel: each closing waits for the master.
      jobs.clear();
    }
    publisher.join();
    {
      const std::lock_guard lock(mutex);
      for (auto& [key, instance] : instances) {
        instance->gone = true;
        jobs.push_back(instance);
      }
      instances.clear();
      current.clear();
    }
    wake.notify_all();
    for (std::thread& thread : advertisers) thread.join();
  }

  // Compares the instances with what exists now; opens and closes accordingly. Publisher thread.
  void adopt(const state::Structure& structure) {
    std::vector<InstancePtr> next;
    std::unordered_map<std::uint64_t, InstancePtr> kept;
    const std::lock_guard lock(mutex);
    const auto take = [&](std::uint64_t key, const state::ObjectInfo& object) {
      const auto found = instances.find(key);
      InstancePtr instance =
          found != instances.end() ? found->second : std::make_shared<Instance>(key, object, options.rates);
      if (found == instances.end()) jobs.push_back(instance);
      instance->slot = object.slot;
      kept.emplace(key, instance);
      next.push_back(std::move(instance));
    };
    state::ObjectInfo world;
    world.kind = state::ObjectKind::world;
    world.name = structure.world_name;
    world.rate_low_hz = kWorldLowHz;
    world.rate_high_hz = kWorldHighHz;
    take(kWorldKey, world);
    for (const state::ObjectInfo& object : structure.objects) {
      if (has_topics(object)) take(key_of(object.id), object);
    }
    for (auto& [key, instance] : instances) {
      if (kept.count(key) != 0) continue;
      instance->gone = true;
      jobs.push_back(instance);
    }
    instances = std::move(kept);
    current = std::move(next);
    wake.notify_all();
  }

  void publish() {
    if (options.publisher_thread_started) options.publisher_thread_started();
    const std::unique_ptr<state::FrameReader> reader = control.make_reader();
    std::uint64_t sequence = 0, structure_version = 0;
    std::uint64_t toggles = 0, epoch = 0;
    bool adopted = false;
    while (!stopping) {
      reader->wait_newer(sequence, kPublisherIdleWait);
      const state::Frame* frame = reader->latest();
      if (frame == nullptr) continue;
      sequence = frame->sequence;
      if (!adopted || frame->structure->version != structure_version) {
        adopt(*frame->structure);
        structure_version = frame->structure->version;
        adopted = true;
      }
      // A finished throttle toggle (or a reset) shows at once, whatever the rates say: the client waits for it.
      const bool all = frame->toggles != toggles || frame->epoch != epoch;
      toggles = frame->toggles;
      epoch = frame->epoch;
      const std::int64_t now = steady_now_ns();
      for (const InstancePtr& instance : current) {
        if (!instance->ready.load(std::memory_order_acquire) || !instance->endpoint->has_subscribers()) continue;
        const bool due = instance->rate.due(now, is_active(*frame, instance->object.kind, instance->slot));
        if (due || all) instance->endpoint->publish(*frame, instance->slot);
      }
    }
  }

  // Opens endpoints of new instances and closes those of instances that are gone.
  void advertise() {
    std::unique_lock lock(mutex);
    while (true) {
      wake.wait_for(lock, kRetryInterval, [this] { return stopping || !jobs.empty(); });
      if (jobs.empty()) {
        if (stopping) return;
        continue;
      }
      const InstancePtr instance = jobs.front();
      if (!instance->gone && !stopping && !middleware.available()) {
        wake.wait_for(lock, kRetryInterval, [this] { return stopping.load(); });
        continue;
      }
      jobs.pop_front();
      lock.unlock();
      if (instance->gone) {
        close(*instance);
      } else {
        open(*instance);
      }
      lock.lock();
      const bool failed = !instance->gone && !instance->ready;
      if (failed && !stopping) {
        jobs.push_back(instance);
        wake.wait_for(lock, kRetryInterval, [this] { return stopping.load(); });
      } else if (instance->gone && instance->ready) {
        // Removed while it was being opened: the closing job may have come too early.
        jobs.push_back(instance);
      }
    }
  }

  void open(Instance& instance) {
    instance.endpoint = instance.object.kind == state::ObjectKind::world
                            ? middleware.open_world(instance.object.name, control)
                            : middleware.open(instance.object, control);
    if (instance.endpoint == nullptr) return;
    instance.ready.store(true, std::memory_order_release);
    ++open_count;
  }

  void close(Instance& instance) {
    // The publisher itself declared the instance gone and has dropped it: nobody publishes through it any more.
    if (!instance.ready.exchange(false)) return;
    instance.endpoint.reset();
    --open_count;
  }

  state::Control& control;
  Middleware& middleware;
  const ServerOptions options;

  std::mutex mutex;
  std::condition_variable wake;
  std::deque<InstancePtr> jobs;                              // guarded
  std::unordered_map<std::uint64_t, InstancePtr> instances;  // guarded
  std::vector<InstancePtr> current;                          // publisher thread; cleared at the end
  std::atomic<bool> stopping{false};
  std::atomic<std::size_t> open_count{0};
  std::vector<std::thread> advertisers;
  std::thread publisher;
};

Server::Server(state::Control& control, Middleware& middleware, ServerOptions options)
    : impl_(std::make_unique<Impl>(control, middleware, std::move(options))) {}

Server::~Server() = default;

std::size_t Server::open_endpoints() const { return impl_->open_count; }

}  // namespace ambf::comm
