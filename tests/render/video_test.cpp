// Videos by ffmpeg: the real one where it is installed, and ones that fail in every way.
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "no_ffmpeg.h"
#include "render/pictures/video_writer.h"

namespace ambf::render {
namespace {

using testing::NoFfmpeg;

constexpr int kWidth = 101, kHeight = 64;  // encoders want even sizes: it is padded

class Video : public ::testing::Test {
 protected:
  ~Video() override { std::filesystem::remove(file); }

  static std::vector<std::uint8_t> picture(int shade) {
    return std::vector<std::uint8_t>(std::size_t{3} * kWidth * kHeight, static_cast<std::uint8_t>(shade));
  }
  // True when all was written; false with the reason.
  bool film(int pictures, double patience_s) {
    const auto writer = VideoWriter::open(file, kWidth, kHeight, 25, why, patience_s);
    if (writer == nullptr) return false;
    for (int i = 0; i < pictures; ++i) {
      if (!writer->add(picture(i % 250), why)) return false;
    }
    return writer->finish(why);
  }

  const std::string file =
      (std::filesystem::temp_directory_path() / ("ambf_video" + std::to_string(getpid()) + ".mp4")).string();
  std::string why;
};

double seconds_of(const std::function<void()>& act) {
  const auto begin = std::chrono::steady_clock::now();
  act();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

TEST_F(Video, OfTheRealFfmpegHasItsSizeRateAndPictures) {
  if (access("/usr/bin/ffmpeg", X_OK) != 0 || access("/usr/bin/ffprobe", X_OK) != 0) {
    GTEST_SKIP() << "ffmpeg is not installed: videos are checked with stand-ins only";
  }
  ASSERT_TRUE(film(50, VideoWriter::kPatience_s)) << why;
  const std::string ask =
      "/usr/bin/ffprobe -v error -count_frames -select_streams v -of csv=p=0 "
      "-show_entries stream=width,height,r_frame_rate,nb_read_frames " +
      file;
  FILE* pipe = popen(ask.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::array<char, 200> line{};
  ASSERT_NE(fgets(line.data(), static_cast<int>(line.size()), pipe), nullptr);
  EXPECT_EQ(pclose(pipe), 0);
  EXPECT_EQ(std::string(line.data()), "102,64,25/1,50\n");
}

TEST_F(Video, OfAnFfmpegThatIsKilledInTheMiddleIsAnError) {
  const NoFfmpeg fake("/usr/bin/head -c 60000 > /dev/null; kill -9 $$");
  EXPECT_FALSE(film(1000, 20.0));
  EXPECT_NE(why.find("ffmpeg takes no more pictures"), std::string::npos) << why;
}

TEST_F(Video, OfAnFfmpegThatStopsReadingIsAnErrorAndNoWaitWithoutEnd) {
  const NoFfmpeg fake("/usr/bin/head -c 60000 > /dev/null; exec /bin/sleep 100");
  const double took = seconds_of([&] { EXPECT_FALSE(film(1000, 0.4)); });
  EXPECT_LT(took, 50.0);
  EXPECT_NE(why.find("no picture for a while"), std::string::npos) << why;
}

TEST_F(Video, OfAnFfmpegThatDoesNotEndIsAnErrorAndNoWaitWithoutEnd) {
  const NoFfmpeg fake("/bin/cat > /dev/null; exec /bin/sleep 100");
  const double took = seconds_of([&] { EXPECT_FALSE(film(3, 0.4)); });
  EXPECT_LT(took, 50.0);
  EXPECT_NE(why.find("does not complete"), std::string::npos) << why;
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "no child is left";
}

TEST_F(Video, OfAnFfmpegThatRefusesIsAnError) {
  const NoFfmpeg fake("exit 3");
  EXPECT_FALSE(film(100, 20.0));
  EXPECT_NE(why.find("ffmpeg"), std::string::npos) << why;
}

TEST_F(Video, IntoAFolderThatIsNotThereIsAnError) {
  EXPECT_EQ(VideoWriter::open("/no/such/folder/a.mp4", 8, 8, 25, why), nullptr);
  EXPECT_NE(why.find("/no/such/folder"), std::string::npos) << why;
}

}  // namespace
}  // namespace ambf::render
