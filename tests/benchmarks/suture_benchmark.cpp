// Five bites by script with a half circle needle of 26 mm and its thread: where they are, what pull closes the gap of
// 3 mm, that it opens, that a knot holds, and what tears out. `meshes`: one bite in a ball and in a liver. Prints
// tables; ends with 1 where something does not hold.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <string_view>

#include "tests/benchmarks/judged.h"
#include "tests/physics/suture_rig.h"
#include "tests/physics/tissue_shapes.h"

namespace {

using namespace ambf::physics;
using namespace ambf::benchmarks;
using namespace ambf::physics::testing;
using ambf::math::norm;

constexpr int kBites = 5;
constexpr double kFirst = 0.003, kApart = 0.006;  // m

// m, of the five places: the widest and the narrowest.
struct Gaps {
  double widest = -1.0, narrowest = 1.0;
};
Gaps gaps(const SutureRig& rig) {
  Gaps found;
  for (int i = 0; i < kBites; ++i) {
    const double gap = rig.gap(kFirst + kApart * i);
    found.widest = std::max(found.widest, gap);
    found.narrowest = std::min(found.narrowest, gap);
  }
  return found;
}

void print(const char* what, const SutureRig& rig, bool good) {
  const Gaps now = gaps(rig);
  std::printf("| %s | %.2f to %.2f%s | %.2f | %.4f%s |\n", what, 1e3 * now.narrowest, 1e3 * now.widest, judged(good),
              norm(rig.needle.force_world()), rig.thread->length() / rig.thread->rest_length(),
              judged(std::abs(rig.thread->length() / rig.thread->rest_length() - 1.0) < 0.005));
  std::fflush(stdout);
}

bool closed(const SutureRig& rig) { return gaps(rig).widest < 0.0005; }

void where_they_are(SutureRig& rig) {
  const double half = std::sqrt(SutureRig::kRadius * SutureRig::kRadius - 0.0025 * 0.0025);
  double worst = 0.0;
  for (int i = 0; i < kBites; ++i) {
    const double y = kFirst + kApart * i;
    rig.needle.use(nullptr);
    rig.hand.set_pose(SutureRig::pose(-0.1, y));
    rig.needle.use(&rig.hand);
    rig.wait(1);
    rig.turn(-0.1, 3.1, y, 600);
    const auto found = rig.needle.on_surfaces();
    if (found.size() != 4) return void(std::printf("%zu punctures%s\n", found.size(), judged(false)));
    for (const std::size_t end : {0, 3}) {
      const double x = SutureRig::kMiddle + (end == 0 ? half : -half);
      worst = std::max({worst, std::abs(found[end].needle.x - x), std::abs(found[end].needle.z - SutureRig::kTop),
                        std::abs(found[end].needle.y - y)});
    }
    rig.turn(3.1, -0.1, y, 300);
  }
  std::printf("five bites, in and out: at most %.2f mm from where the tip goes%s\n", 1e3 * worst,
              judged(worst < 0.0005));
}

// A wound of 3 mm in 5 kPa, closed by one bite.
void one_bite(const char* name, const TissueDefinition& given, double pull) {
  SutureRig rig(given, 0.012, SutureRig::options(5.0));
  const double depth = 0.006;
  const auto print_gap = [&](const char* what, const auto& good) {
    const double gap = rig.gap(SutureRig::kBite, depth), length = rig.thread->length() / rig.thread->rest_length();
    std::printf("| %s, %s | %.2f%s | %.4f%s |\n", name, what, 1e3 * gap, judged(good(gap)), length,
                judged(std::abs(length - 1.0) < 0.005));
    std::fflush(stdout);
  };
  const auto is_closed = [](double gap) { return std::abs(gap) < 0.0005; };
  const auto is_open = [](double gap) { return gap > 0.0025; };
  print_gap("before", is_open);
  rig.bite();
  double worst = 0.0;
  for (const SurfacePuncture& each : rig.needle.on_surfaces()) worst = std::max(worst, SutureRig::off_path(each.rest));
  std::printf("| %s, %zu tetrahedra: %zu places in and out, at most %.2f mm from where the tip goes%s | | |\n", name,
              rig.tissue->link_count(), rig.needle.on_surfaces().size(), 1e3 * worst,
              judged(worst < 0.0005 && rig.needle.on_surfaces().size() == 4));
  const SutureRig::Saved sewn = rig.saved();
  rig.pull_end(pull);
  rig.wait(400);
  print_gap("pulled", is_closed);
  const SutureRig::Saved pulled = rig.saved();
  rig.end.release();
  rig.wait(400);
  print_gap("let go", is_open);
  rig.restore(pulled);
  rig.pull_end(pull);
  rig.wait(50);
  if (!rig.needle.tie()) std::printf("it cannot be tied%s\n", judged(false));
  rig.end.release();
  rig.wait(400);
  print_gap("tied, let go", is_closed);
  rig.pull_end(1.0);
  rig.wait(10000);
  print_gap("tied, 10 s at 1 N", [](double gap) { return gap < 0.0005; });
  for (const double strength : {0.3, 5.0}) {
    SutureRig weak(given, 0.012, SutureRig::options(strength));
    weak.restore(sewn);
    const std::size_t before = weak.needle.stitches();
    weak.pull_end(2.0);
    weak.wait(200);
    const std::size_t left = weak.needle.stitches();
    std::printf("| %s, of strength %g N, pulled by 2 N: %zu of %zu stitches are left%s | | %.4f |\n", name, strength,
                left, before, judged(strength > 1.0 ? left == before : left < 4),
                weak.thread->length() / weak.thread->rest_length());
  }
}

}  // namespace

int main(int count, char** words) {
  if (count > 1 && std::string_view(words[1]) == "meshes") {
    std::printf("| | gap, mm | thread, of its length |\n|---|---|---|\n");
    one_bite("ball", SutureRig::wounded(ball_lips(), 5e3), 0.5);
    one_bite("liver", SutureRig::wounded(liver_lips(), 5e3), 0.35);
    return all_good ? 0 : 1;
  }
  {
    SutureRig rig(0.030, 5.0, 6e4, 0.3);
    where_they_are(rig);
  }
  SutureRig rig(0.030, 5.0, 6e4, 0.3);
  std::printf("\n| of %zu tetrahedra | gaps, mm | at the needle, N | thread, of its length |\n|---|---|---|---|\n",
              rig.tissue->link_count());
  print("before", rig, gaps(rig).narrowest > 0.0029);
  double from = thread_seconds();
  rig.sew(kBites, kFirst, kApart);
  std::printf("| sewn: %zu stitches, those within included; %.2f ms a step | | | |\n", rig.needle.stitches(),
              1e3 * (thread_seconds() - from) / (kBites * 1700.0));
  rig.pull_end(0.5);
  rig.wait(600);
  print("pulled by 0.5 N", rig, true);
  rig.pull_end(1.5);
  rig.wait(600);
  print("pulled by 1.5 N", rig, closed(rig));
  const SutureRig::Saved pulled = rig.saved();
  rig.end.release();
  rig.go({0.0, 0.0, -0.03}, 200);  // both ends are loose
  rig.wait(800);
  print("let go", rig, gaps(rig).narrowest > 0.0015);
  rig.restore(pulled);
  rig.pull_end(1.5);
  rig.wait(100);
  if (!rig.needle.tie()) std::printf("it cannot be tied%s\n", judged(false));
  rig.end.release();
  rig.go({0.0, 0.0, -0.03}, 200);
  rig.wait(400);
  print("tied, let go", rig, closed(rig));
  rig.pull_end(1.0);
  from = thread_seconds();
  rig.wait(10000);
  const double step_ms = 0.1 * (thread_seconds() - from);
  print("tied, 10 s at 1 N", rig, closed(rig));
  std::printf("| %.2f ms a step then | | | |\n", step_ms);
  for (const double strength : {0.5, 5.0}) {
    SutureRig weak(0.030, strength, 6e4, 0.3);
    weak.restore(pulled);
    const std::size_t before = weak.needle.stitches();
    weak.pull_end(1.5);
    weak.wait(400);
    const std::size_t left = weak.needle.stitches();
    std::printf("| of strength %g N, pulled by 1.5 N: %zu of %zu stitches are left%s | | | |\n", strength, left, before,
                judged(strength > 1.0 ? left == before : left + 5 < before));
  }
  return all_good ? 0 : 1;
}
