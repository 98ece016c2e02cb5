// Runs the seeds of one fuzzer (AMBF_SEEDS, a folder of tests/fuzz/corpus) through its entry.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

void run(const std::string& text) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

// A broken promise ends the program.
TEST(FuzzSeeds, AndChangedOnesEndInAResultOrAMessage) {
  std::mt19937 rng(11);
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(AMBF_SOURCE_DIR) + "/tests/fuzz/corpus/" + AMBF_SEEDS)) {
    std::stringstream stream;
    stream << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    const std::string seed = stream.str();
    run(seed);
    for (int round = 0; round < 40; ++round) {
      std::string changed = seed;
      for (auto changes = 1 + rng() % 3; changes > 0 && !changed.empty(); --changes) {
        const std::size_t at = rng() % changed.size();
        switch (rng() % 3) {
          case 0: changed[at] = static_cast<char>(rng()); break;
          case 1: changed.erase(at, 1 + rng() % 8); break;
          default: changed.insert(at, changed.substr(rng() % changed.size(), rng() % 30)); break;
        }
      }
      run(changed);
    }
    ++files;
  }
  EXPECT_GE(files, 5u);
}

}  // namespace
