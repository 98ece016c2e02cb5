// Runs the seeds of fuzz_inputs, whole and damaged.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

void run(const std::string& text) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

TEST(FuzzCorpus, SeedsOfRecordingsEndInValuesOrARefusal) {
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(AMBF_SOURCE_DIR) + "/tests/fuzz/corpus/inputs")) {
    std::stringstream text;
    text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    const std::string whole = text.str();
    run(whole);
    for (std::size_t at = 0; at < whole.size(); ++at) {
      run(whole.substr(at));
      std::string damaged = whole.substr(at);
      damaged.front() = static_cast<char>(damaged.front() ^ 0xff);
      run(damaged);
    }
    ++files;
  }
  EXPECT_GE(files, 5u);
}

}  // namespace
