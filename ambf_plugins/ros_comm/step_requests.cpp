#include "ros_comm/step_requests.h"

#include <algorithm>
#include <numeric>
#include <thread>

namespace ambf::ros_comm {

namespace {
constexpr std::size_t kMaxUnreceived = 4096;  // stamps that are remembered: seconds of real time
}

StepRequests::Interval StepRequests::interval_of(const std::string& topic) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (auto it = topics_.begin(); it != topics_.end();) it = it->second.expired() ? topics_.erase(it) : std::next(it);
  auto interval = std::make_shared<std::atomic<std::uint32_t>>(0);
  topics_[topic] = interval;
  return interval;
}

std::string StepRequests::request(const std::string& recorder, const std::vector<std::string>& topics,
                                  std::uint32_t interval, std::int64_t now_ns, std::vector<std::string>& served) {
  const std::lock_guard<std::mutex> lock(mutex_);
  served.clear();
  if (interval == 0) {
    requests_.erase(recorder);
  } else {
    if (requests_.size() >= kMaxRecorders && requests_.count(recorder) == 0) {
      return "there are " + std::to_string(kMaxRecorders) + " recorders already";
    }
    for (const std::string& topic : topics) {
      const auto found = topics_.find(topic);
      if (found != topics_.end() && !found->second.expired()) served.push_back(topic);
    }
    Request& request = requests_[recorder];
    request.topics = served;
    request.interval = interval;
    request.ends_ns = now_ns + kLease_ns;
  }
  renew_intervals();
  ++changes_;
  return "";
}

void StepRequests::renew_intervals() {
  std::map<std::string, std::uint32_t> intervals;
  std::int64_t next_end_ns = 0;
  for (const auto& [recorder, request] : requests_) {
    next_end_ns = next_end_ns == 0 ? request.ends_ns : std::min(next_end_ns, request.ends_ns);
    for (const std::string& topic : request.topics) {
      // Of several recorders each gets its own steps, and those of the others.
      std::uint32_t& interval = intervals[topic];
      interval = std::gcd(interval, request.interval);
    }
  }
  for (const auto& [topic, cell] : topics_) {
    const auto wanted = intervals.find(topic);
    if (const auto interval = cell.lock()) *interval = wanted == intervals.end() ? 0 : wanted->second;
  }
  next_end_ns_ = next_end_ns;
  receipts_ = std::any_of(requests_.begin(), requests_.end(), [](const auto& entry) { return entry.second.receipts; });
}

bool StepRequests::receipt(const std::string& recorder, std::int64_t stamp_ns) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = requests_.find(recorder);
  if (found == requests_.end()) return false;
  found->second.receipts = receipts_ = true;
  // Found by equality, not by order: the system clock may be put back.
  std::deque<std::int64_t>& unreceived = found->second.unreceived;
  const auto newest = std::find(unreceived.begin(), unreceived.end(), stamp_ns);
  if (newest != unreceived.end()) unreceived.erase(unreceived.begin(), std::next(newest));
  return true;
}

void StepRequests::published(std::int64_t stamp_ns) {
  if (!receipts_) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  for (auto& [recorder, request] : requests_) {
    if (!request.receipts) continue;
    request.unreceived.push_back(stamp_ns);
    if (request.unreceived.size() > kMaxUnreceived) request.unreceived.pop_front();  // in real time nothing waits
  }
}

bool StepRequests::room() {
  if (!receipts_) return true;
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::all_of(requests_.begin(), requests_.end(),
                     [](const auto& entry) { return entry.second.unreceived.size() < kMaxAhead; });
}

bool StepRequests::wait_until_in_force(std::chrono::milliseconds timeout) {
  const std::uint64_t change = changes_;
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (acted_on_ < change) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

bool StepRequests::in_force(std::int64_t now_ns) {
  acted_on_ = seen_;
  seen_ = changes_;
  const std::int64_t end_ns = next_end_ns_;
  if (end_ns == 0 || now_ns < end_ns) return end_ns != 0;
  const std::lock_guard<std::mutex> lock(mutex_);
  for (auto it = requests_.begin(); it != requests_.end();) {
    it = it->second.ends_ns <= now_ns ? requests_.erase(it) : std::next(it);
  }
  renew_intervals();
  return next_end_ns_ != 0;
}

}  // namespace ambf::ros_comm
