// Recordings of inputs: what goes in comes out, and damage ends a recording without harm.
#include "inputs/recording.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "inputs/device_records.h"
#include "inputs/physics_records.h"
#include "tests/support/judged_log.h"

namespace ambf::inputs {
namespace {

class Recordings : public testing::Test {
 protected:
  const std::string path_ = testing::TempDir() + "ambf_inputs_" + std::to_string(getpid());
  JudgedLog log_;
  std::string problem_;

  ~Recordings() override { std::filesystem::remove(path_); }

  std::unique_ptr<Recorder> create() {
    SessionRecord session;
    session.launch_file = "/scenes/launch.yaml";
    session.model_files = {"a.yaml", ""};
    session.device_text = "input devices: [A]\n";
    session.speed_factor = 0.5;
    return Recorder::create(path_, session, log_, problem_);
  }
  // A session, two streams, `cycles` cycles of a device.
  void record(std::uint64_t cycles = 3) {
    const auto recorder = create();
    ASSERT_NE(recorder, nullptr) << problem_;
    Channel& physics = recorder->make_channel(kPhysicsStream);
    Channel& device = recorder->make_channel(kFirstDeviceStream);
    CommandRecord command{{7, 2}, state::Source::step_service, 99, 100, state::RigidBodyCommand{}};
    std::get<state::RigidBodyCommand>(command.command).joints = {{state::JointCommandType::position, 0.25}};
    physics.add(command);
    physics.add(IterationRecord{0.125, 4, true});
    for (std::uint64_t i = 1; i <= cycles; ++i) {
      CycleRecord cycle;
      cycle.cycle = i;
      cycle.now_ns = static_cast<std::int64_t>(i) * 1'000'000;
      cycle.reading = CycleRecord::Reading::sample;
      cycle.sample.emplace().T_u_tip.position = {0.1, 0.2, std::nextafter(0.3, 1.0)};
      cycle.settings = {{state::DeviceParameter::dominance, {0.75, 0.0, 0.0}}};
      if (i % 2 == 0) cycle.set_point.emplace().jaw = 0.5;
      device.add(cycle);
    }
  }
  std::string bytes() const {
    std::stringstream text;
    text << std::ifstream(path_, std::ios::binary).rdbuf();
    return text.str();
  }
  std::unique_ptr<Recording> read(std::string bytes) {
    return Recording::read(std::make_unique<std::istringstream>(std::move(bytes)), problem_);
  }
  static std::uint64_t count(Recording& recording, Stream stream) {
    std::uint64_t records = 0;
    while (recording.next(stream) != nullptr) ++records;
    return records;
  }
};

TEST_F(Recordings, EachStreamComesBackInItsOrder) {
  record();
  const auto recording = Recording::open(path_, problem_);
  ASSERT_NE(recording, nullptr) << problem_;
  EXPECT_EQ(recording->session().launch_file, "/scenes/launch.yaml");
  EXPECT_EQ(recording->session().model_files, (std::vector<std::string>{"a.yaml", ""}));
  EXPECT_EQ(recording->session().speed_factor, 0.5);
  for (std::uint64_t i = 1; i <= 3; ++i) {
    const RawRecord* raw = recording->next(kFirstDeviceStream);
    ASSERT_NE(raw, nullptr);
    const auto cycle = raw->as<CycleRecord>();
    ASSERT_TRUE(cycle);
    EXPECT_EQ(cycle->cycle, i);
    EXPECT_EQ(cycle->sample->T_u_tip.position.z, std::nextafter(0.3, 1.0)) << "to the bit";
    EXPECT_EQ(cycle->settings.at(0).value.x, 0.75);
    EXPECT_EQ(cycle->set_point.has_value(), i == 2);
  }
  EXPECT_EQ(recording->next(kFirstDeviceStream), nullptr);
  const auto command = recording->peek(kPhysicsStream)->as<CommandRecord>();
  ASSERT_TRUE(command);
  EXPECT_EQ(command->object, (state::ObjectId{7, 2}));
  EXPECT_EQ(std::get<state::RigidBodyCommand>(command->command).joints.at(0).value, 0.25);
  EXPECT_FALSE(recording->next(kPhysicsStream)->as<IterationRecord>()) << "it is another type";
  const auto iteration = recording->next(kPhysicsStream)->as<IterationRecord>();
  ASSERT_TRUE(iteration);
  EXPECT_EQ(iteration->steps, 4u);
  EXPECT_TRUE(recording->ended_properly());
  EXPECT_EQ(recording->ignored_bytes(), 0u);
  EXPECT_FALSE(recording->gap());
}

TEST_F(Recordings, ALensComesBackWhole) {
  state::Lens lens;
  lens.field_of_view_rad = 0.9;
  lens.optics = {1.2, 0.1, -0.05, 0.04};
  create()->make_channel(kPhysicsStream).add(LensRecord{{3, 1}, lens});
  const auto recording = Recording::open(path_, problem_);
  ASSERT_NE(recording, nullptr) << problem_;
  const auto did = recording->next(kPhysicsStream)->as<LensRecord>();
  ASSERT_TRUE(did);
  EXPECT_EQ(did->lens, lens);
}

TEST_F(Recordings, WhatWasTornOffIsIgnoredAndCounted) {
  record();
  const std::string whole = bytes();
  std::uint64_t longest = 0;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const auto recording = read(whole.substr(0, size));
    if (recording == nullptr) continue;
    const std::uint64_t cycles = count(*recording, kFirstDeviceStream);
    EXPECT_GE(cycles, longest);
    EXPECT_FALSE(recording->ended_properly());
    EXPECT_LT(recording->ignored_bytes(), 400u) << "only the record at the end";
    longest = std::max(longest, cycles);
  }
  EXPECT_EQ(longest, 3u);
}

TEST_F(Recordings, DamageEndsARecording) {
  record();
  const std::string whole = bytes();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int flip : {1, 128}) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ flip);
      const auto recording = read(damaged);
      if (recording == nullptr) continue;
      RawRecord raw;
      Stream stream = 0;
      while (recording->next_of_any(raw, stream)) {
      }
      EXPECT_GT(recording->ignored_bytes(), 0u) << "byte " << at;
    }
  }
}

// What was being written when the recorder was killed is no damage; a record that is all there, with another byte, is.
TEST_F(Recordings, AFlippedByteInAWholeRecordIsNoTornEnd) {
  record();
  std::string whole = bytes();
  const auto damaged = [&](const std::string& text) {
    const auto recording = read(text);
    if (recording == nullptr) return true;  // the session's record comes last in a short one
    RawRecord raw;
    Stream stream = 0;
    while (recording->next_of_any(raw, stream)) {
    }
    return recording->damaged();
  };
  EXPECT_FALSE(damaged(whole));
  EXPECT_FALSE(damaged(whole.substr(0, whole.size() - 3)));
  const std::size_t place = whole.size() - 60;  // in the last but one record
  whole[place] = static_cast<char>(whole[place] ^ 4);
  EXPECT_TRUE(damaged(whole));
}

TEST_F(Recordings, AnotherFileIsRefusedWithItsReason) {
  EXPECT_EQ(read("bodies: []\n"), nullptr);
  EXPECT_NE(problem_.find("no recording of inputs"), std::string::npos);
  record();
  std::string newer = bytes();
  newer[sizeof kMagic] = 9;
  EXPECT_EQ(read(newer), nullptr);
  EXPECT_NE(problem_.find("version 9; this simulator reads version " + std::to_string(kVersion)), std::string::npos);
  EXPECT_EQ(Recording::open("/no/such/file", problem_), nullptr);
  EXPECT_NE(problem_.find("No such file"), std::string::npos);
  EXPECT_EQ(Recorder::create("/no/such/folder/file", {}, log_, problem_), nullptr);
  EXPECT_EQ(Recorder::create("/dev/null", {}, log_, problem_), nullptr);
  EXPECT_NE(problem_.find("not an ordinary file"), std::string::npos);
}

TEST_F(Recordings, WhatDoesNotFitLeavesAGapThatTheFileNames) {
  log_.expect_warning("has a gap");
  {
    const auto recorder = create();
    Channel& device = recorder->make_channel(kFirstDeviceStream + 4);
    for (int i = 0; i < 20; ++i) device.add(CycleRecord{});
    CycleRecord cycle;
    cycle.settings.resize(100'000);  // more than a record may be, however fast the ring is emptied
    device.add(cycle);
    device.add(CycleRecord{});
  }
  const auto recording = Recording::open(path_, problem_);
  ASSERT_NE(recording, nullptr);
  EXPECT_EQ(count(*recording, kFirstDeviceStream + 4), 20u) << "none that came after the gap";
  ASSERT_TRUE(recording->gap());
  EXPECT_EQ(*recording->gap(), kFirstDeviceStream + 4);
}

TEST_F(Recordings, NumbersThatNoEnumerationHasAreRefused) {
  Bytes bytes;
  append(bytes, kPhysicsStream, CommandKeptRecord{{1, 1}, state::Source::ros, 5}, true);
  RawRecord raw{Type::command_kept, Bytes(bytes.begin() + sizeof(RecordHead), bytes.end())};
  EXPECT_TRUE(raw.as<CommandKeptRecord>());
  raw.bytes[8] = 200;
  EXPECT_FALSE(raw.as<CommandKeptRecord>()) << "source 200";
  raw.bytes.push_back(0);
  EXPECT_FALSE(raw.as<CommandKeptRecord>()) << "too long";
}

TEST_F(Recordings, AFullDiskEndsTheRecordingWithOneLine) {
  log_.expect_warning("ends here: ");
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = 4096;
  const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  record(1000);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, ignored);
  EXPECT_LE(std::filesystem::file_size(path_), 4096u);
}

}  // namespace
}  // namespace ambf::inputs
