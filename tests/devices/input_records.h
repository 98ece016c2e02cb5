// FIFOs that stand in for nodes of Linux's input layer, in a folder of their own that ends with this object.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/input.h>
#include <linux/joystick.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace ambf::devices {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "ambf_devices_XXXXXX").string();
    if (mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

class Fifo {
 public:
  explicit Fifo(std::string path) : path_(std::move(path)) { EXPECT_EQ(mkfifo(path_.c_str(), 0600), 0); }
  ~Fifo() { unplug(); }
  const std::string& path() const { return path_; }
  // After its reader has opened it.
  void plug() { fd_ = open(path_.c_str(), O_WRONLY | O_NONBLOCK); }
  void unplug() {
    if (fd_ >= 0) close(fd_);
    fd_ = -1;
  }
  void send(const void* bytes, std::size_t size) {
    EXPECT_EQ(::write(fd_, bytes, size), static_cast<ssize_t>(size)) << "nobody reads " << path_;
  }
  void send_joydev(int type, int number, int value) {
    const js_event event{0, static_cast<std::int16_t>(value), static_cast<std::uint8_t>(type),
                         static_cast<std::uint8_t>(number)};
    send(&event, sizeof(event));
  }
  void send_evdev(int type, int code, int value) {
    input_event event{};
    event.type = static_cast<std::uint16_t>(type);
    event.code = static_cast<std::uint16_t>(code);
    event.value = value;
    send(&event, sizeof(event));
  }
  void report() { send_evdev(EV_SYN, SYN_REPORT, 0); }

 private:
  std::string path_;
  int fd_ = -1;
};

}  // namespace ambf::devices
