// Pictures to a video file: by ffmpeg when that is installed, else as numbered PNGs in a folder beside it. One thread.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ambf::simulator {

class VideoWriter {
 public:
  virtual ~VideoWriter() = default;
  // Null with the reason in `why`. `file` is overwritten.
  static std::unique_ptr<VideoWriter> open(const std::string& file, int width, int height, int frames_per_second,
                                           std::string& why);

  // 8 bits a channel, rows from top to bottom. False with the reason in `why`.
  virtual bool add(const std::vector<std::uint8_t>& rgb, std::string& why) = 0;
  // Completes the file; says where the pictures are.
  virtual bool finish(std::string& why) = 0;
  virtual const std::string& place() const = 0;  // the file or the folder
};

}  // namespace ambf::simulator
