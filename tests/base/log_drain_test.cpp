// Counting repetitions, and writing to streams that do not want to be written to.
#include "base/log_drain.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "base/detail/stream_sink.h"

namespace ambf::base {
namespace {

constexpr std::int64_t kSecond = 1000000000;

class Repeats : public ::testing::Test {
 protected:
  void say(const std::string& text, std::int64_t now) {
    filter.accept({Severity::warning, false, now, text}, now, emit);
  }
  RepeatFilter filter;
  std::vector<std::string> lines;
  RepeatFilter::Emit emit = [this](const LogLine& line) { lines.push_back(line.text); };
};

TEST_F(Repeats, AreCountedNotRepeated) {
  for (int i = 0; i <= 120; ++i) say("bad", i);
  EXPECT_EQ(lines, std::vector<std::string>{"bad"});
  EXPECT_EQ(filter.next_due_ns(), kSecond);
  filter.tick(kSecond - 1, emit);
  EXPECT_EQ(lines.size(), 1u);
  filter.tick(kSecond, emit);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[1], "bad (repeated 120 times)");
}

TEST_F(Repeats, OfDifferentMessagesAreKeptApart) {
  for (int i = 0; i < 10; ++i) {
    say("a", i);
    say("b", i);
  }
  filter.flush(emit);
  EXPECT_EQ(lines, (std::vector<std::string>{"a", "b", "a (repeated 9 times)", "b (repeated 9 times)"}));
}

TEST_F(Repeats, AreNewsAgainAfterSilence) {
  say("a", 0);
  say("a", 2 * kSecond);
  EXPECT_EQ(lines, (std::vector<std::string>{"a", "a"}));
}

TEST_F(Repeats, OfAnEndlessMessageBecomeRareAndNoneIsForgotten) {
  constexpr int kMessages = 600000;  // 1 kHz for ten minutes
  for (int i = 0; i < kMessages; ++i) say("nan", i * (kSecond / 1000));
  filter.flush(emit);
  EXPECT_LE(lines.size(), 20u);
  int total = 0;
  for (const std::string& line : lines) {
    const std::size_t at = line.find("repeated ");
    total += at == std::string::npos ? 1 : std::stoi(line.substr(at + 9));
  }
  EXPECT_EQ(total, kMessages);
}

TEST_F(Repeats, OfManyDifferentMessagesTakeBoundedMemoryAndLoseNoCount) {
  for (int i = 0; i < 500; ++i) {
    say("m" + std::to_string(i), i);
    say("m" + std::to_string(i), i);
  }
  filter.flush(emit);
  EXPECT_EQ(lines.size(), 1000u);
}

struct Pipe {
  Pipe() { EXPECT_EQ(::pipe2(ends, O_CLOEXEC), 0); }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  void close_end(int i) {
    if (ends[i] >= 0) ::close(ends[i]);
    ends[i] = -1;
  }
  std::string read_all() const {
    std::string text(1 << 20, '\0');
    const ssize_t n = ::read(ends[0], text.data(), text.size());
    text.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
    return text;
  }
  int ends[2];
};

TEST(LineWriter, DoesNotHangOnAReaderThatSleepsAndTellsWhatWasLost) {
  Pipe pipe;
  LineWriter writer(pipe.ends[1], false);
  const std::string line(1000, 'x');
  int written = 0;
  while (writer.write(line)) ASSERT_LT(++written, 100000);
  const std::int64_t begin = steady_ns();
  for (int i = 0; i < 9; ++i) EXPECT_FALSE(writer.write(line));
  EXPECT_LT(steady_ns() - begin, 5 * kSecond) << "waits once, not for every line";
  EXPECT_EQ(writer.lost(), 10u);
  pipe.read_all();
  EXPECT_TRUE(writer.write("after"));
  const std::string rest = pipe.read_all();
  EXPECT_NE(rest.find("(10 lines could not be written here)\nafter\n"), std::string::npos) << rest;
}

TEST(LineWriter, SurvivesAClosedPipe) {
  Pipe pipe;
  pipe.close_end(0);
  sigset_t pipe_signal, old;
  sigemptyset(&pipe_signal);
  sigaddset(&pipe_signal, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &pipe_signal, &old);  // as the drain's thread does
  LineWriter writer(pipe.ends[1], false);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(writer.write("into the void"));
  EXPECT_EQ(writer.lost(), 3u);
  timespec now{};
  sigtimedwait(&pipe_signal, nullptr, &now);
  pthread_sigmask(SIG_SETMASK, &old, nullptr);
}

TEST(LineWriter, SurvivesAFullDiskAndGoesOnAfterwards) {
  const int full = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
  ASSERT_GE(full, 0);
  LineWriter writer(full, true);
  EXPECT_FALSE(writer.write("a"));
  EXPECT_FALSE(writer.write("b"));
  EXPECT_EQ(writer.lost(), 2u);
}

TEST(StreamSink, WritesAFileAndSaysWhyItCannot) {
  std::string problem;
  make_stream_sink("/nonexistent-folder/x.log", &problem);
  EXPECT_NE(problem.find("/nonexistent-folder/x.log"), std::string::npos);

  char name[] = "/tmp/ambf_log_XXXXXX";
  const int descriptor = ::mkstemp(name);
  ASSERT_GE(descriptor, 0);
  const LogSink sink = make_stream_sink(name);
  sink({Severity::warning, steady_ns(), false, "late"});
  sink({Severity::error, steady_ns(), true, "a.yaml:1:1: error: bad"});
  std::string text(1000, '\0');
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, ::read(descriptor, text.data(), text.size()))));
  ::close(descriptor);
  ::unlink(name);
  EXPECT_NE(text.find("] warning: late\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\na.yaml:1:1: error: bad\n"), std::string::npos) << text;
}

TEST(StreamSink, APipeThatNobodyReadsIsAProblemNotAWait) {
  const std::string pipe = "/tmp/ambf_unread_pipe_" + std::to_string(getpid());
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::string problem;
  make_stream_sink(pipe, &problem);
  unlink(pipe.c_str());
  EXPECT_NE(problem.find("cannot write the log file"), std::string::npos) << problem;
}

}  // namespace
}  // namespace ambf::base
