// Random scenes of ten bodies (tests/physics/random_scene.h): how many gain energy, and how much. Usage:
// ambf_random_scenes_benchmark [number of scenes, 1000] [first seed]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "tests/physics/random_scene.h"

int main(int argc, char** argv) {
  using ambf::physics::testing::RandomScene;
  const int scenes = argc > 1 ? std::atoi(argv[1]) : 1000;
  const unsigned first = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 0;
  std::vector<double> gains;
  int no_numbers = 0;
  for (int i = 0; i < scenes; ++i) {
    const unsigned seed = first + static_cast<unsigned>(i);
    const RandomScene::Result result = RandomScene(seed).run(1.0);
    if (!result.finite) ++no_numbers;
    gains.push_back(result.gain);
    if (!result.finite || result.gain > 0.02)
      std::printf("seed %u: gain %.3g, gap %.3g m%s\n", seed, result.gain, result.gap,
                  result.finite ? "" : ", no number");
  }
  std::sort(gains.begin(), gains.end());
  const auto quantile = [&gains](double share) {
    return gains[static_cast<std::size_t>(share * static_cast<double>(gains.size() - 1))];
  };
  std::printf(
      "%d scenes, %d with no numbers; energy gained, share: median %.2e, 99 %% %.2e, 99.9 %% %.2e, largest %.2e\n",
      scenes, no_numbers, quantile(0.5), quantile(0.99), quantile(0.999), gains.back());
  return no_numbers == 0 ? 0 : 1;
}
