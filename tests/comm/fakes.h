// A simulation and a middleware made of a few lines, so that comm is tested without physics and without ROS.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "comm/middleware.h"
#include "state/abilities/observe.h"

namespace ambf::comm::testing {

// Waits until `condition` holds; false when it does not within a time that only a hang exceeds.
inline bool eventually(const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

// Publishes the frames that a test makes.
class FakeSimulation final : public state::ObserveAbility {
 public:
  void show(std::shared_ptr<const state::Frame> frame) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      latest_ = std::move(frame);
    }
    published_.notify_all();
  }

  std::unique_ptr<state::FrameReader> make_reader() override { return std::make_unique<Reader>(*this); }
  // The steps shown from now on are kept for one reader.
  std::unique_ptr<state::StepReader> read_steps() override {
    const std::lock_guard<std::mutex> lock(mutex_);
    steps_.clear();
    return std::make_unique<StepReader>(*this);
  }
  // A step that no published frame shows.
  void run_step(std::shared_ptr<const state::Frame> frame) {
    const std::lock_guard<std::mutex> lock(mutex_);
    steps_.push_back(std::move(frame));
  }
  std::shared_ptr<const state::Structure> structure() override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return latest_->structure;
  }
  void report_graphics(double, double) override {}
  void report_comm(double seconds_per_frame) override { reported_s = seconds_per_frame; }

  std::atomic<double> reported_s{-1.0};

 private:
  class Reader final : public state::FrameReader {
   public:
    explicit Reader(FakeSimulation& simulation) : simulation_(simulation) {}
    const state::Frame* latest() override {
      const std::lock_guard<std::mutex> lock(simulation_.mutex_);
      previous_ = std::exchange(latest_, simulation_.latest_);
      return latest_.get();
    }
    const state::Frame* previous() override { return previous_.get(); }
    bool wait_newer(std::uint64_t sequence, std::chrono::nanoseconds timeout) override {
      std::unique_lock<std::mutex> lock(simulation_.mutex_);
      return simulation_.published_.wait_for(
          lock, timeout, [&] { return simulation_.latest_ != nullptr && simulation_.latest_->sequence > sequence; });
    }

   private:
    FakeSimulation& simulation_;
    std::shared_ptr<const state::Frame> latest_, previous_;
  };

  class StepReader final : public state::StepReader {
   public:
    explicit StepReader(FakeSimulation& simulation) : simulation_(simulation) {}
    const state::Frame* next() override {
      const std::lock_guard<std::mutex> lock(simulation_.mutex_);
      read_ = nullptr;
      if (!simulation_.steps_.empty()) {
        read_ = simulation_.steps_.front();
        simulation_.steps_.pop_front();
      }
      return read_.get();
    }

   private:
    FakeSimulation& simulation_;
    std::shared_ptr<const state::Frame> read_;
  };

  std::mutex mutex_;
  std::condition_variable published_;
  std::deque<std::shared_ptr<const state::Frame>> steps_;
  std::shared_ptr<const state::Frame> latest_;
};

// Makes frames one after the other.
class Scene {
 public:
  // One body a name; their ids are their places in the first list they were in.
  void set_bodies(const std::vector<std::string>& names) {
    auto next = std::make_shared<state::Structure>();
    next->version = ++version_;
    next->world_name = "/env/World";
    for (const std::string& name : names) {
      state::ObjectInfo object;
      object.id = {ids_.emplace(name, static_cast<std::uint32_t>(ids_.size())).first->second, generation_};
      object.name = name;
      object.slot = static_cast<std::uint32_t>(next->bodies.size());
      object.passive = name.find("passive") != std::string::npos;
      state::BodyInfo body;
      body.object = static_cast<std::uint32_t>(next->objects.size());
      next->objects.push_back(object);
      next->bodies.push_back(body);
    }
    structure_ = next;
  }

  // The same names, but new objects that took the place of removed ones.
  void replace_bodies(const std::vector<std::string>& names) {
    ++generation_;
    set_bodies(names);
  }

  bool active = false;  // of all bodies
  bool throttled = false;
  std::uint32_t steps = 1;  // in each frame
  std::uint64_t toggles = 0;

  std::shared_ptr<const state::Frame> next() {
    std::shared_ptr<state::Frame> frame = state::make_frame(structure_);
    frame->sequence = ++sequence_;
    frame->sim_step = step_ += steps;
    frame->toggles = toggles;
    frame->steady_ns = base::steady_ns();
    frame->run.throttled = throttled;
    for (state::BodyState& body : frame->bodies) body.active = active;
    return frame;
  }

 private:
  std::map<std::string, std::uint32_t> ids_;
  std::shared_ptr<const state::Structure> structure_;
  std::uint64_t version_ = 0, sequence_ = 0;
  std::uint32_t generation_ = 0;
  std::uint32_t step_ = 0;
};

// Remembers what is open and what was published.
class FakeMiddleware final : public Middleware {
 public:
  struct Record {
    std::vector<std::uint32_t> steps;  // sim_step of each publication
    std::vector<std::uint32_t> slots;
    std::uint64_t watched = 0;
    bool last_active = false;
  };

  bool serves(const state::ObjectInfo& object) const override {
    return object.name.find("unserved") == std::string::npos;
  }
  std::string reserve(const std::string& name) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::string address = name;
    for (int i = 1; !reserved_.insert(address).second; ++i) address = name + std::to_string(i);
    return address;
  }
  void release(const std::string& address) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    EXPECT_EQ(reserved_.erase(address), 1u) << address;
  }
  std::unique_ptr<Endpoint> open(const state::ObjectInfo&, const std::string& address) override {
    std::this_thread::sleep_for(std::chrono::microseconds(opening_us));
    const std::lock_guard<std::mutex> lock(mutex_);
    EXPECT_EQ(open_.count("/env/World"), 1u) << "the world comes first";
    return open_now(address);
  }
  std::unique_ptr<Endpoint> open_world(const std::string& address) override {
    std::this_thread::sleep_for(std::chrono::microseconds(opening_us));
    const std::lock_guard<std::mutex> lock(mutex_);
    if (world_taken) return nullptr;
    return open_now(address);
  }
  bool available() const override { return is_available; }
  bool steps_wanted() override { return step_interval > 0; }

  std::multiset<std::string> open_addresses() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return open_;
  }
  std::size_t reserved() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return reserved_.size();
  }
  Record record(const std::string& address) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = records_.find(address);
    return found == records_.end() ? Record{} : found->second;
  }

  std::atomic<bool> is_available{true}, world_taken{false}, subscribed{true};
  std::atomic<std::uint32_t> step_interval{0};  // of all endpoints but the world's
  std::atomic<int> failures{0};                 // so many openings fail
  std::atomic<int> opening_us{0};
  std::atomic<int> publishing_us{0};  // processor time of each publication

 private:
  // Locked.
  std::unique_ptr<Endpoint> open_now(const std::string& address) {
    if (failures > 0) return --failures, nullptr;
    open_.insert(address);
    return std::make_unique<FakeEndpoint>(*this, address);
  }

  class FakeEndpoint final : public Endpoint {
   public:
    FakeEndpoint(FakeMiddleware& middleware, std::string address)
        : middleware_(middleware), address_(std::move(address)) {}
    ~FakeEndpoint() override {
      const std::lock_guard<std::mutex> lock(middleware_.mutex_);
      middleware_.open_.erase(middleware_.open_.find(address_));
      EXPECT_TRUE(address_ != "/env/World" || middleware_.open_.empty()) << "the world goes last";
    }
    bool has_subscribers() const override { return middleware_.subscribed; }
    std::uint32_t step_interval() const override {
      return address_ == "/env/World" ? 0 : std::uint32_t{middleware_.step_interval};
    }
    bool has_newcomers() const override { return !published_; }
    void publish(const state::Frame& frame, std::uint32_t slot) override {
      published_ = true;
      const std::int64_t until_ns = base::thread_cpu_ns() + std::int64_t{1000} * middleware_.publishing_us;
      while (base::thread_cpu_ns() < until_ns) {
      }
      const std::lock_guard<std::mutex> lock(middleware_.mutex_);
      EXPECT_GE(middleware_.open_.count(address_), 1u) << "published after closing";
      middleware_.records_[address_].steps.push_back(frame.sim_step);
      middleware_.records_[address_].slots.push_back(slot);
    }
    void watch(const state::Frame&, bool active) override {
      const std::lock_guard<std::mutex> lock(middleware_.mutex_);
      ++middleware_.records_[address_].watched;
      middleware_.records_[address_].last_active = active;
    }

   private:
    FakeMiddleware& middleware_;
    const std::string address_;
    bool published_ = false;
  };

  mutable std::mutex mutex_;
  std::set<std::string> reserved_;
  std::multiset<std::string> open_;  // one that leaves and its successor overlap
  std::map<std::string, Record> records_;
};

}  // namespace ambf::comm::testing
