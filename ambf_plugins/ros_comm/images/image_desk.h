// Receives pictures from the renderer and publishes them on a thread of its own, so that converting, compressing and
// sending them delays neither drawing nor any other topic. Of each camera's pictures of one kind the newest waits; an
// older one that is still there then is dropped and counted. Private to ros_comm. C++17.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "ros_comm/images/image_topics.h"

namespace ambf::ros_comm {

class ImageDesk final : public state::PictureSink {
 public:
  ImageDesk(Node& node, JpegEncoder encode);
  ~ImageDesk() override;
  ImageDesk(const ImageDesk&) = delete;
  ImageDesk& operator=(const ImageDesk&) = delete;

  // A camera's topics, for as long as this lives. Throws when ROS does not accept one.
  class Place {
   public:
    Place(ImageDesk& desk, const state::ObjectInfo& object, const std::string& topic, const state::CameraInfo& camera);
    ~Place();  // returns when nothing of it is being published any more
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

   private:
    ImageDesk& desk_;
    const std::uint64_t key_;
  };

  state::PictureWishes wishes(state::ObjectId camera) const override;
  void post(state::Picture picture) override;
  void when_needed(const std::function<void()>& start) override;

 private:
  void run();

  Node& node_;
  const JpegEncoder encode_;
  mutable std::mutex mutex_;
  std::condition_variable wake_, idle_;
  std::map<std::uint64_t, std::shared_ptr<ImageTopics>> cameras_;  // guarded, as are the next three
  std::deque<state::Picture> waiting_;
  const ImageTopics* busy_ = nullptr;
  bool stop_ = false;
  std::function<void()> when_needed_;  // guarded, as is the next
  std::thread thread_;                 // started with the first camera
};

}  // namespace ambf::ros_comm
