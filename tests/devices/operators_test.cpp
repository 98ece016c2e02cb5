// Operators at emulated masters, with forces, do what the peg-transfer scene and the original's puzzle are for. Once
// here; ten times in tests/benchmarks/transfer_benchmark.cpp.
#include <gtest/gtest.h>

#include "tests/devices/puzzle_lift.h"
#include "tests/devices/ring_transfer.h"
#include "tests/support/compat_models.h"

namespace ambf::devices::testing {
namespace {

TEST(RingTransfer, IsPickedHandedOverAndPlacedByFriction) {
  const TransferResult result = transfer_ring(0);
  std::printf("%.1f s, largest force %.2f N of %.2f N, %.2f mm off the peg\n", result.seconds, result.max_force_N,
              result.limit_N, 1e3 * result.off_peg_m);
  EXPECT_EQ(result.problem, "");
  EXPECT_LE(result.max_force_N, result.limit_N + 1e-9);
  EXPECT_GT(result.max_force_N, 0.05) << "the hands feel what their tools do";
}

TEST(PuzzleLift, FourDevicesOfTwoRatesLiftItAndPutItDown) {
  AMBF_NEEDS_COMPAT();
  const LiftResult result = lift_puzzle(0);
  std::printf("%.1f s, largest force %.2f N of %.2f N, %.1f mm off\n", result.seconds, result.max_force_N,
              result.limit_N, 1e3 * result.off_m);
  EXPECT_EQ(result.problem, "");
  EXPECT_LE(result.max_force_N, result.limit_N + 1e-9);
}

}  // namespace
}  // namespace ambf::devices::testing
