// Ten times each what tests/devices/operators_test.cpp does once, with seeds of their own: prints a row each time, ends
// with 1 when one fails. The puzzle is left out where the original's models are not there.
#include <cstdio>
#include <filesystem>
#include <string>

#include "tests/devices/puzzle_lift.h"
#include "tests/devices/ring_transfer.h"
#include "tests/support/compat_models.h"

namespace {

constexpr unsigned kTimes = 10;

// `run` gives {problem, seconds, largest force, its limit, m off} of a seed.
struct Row {
  std::string problem;
  double seconds, force_N, limit_N, off_m;
};
template <class Run>
unsigned ten_times(const char* what, Run run) {
  unsigned done = 0;
  std::printf("%s\n\n| time | simulated s | largest force, N (limit) | off, mm | |\n|---|---|---|---|---|\n", what);
  for (unsigned seed = 0; seed < kTimes; ++seed) {
    Row row = run(seed);
    if (row.problem.empty() && row.force_N > row.limit_N + 1e-9) row.problem = "the force was too large";
    done += row.problem.empty();
    std::printf("| %u | %.1f | %.2f (%.1f) | %.2f | %s |\n", seed + 1, row.seconds, row.force_N, row.limit_N,
                1e3 * row.off_m, row.problem.empty() ? "done" : row.problem.c_str());
  }
  std::printf("\n%u of %u\n\n", done, kTimes);
  return done;
}

}  // namespace

int main() {
  using namespace ambf::devices::testing;
  bool all = ten_times("A ring from hand to hand, onto a peg", [](unsigned seed) {
               const TransferResult result = transfer_ring(seed);
               return Row{result.problem, result.seconds, result.max_force_N, result.limit_N, result.off_peg_m};
             }) == kTimes;
  if (!std::filesystem::exists(ambf::compat::descriptions())) return all ? 0 : 1;
  all &=
      ten_times("Four devices lift the multi-link puzzle, two at 1 kHz with forces, two at 300 Hz", [](unsigned seed) {
        const LiftResult result = lift_puzzle(seed);
        return Row{result.problem, result.seconds, result.max_force_N, result.limit_N, result.off_m};
      }) == kTimes;
  return all ? 0 : 1;
}
