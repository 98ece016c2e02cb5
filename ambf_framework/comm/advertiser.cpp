#include "comm/detail/advertiser.h"

#include <algorithm>

#include "base/realtime.h"

namespace ambf::comm {

namespace {
using namespace std::chrono_literals;
constexpr auto kRetryInterval = 100ms;  // also how soon a master that appears is noticed
}  // namespace

Advertiser::Advertiser(Middleware& middleware, int threads) : middleware_(middleware) {
  for (int i = 0; i < threads; ++i) {
    threads_.emplace_back([this] {
      base::set_thread_name("advertising");
      run();
    });
  }
}

Advertiser::~Advertiser() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Advertiser::open(const InstancePtr& instance) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (instance->is_world()) {
      to_open_.push_front(instance);
    } else {
      to_open_.push_back(instance);
    }
  }
  wake_.notify_one();
}

void Advertiser::close(const InstancePtr& instance) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    instance->gone = true;
    switch (instance->stage) {
      case Instance::Stage::waiting:
        to_open_.erase(std::remove(to_open_.begin(), to_open_.end(), instance), to_open_.end());
        instance->stage = Instance::Stage::closed;
        break;
      case Instance::Stage::open:
        instance->stage = Instance::Stage::closing;
        to_close_.push_back(instance);
        break;
      case Instance::Stage::opening:  // the thread that opens it checks `gone` afterwards
      case Instance::Stage::closing:
      case Instance::Stage::closed: break;
    }
  }
  wake_.notify_one();
}

bool Advertiser::may_open() const {
  return !to_open_.empty() && std::chrono::steady_clock::now() >= try_again_ && middleware_.available() &&
         (world_open_ || to_open_.front()->is_world());
}

bool Advertiser::may_close() const {
  return !to_close_.empty() && (!to_close_.front()->is_world() || (to_close_.size() == 1 && busy_ == 0));
}

void Advertiser::run() {
  Lock lock(mutex_);
  while (true) {
    if (to_close_.size() > 1 && to_close_.front()->is_world()) std::swap(to_close_.front(), to_close_.back());
    if (may_close()) {
      close_next(lock);
    } else if (stopping_ && to_close_.empty() && busy_ == 0) {
      return;
    } else if (!stopping_ && may_open()) {
      open_next(lock);
    } else {
      wake_.wait_for(lock, kRetryInterval);
    }
  }
}

void Advertiser::open_next(Lock& lock) {
  const InstancePtr instance = to_open_.front();
  to_open_.pop_front();
  instance->stage = Instance::Stage::opening;
  ++busy_;
  lock.unlock();
  std::unique_ptr<Endpoint> endpoint = instance->open(middleware_);
  lock.lock();
  --busy_;
  if (stopping_) wake_.notify_all();
  if (endpoint == nullptr) {
    try_again_ = std::chrono::steady_clock::now() + kRetryInterval;
    if (instance->gone) {
      instance->stage = Instance::Stage::closed;
      return;
    }
    instance->stage = Instance::Stage::waiting;
    if (instance->is_world()) {
      to_open_.push_front(instance);
    } else {
      to_open_.push_back(instance);
    }
    return;
  }
  instance->endpoint = std::move(endpoint);
  ++open_count_;
  if (instance->gone) {
    instance->stage = Instance::Stage::closing;
    to_close_.push_back(instance);
    return;
  }
  instance->stage = Instance::Stage::open;
  instance->ready.store(true, std::memory_order_release);
  if (instance->is_world()) {
    world_open_ = true;
    wake_.notify_all();
  }
}

void Advertiser::close_next(Lock& lock) {
  const InstancePtr instance = to_close_.front();
  to_close_.pop_front();
  if (instance->is_world()) world_open_ = false;
  ++busy_;
  lock.unlock();
  instance->ready.store(false);
  instance->endpoint.reset();
  lock.lock();
  --busy_;
  instance->stage = Instance::Stage::closed;
  --open_count_;
  wake_.notify_all();  // the world may be next
}

}  // namespace ambf::comm
