// Pictures to a video file: by ffmpeg when that is installed, else as numbered PNGs in a folder beside it. An ffmpeg
// that fails, is killed or stops taking pictures is an error, never a wait without end. One thread at a time, never
// the physics thread.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ambf::render {

class VideoWriter {
 public:
  static constexpr double kPatience_s = 30.0;

  virtual ~VideoWriter() = default;
  // Null with the reason in `why`. `file` is overwritten. `patience_s`: how long ffmpeg may do nothing, and take to
  // complete its file.
  static std::unique_ptr<VideoWriter> open(const std::string& file, int width, int height, int frames_per_second,
                                           std::string& why, double patience_s = kPatience_s);

  // 8 bits a channel, rows from top to bottom. False with the reason in `why`.
  virtual bool add(const std::vector<std::uint8_t>& rgb, std::string& why) = 0;
  // Completes the file; says where the pictures are.
  virtual bool finish(std::string& why) = 0;
  virtual const std::string& place() const = 0;  // the file or the folder
};

}  // namespace ambf::render
