#include "render/pictures/video_writer.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "base/clock.h"
#include "base/realtime.h"
#include "base/spawn.h"
#include "render/pictures/offscreen.h"

namespace ambf::render {

namespace fs = std::filesystem;

namespace {

// A closed pipe is an error to report, not a signal to die of.
class NoPipeSignal {
 public:
  NoPipeSignal() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~NoPipeSignal() {
    const timespec now{};
    if (sigismember(&before_, SIGPIPE) == 0) sigtimedwait(&pipe_, nullptr, &now);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoPipeSignal(const NoPipeSignal&) = delete;
  NoPipeSignal& operator=(const NoPipeSignal&) = delete;

 private:
  sigset_t pipe_{}, before_{};
};

class Ffmpeg final : public VideoWriter {
 public:
  Ffmpeg(std::string file, std::size_t bytes, double patience_s)
      : file_(std::move(file)), bytes_(bytes), patience_s_(patience_s) {}
  ~Ffmpeg() override {
    std::string ignored;
    finish(ignored);
  }

  bool start(const std::string& program, int width, int height, int rate, std::string& why) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) {
      why = std::strerror(errno);
      return false;
    }
    const std::string size = std::to_string(width) + "x" + std::to_string(height), fps = std::to_string(rate);
    // Half as many colours as pixels a side is what players expect, and needs even sizes.
    const std::vector<std::string> words = {
        program,    "-hide_banner", "-loglevel", "error",       "-y",  "-f",
        "rawvideo", "-pix_fmt",     "rgb24",     "-video_size", size,  "-framerate",
        fps,        "-i",           "pipe:0",    "-an",         "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2",
        "-pix_fmt", "yuv420p",      file_};
    base::Streams streams;  // Ctrl-C is for us: it ends when its input does
    streams.input = ends[0];
    streams.output = streams.errors = base::kAsOurs;
    process_ = base::spawn(words, streams, why);
    close(ends[0]);
    input_ = ends[1];
    fcntl(input_, F_SETFL, O_NONBLOCK);
    return process_ > 0;
  }

  bool add(const std::vector<std::uint8_t>& rgb, std::string& why) override {
    const NoPipeSignal quiet;
    if (rgb.size() != bytes_ || input_ < 0) {
      why = "pictures of a video must all be of its size";
      return false;
    }
    for (std::size_t done = 0; done < rgb.size();) {
      const ssize_t count = write(input_, rgb.data() + done, rgb.size() - done);
      if (count >= 0) {
        done += static_cast<std::size_t>(count);
        continue;
      }
      if (errno == EINTR) continue;
      if (errno == EAGAIN && takes_more()) continue;
      why = errno == EAGAIN ? "ffmpeg has taken no picture for a while" : "ffmpeg takes no more pictures";
      if (errno == EAGAIN) kill(process_, SIGKILL);
      std::string ignored;
      finish(ignored);
      return false;
    }
    return true;
  }

  bool finish(std::string& why) override {
    if (input_ >= 0) close(input_);
    input_ = -1;
    if (process_ <= 0) return good_;
    int status = 0;
    bool late = false;
    const std::int64_t until_ns = base::steady_ns() + static_cast<std::int64_t>(1e9 * patience_s_);
    for (;;) {
      const pid_t ended = waitpid(process_, &status, late ? 0 : WNOHANG);
      if (ended == process_ || (ended < 0 && errno != EINTR)) break;
      if (base::steady_ns() > until_ns && !late) {
        late = true;
        kill(process_, SIGKILL);
      }
      base::sleep_until(base::steady_ns() + kLook_ns);
    }
    process_ = -1;
    good_ = !late && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (!good_) why = late ? "ffmpeg does not complete " + file_ : "ffmpeg did not write " + file_;
    return good_;
  }

  const std::string& place() const override { return file_; }

 private:
  static constexpr std::int64_t kLook_ns = 5'000'000;

  // Leaves errno at EAGAIN when it does not.
  bool takes_more() const {
    pollfd pipe{input_, POLLOUT, 0};
    const int ready = poll(&pipe, 1, static_cast<int>(1e3 * patience_s_));
    const bool more = ready > 0 || (ready < 0 && errno == EINTR);
    errno = EAGAIN;
    return more;
  }

  const std::string file_;
  const std::size_t bytes_;
  const double patience_s_;
  pid_t process_ = -1;
  int input_ = -1;
  bool good_ = false;
};

class NumberedFiles final : public VideoWriter {
 public:
  NumberedFiles(std::string folder, int width, int height)
      : folder_(std::move(folder)), width_(width), height_(height) {}

  bool start(std::string& why) const {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) why = folder_ + ": " + error.message();
    return !error;
  }

  bool add(const std::vector<std::uint8_t>& rgb, std::string& why) override {
    char name[32];
    std::snprintf(name, sizeof name, "/%06u.png", ++count_);
    return write_png(folder_ + name, image_of(rgb, width_, height_), why);
  }
  bool finish(std::string&) override { return true; }
  const std::string& place() const override { return folder_; }

 private:
  const std::string folder_;
  const int width_, height_;
  unsigned count_ = 0;
};

}  // namespace

std::unique_ptr<VideoWriter> VideoWriter::open(const std::string& file, int width, int height, int frames_per_second,
                                               std::string& why, double patience_s) {
  const fs::path folder = fs::path(file).parent_path();
  if (std::error_code ignored; !folder.empty() && !fs::is_directory(folder, ignored)) {
    why = "there is no folder " + folder.string();
    return nullptr;
  }
  const std::string program = base::find_program("ffmpeg");
  if (program.empty()) {
    const fs::path path(file);
    auto files = std::make_unique<NumberedFiles>((path.parent_path() / path.stem()).string(), width, height);
    if (!files->start(why)) return nullptr;
    return files;
  }
  const std::size_t bytes = std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  auto ffmpeg = std::make_unique<Ffmpeg>(file, bytes, patience_s);
  if (!ffmpeg->start(program, width, height, frames_per_second, why)) return nullptr;
  return ffmpeg;
}

}  // namespace ambf::render
