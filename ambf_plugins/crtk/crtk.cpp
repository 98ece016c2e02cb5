#include "crtk/crtk.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "base/realtime.h"
#include "crtk/served_arm.h"
#include "ros_comm/node.h"

namespace ambf::crtk {

namespace {

using namespace std::chrono_literals;

constexpr auto kFrameWait = 20ms;
constexpr auto kOpenEvery = 50ms;

}  // namespace

struct Interface::Impl {
  Impl(std::vector<adf::CrtkArm> descriptions, std::string name_space_in, const state::Abilities& simulation,
       ros_comm::Node& node_in, base::Log& log_in, int priority)
      : name_space(std::move(name_space_in)), node(node_in), log(log_in) {
    for (adf::CrtkArm& arm : descriptions) {
      arms.push_back(std::make_unique<ServedArm>(std::move(arm), simulation, log));
    }
    reader = simulation.observe.make_reader();
    if (reader == nullptr) {
      log.error("CRTK: no arm is served: too many parts read the simulation's frames");
      return;
    }
    mover = std::thread([this, priority] { move(priority); });
    opener = std::thread([this] { open(); });
  }

  ~Impl() {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      stopping = true;
    }
    wake.notify_all();
    if (opener.joinable()) opener.join();
    for (const auto& arm : arms) arm->close();
    if (mover.joinable()) mover.join();
  }

  void move(int priority) {
    base::enter_real_time("crtk", priority);
    std::uint64_t sequence = 0;
    while (!stopping) {
      reader->wait_newer(sequence, kFrameWait);
      const state::Frame* frame = reader->latest();
      if (frame == nullptr || frame->structure == nullptr) {
        std::this_thread::sleep_for(kFrameWait);
        continue;
      }
      sequence = frame->sequence;
      for (const auto& arm : arms) arm->update(*frame);
    }
  }

  // Registering topics takes as long as the master does: the arms move meanwhile.
  void open() {
    base::set_thread_name("crtk topics");
    std::vector<bool> failed(arms.size(), false);
    std::unique_lock<std::mutex> lock(mutex);
    while (!stopping) {
      for (std::size_t i = 0; i < arms.size() && node.connected(); ++i) {
        if (stopping || failed[i] || !arms[i]->wants_topics()) continue;
        lock.unlock();
        try {
          arms[i]->open(node, name_space);
        } catch (const std::exception& problem) {
          failed[i] = true;
          log.error("CRTK: arm %s has no topics: %s", arms[i]->name().c_str(), problem.what());
        }
        lock.lock();
      }
      wake.wait_for(lock, kOpenEvery);
    }
  }

  const std::string name_space;
  ros_comm::Node& node;
  base::Log& log;
  std::vector<std::unique_ptr<ServedArm>> arms;
  std::unique_ptr<state::FrameReader> reader;
  std::mutex mutex;
  std::condition_variable wake;
  std::atomic<bool> stopping{false};
  std::thread mover, opener;
};

Interface::Interface(std::vector<adf::CrtkArm> arms, const std::string& name_space, const state::Abilities& simulation,
                     ros_comm::Node& node, base::Log& log, int priority)
    : impl_(std::make_unique<Impl>(std::move(arms), name_space, simulation, node, log, priority)) {}

Interface::~Interface() = default;

}  // namespace ambf::crtk
