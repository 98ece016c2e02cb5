#include "ros_comm/images/image_desk.h"

#include <algorithm>
#include <utility>

#include "base/realtime.h"

namespace ambf::ros_comm {

namespace {

constexpr int kNice = 5;  // below states and commands, above drawing

std::uint64_t key_of(state::ObjectId id) { return (std::uint64_t{id.generation} << 32) | id.index; }

}  // namespace

ImageDesk::ImageDesk(Node& node, JpegEncoder encode) : node_(node), encode_(std::move(encode)) {}

ImageDesk::~ImageDesk() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

ImageDesk::Place::Place(ImageDesk& desk, const state::ObjectInfo& object, const std::string& topic,
                        const state::CameraInfo& camera)
    : desk_(desk), key_(key_of(object.id)) {
  auto topics = std::make_shared<ImageTopics>(desk.node_, topic, object.local_name, camera, desk.encode_);
  const std::lock_guard<std::mutex> lock(desk.mutex_);
  desk.cameras_[key_] = std::move(topics);
  if (!desk.thread_.joinable()) desk.thread_ = std::thread([&desk] { desk.run(); });
  if (desk.when_needed_) desk.when_needed_();
}

ImageDesk::Place::~Place() {
  std::shared_ptr<ImageTopics> topics;  // closed after the lock is let go
  std::unique_lock<std::mutex> lock(desk_.mutex_);
  const auto at = desk_.cameras_.find(key_);
  topics = std::move(at->second);
  desk_.cameras_.erase(at);
  desk_.idle_.wait(lock, [&] { return desk_.busy_ != topics.get(); });
  lock.unlock();
}

state::PictureWishes ImageDesk::wishes(state::ObjectId camera) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto at = cameras_.find(key_of(camera));
  return at == cameras_.end() ? state::PictureWishes{} : at->second->wishes();
}

void ImageDesk::post(state::Picture picture) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto older = std::find_if(waiting_.begin(), waiting_.end(), [&](const state::Picture& other) {
    return other.camera == picture.camera && other.kind == picture.kind && other.eye == picture.eye;
  });
  if (older != waiting_.end()) {
    waiting_.erase(older);
    node_.traffic().pictures_dropped.fetch_add(1, std::memory_order_relaxed);
  }
  waiting_.push_back(std::move(picture));
  wake_.notify_one();
}

void ImageDesk::when_needed(const std::function<void()>& start) {
  const std::lock_guard<std::mutex> lock(mutex_);
  when_needed_ = start;
  if (when_needed_ && !cameras_.empty()) when_needed_();
}

void ImageDesk::run() {
  base::set_thread_name("images");
  base::lower_priority(kNice);
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stop_ || !waiting_.empty(); });
    if (stop_) return;
    const state::Picture picture = std::move(waiting_.front());
    waiting_.pop_front();
    const auto at = cameras_.find(key_of(picture.camera));
    if (at == cameras_.end()) continue;  // the camera is gone
    ImageTopics* topics = at->second.get();
    busy_ = topics;
    lock.unlock();
    topics->publish(picture);
    lock.lock();
    busy_ = nullptr;
    idle_.notify_all();
  }
}

}  // namespace ambf::ros_comm
