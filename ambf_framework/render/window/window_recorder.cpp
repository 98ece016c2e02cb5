#include "render/window/window_recorder.h"

#include <atomic>
#include <cmath>
#include <condition_variable>
#include <ctime>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>

#include "base/realtime.h"
#include "render/images/image_file.h"
#include "render/pictures/offscreen.h"
#include "render/pictures/video_writer.h"

namespace ambf::render {

namespace {

// Pictures that wait for the encoder. Where it is slower than the film, the next ones are left out and made up for.
constexpr std::size_t kMaxWaiting = 8;
// Simulated time that went back or jumped (a reset, a snapshot) is no reason to film a minute of standstill.
constexpr double kLongestGap_s = 2.0;

}  // namespace

std::string dated_file(const std::string& folder, const std::string& ending) {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  localtime_r(&now, &parts);
  char date[40];
  std::strftime(date, sizeof date, "ambf_%Y-%m-%d_%H-%M-%S", &parts);
  const std::string begin = (std::filesystem::path(folder) / date).string();
  std::error_code ignored;
  for (unsigned i = 1;; ++i) {
    const std::string stem = i == 1 ? begin : begin + "_" + std::to_string(i);
    // A film without ffmpeg is a folder of that name.
    if (!std::filesystem::exists(stem + ending, ignored) && !std::filesystem::exists(stem, ignored))
      return stem + ending;
  }
}

// Does jobs one after the other on a thread of its own, all of them before it ends.
class WindowRecorder::Writer {
 public:
  Writer() : thread_([this] { run(); }) {}
  ~Writer() {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    changed_.notify_one();
    thread_.join();
  }
  void add(std::function<void()> job) {
    {
      const std::lock_guard lock(mutex_);
      jobs_.push_back(std::move(job));
    }
    changed_.notify_one();
  }
  std::size_t waiting() const {
    const std::lock_guard lock(mutex_);
    return jobs_.size();
  }

 private:
  void run() {
    base::set_thread_name("pictures");
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return ending_ || !jobs_.empty(); });
      if (jobs_.empty()) return;
      const std::function<void()> job = std::move(jobs_.front());
      jobs_.pop_front();
      lock.unlock();
      job();
      lock.lock();
    }
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;
  bool ending_ = false;
  std::thread thread_;
};

struct WindowRecorder::Film {
  std::string file;
  int width = 0, height = 0;  // 0: no picture yet
  double begin_s = 0.0;       // simulated time of picture 0
  double last_s = 0.0;        // of the last picture taken
  std::int64_t next = 0;      // number of the first picture that is missing
  // Only the writer's thread's:
  struct File {
    std::unique_ptr<VideoWriter> writer;
    std::vector<std::uint8_t> last;
    std::atomic<bool> failed{false};
  };
  std::shared_ptr<File> output = std::make_shared<File>();

  std::int64_t number_at(double sim_time) const {
    return static_cast<std::int64_t>(std::floor((sim_time - begin_s) * kFilmRate + 1e-6));
  }
};

WindowRecorder::WindowRecorder(base::Log& log, std::shared_ptr<Messages> messages)
    : log_(log), messages_(std::move(messages)) {}

WindowRecorder::~WindowRecorder() { stop_film(); }

void WindowRecorder::take_screenshot(const std::string& folder) { screenshots_.push_back(folder); }

void WindowRecorder::start_film(const std::string& folder) {
  if (filming()) return;
  film_ = std::make_unique<Film>();
  film_->file = dated_file(folder, ".mp4");
}

bool WindowRecorder::filming() const { return film_ != nullptr && !film_->output->failed; }

double WindowRecorder::film_s() const { return film_ == nullptr ? 0.0 : static_cast<double>(film_->next) / kFilmRate; }

void WindowRecorder::stop_film() { end_film(""); }

void WindowRecorder::end_film(const std::string& why) {
  if (film_ == nullptr) return;
  if (film_->width == 0) {
    messages_->add("no film: nothing was drawn");
  } else {
    writer_->add(
        [output = film_->output, count = film_->next, file = film_->file, why, &log = log_, messages = messages_] {
          std::string failure;
          if (output->failed) return;  // was reported
          if (output->writer == nullptr || !output->writer->finish(failure)) {
            log.error("no film: %s", failure.c_str());
            messages->add("no film: " + failure);
            return;
          }
          const std::string& place = output->writer->place();
          log.info("%s: %lld pictures, %d a second%s", place.c_str(), static_cast<long long>(count), kFilmRate,
                   place == file ? "" : ", numbered since ffmpeg is not installed");
          messages->add("film: " + place + why);
        });
  }
  film_.reset();
}

bool WindowRecorder::wants(double sim_time) const {
  if (!screenshots_.empty()) return true;
  if (!filming()) return false;
  if (film_->width == 0) return true;
  const bool due = film_->number_at(sim_time) >= film_->next || sim_time < film_->last_s;
  return due && writer_->waiting() < kMaxWaiting;
}

void WindowRecorder::take(WindowPicture taken, double sim_time) {
  if (taken.width <= 0 || taken.height <= 0) return;
  if (writer_ == nullptr) writer_ = std::make_unique<Writer>();
  const auto picture = std::make_shared<const WindowPicture>(std::move(taken));
  for (const std::string& folder : screenshots_) {
    writer_->add([picture, folder, &log = log_, messages = messages_] {
      const std::string file = dated_file(folder, ".png");
      std::string why;
      if (write_png(file, image_of(picture->rgb, picture->width, picture->height), why)) {
        log.info("%s: %d x %d", file.c_str(), picture->width, picture->height);
        messages->add("screenshot: " + file);
      } else {
        log.error("no screenshot: %s: %s", file.c_str(), why.c_str());
        messages->add("no screenshot: " + file + ": " + why);
      }
    });
  }
  screenshots_.clear();
  if (!filming()) return;

  Film& film = *film_;
  if (film.width == 0) {
    film.width = picture->width;
    film.height = picture->height;
    film.begin_s = film.last_s = sim_time;
    writer_->add([output = film.output, picture, file = film.file, &log = log_, messages = messages_] {
      std::string why;
      output->writer = VideoWriter::open(file, picture->width, picture->height, kFilmRate, why);
      if (output->writer != nullptr) return;
      output->failed = true;
      log.error("no film: %s: %s", file.c_str(), why.c_str());
      messages->add("no film: " + file + ": " + why);
    });
  }
  if (picture->width != film.width || picture->height != film.height) {
    return end_film(" (it ends where the window changed its size)");
  }
  std::int64_t number = film.number_at(sim_time);
  if (sim_time < film.last_s || sim_time > film.last_s + kLongestGap_s) {
    film.begin_s = sim_time - static_cast<double>(film.next) / kFilmRate;
    number = film.next;
  }
  film.last_s = sim_time;
  if (number < film.next) return;
  const std::int64_t missing = number - film.next;
  film.next = number + 1;
  writer_->add([output = film.output, picture, missing, file = film.file, &log = log_, messages = messages_] {
    if (output->failed || output->writer == nullptr) return;
    std::string why;
    bool good = true;
    for (std::int64_t i = 0; good && i < missing; ++i) good = output->writer->add(output->last, why);
    good = good && output->writer->add(picture->rgb, why);
    output->last = picture->rgb;
    if (good) return;
    output->failed = true;
    log.error("the film ends: %s: %s", file.c_str(), why.c_str());
    messages->add("the film ends: " + file + ": " + why);
  });
}

}  // namespace ambf::render
