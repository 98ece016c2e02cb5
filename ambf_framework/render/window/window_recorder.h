// Screenshots and films of what a window shows, without panel and labels. Files are named by date and written by a
// thread of its own, so that neither drawing nor physics waits for disks and encoders; what could not be written is
// shown to the user and logged. Films run in simulated time at a fixed rate: pictures that the window did not draw are
// made up for by the one before. Main thread.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/log.h"
#include "render/window/messages.h"

namespace ambf::render {

// 8 bits a channel, red green blue, rows from top to bottom.
struct WindowPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

class WindowRecorder {
 public:
  static constexpr int kFilmRate = 30;  // pictures a simulated second

  WindowRecorder(base::Log& log, std::shared_ptr<Messages> messages);
  ~WindowRecorder();  // completes what is under way
  WindowRecorder(const WindowRecorder&) = delete;
  WindowRecorder& operator=(const WindowRecorder&) = delete;

  // Of the next picture. An empty folder is the one where the program was started.
  void take_screenshot(const std::string& folder);
  void start_film(const std::string& folder);  // with the next picture
  void stop_film();
  bool filming() const;   // false also once it has failed
  double film_s() const;  // how long it is by now

  // --- The window: is this picture needed, and here it is.
  bool wants(double sim_time) const;
  void take(WindowPicture picture, double sim_time);

 private:
  struct Film;
  class Writer;

  void end_film(const std::string& why);

  base::Log& log_;
  const std::shared_ptr<Messages> messages_;
  std::vector<std::string> screenshots_;  // folders
  std::unique_ptr<Film> film_;
  std::unique_ptr<Writer> writer_;  // made when first needed
};

// "FOLDER/ambf_2026-11-21_19-04-00.ENDING", with "_2" and so on behind the time when that exists already.
std::string dated_file(const std::string& folder, const std::string& ending);

}  // namespace ambf::render
