// Worlds as arrays, without Python: what sanitizers see of ambf_core. Its behaviour is tested by test_world.py.
#include "native/stepped_world.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "native/doorbell.h"

namespace ambf::python {
namespace {

const char* const kPendulum = R"(
bodies: [BODY base, BODY bob]
joints: [JOINT hinge]
namespace: /test/
BODY base: {name: base, mass: 0, shape: BOX, geometry: {x: 0.1, y: 0.1, z: 0.1},
  location: {position: {x: 0, y: 0, z: 1}, orientation: {r: 0, p: 0, y: 0}}}
BODY bob: {name: bob, mass: 1, shape: BOX, geometry: {x: 0.1, y: 0.1, z: 0.1},
  collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1},
  location: {position: {x: 0, y: 0, z: 0.5}, orientation: {r: 0, p: 0, y: 0}}}
JOINT hinge: {name: hinge, parent: BODY base, child: BODY bob, type: revolute, max motor impulse: 1,
  parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: 0, y: 0, z: 0.5}, parent axis: {x: 0, y: 1, z: 0},
  child axis: {x: 0, y: 1, z: 0}}
)";

// A world with memory of its own, exactly as large as it must be: AddressSanitizer sees each write beyond.
struct Arrays {
  explicit Arrays(const std::shared_ptr<mesh::MeshCache>& meshes = nullptr) : world(settings(meshes)) {
    state::LoadRequest request;
    request.text = kPendulum;
    EXPECT_TRUE(world.load(request).success);
    attach(false);
  }
  static WorldSettings settings(const std::shared_ptr<mesh::MeshCache>& meshes) {
    WorldSettings out;
    out.meshes = meshes;
    return out;
  }
  Memory allocate(std::span<const Field> fields, std::vector<std::vector<char>>& bytes) {
    Memory memory;
    bytes.clear();
    for (const Field& field : fields) bytes.emplace_back(bytes_of(*world.structure(), field));
    for (std::vector<char>& each : bytes) memory.push_back(each.data());
    return memory;
  }
  void attach(bool keep_commands) {
    Memory state = allocate(state_fields(), state_bytes);
    Memory commands = allocate(command_fields(), command_bytes);
    world.attach(std::move(state), std::move(commands), keep_commands);
  }
  template <class T>
  T* of(std::span<const Field> fields, std::vector<std::vector<char>>& bytes, const std::string& name) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (name == fields[i].name) return reinterpret_cast<T*>(bytes[i].data());
    }
    ADD_FAILURE() << name;
    return nullptr;
  }
  double angle() { return of<double>(state_fields(), state_bytes, "joint_position")[0]; }
  void command(double angle_rad) {
    of<double>(command_fields(), command_bytes, "joint_value")[0] = angle_rad;
    of<signed char>(command_fields(), command_bytes, "joint_mode")[0] = static_cast<signed char>(JointMode::position);
  }

  SteppedWorld world;
  std::vector<std::vector<char>> state_bytes, command_bytes;
};

TEST(SteppedWorld, ObeysItsArraysAndShowsItsState) {
  Arrays arrays;
  arrays.command(0.25);
  ASSERT_EQ(arrays.world.post(), "");
  ASSERT_TRUE(arrays.world.run(2000));
  EXPECT_NEAR(arrays.angle(), 0.25, 0.01);
  const std::uint64_t hash = arrays.world.hash();
  arrays.command(std::numeric_limits<double>::quiet_NaN());
  EXPECT_NE(arrays.world.post(), "");
  EXPECT_EQ(arrays.world.hash(), hash);
  arrays.world.reset();
  EXPECT_EQ(arrays.angle(), 0.0);
  EXPECT_EQ(arrays.world.post(), "");
}

TEST(SteppedWorld, TakesNewMemoryAfterAChangeOfTheStructure) {
  Arrays arrays;
  arrays.command(0.25);
  ASSERT_EQ(arrays.world.post(), "");
  ASSERT_TRUE(arrays.world.run(10));
  ASSERT_TRUE(arrays.world.remove("BODY bob").success);
  arrays.attach(false);
  EXPECT_EQ(rows_of(*arrays.world.structure(), Rows::joints), 0u);
  ASSERT_EQ(arrays.world.post(), "");
  EXPECT_TRUE(arrays.world.run(10));
}

TEST(SteppedWorld, WorldsWithOneCacheOnThreadsOfTheirOwnGiveTheSameBits) {
  const auto meshes = std::make_shared<mesh::MeshCache>();
  std::uint64_t hashes[2] = {};
  std::thread threads[2];
  for (int i = 0; i < 2; ++i) {
    threads[i] = std::thread([&, i] {
      Arrays arrays(meshes);
      arrays.command(0.5);
      EXPECT_EQ(arrays.world.post(), "");
      EXPECT_TRUE(arrays.world.run(200));
      hashes[i] = arrays.world.hash();
    });
  }
  for (std::thread& each : threads) each.join();
  EXPECT_NE(hashes[0], 0u);
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Doorbell, WakesASleeperAndTimesOut) {
  std::uint32_t bell = 7;
  EXPECT_FALSE(wait_for_ring(bell, 7, 0.01));
  std::thread ringer([&] { ring(bell); });
  EXPECT_TRUE(wait_for_ring(bell, 7, 60.0));
  ringer.join();
  EXPECT_EQ(bell, 8u);
}

}  // namespace
}  // namespace ambf::python
