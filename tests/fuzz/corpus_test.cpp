// Runs the seeds of the fuzzers, and generated texts that break parsers, within the bounds of promise PR1.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/slowness.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

void run(const std::string& text) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

TEST(FuzzCorpus, SeedsOfAdfEndInAResultOrAMessage) {
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(AMBF_SOURCE_DIR) + "/tests/fuzz/corpus/adf")) {
    std::stringstream text;
    text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    run(text.str());
    ++files;
  }
  EXPECT_GE(files, 10u);
}

std::string repeated(const std::string& part, std::size_t count) {
  std::string text;
  text.reserve(part.size() * count);
  for (std::size_t i = 0; i < count; ++i) text += part;
  return text;
}

TEST(FuzzCorpus, HostileAdfTextsEnd) {
  for (const char* part : {"[", "{",     "[:",    "{:",           "- ",       "? ",    "a: ",  "&a ",  "*a ",
                           "!", "\"",    "'",     "|\n",          ">\n",      "a:\n ", "[a, ", "{a: ", "\t",
                           "%", "---\n", "...\n", "\xef\xbb\xbf", "\xff\xfe", "!<a> ", "[]: ", "{}: "}) {
    run(repeated(part, 20'000));
    run("bodies: [A]\nA: " + repeated(part, 20'000));
  }
  for (std::size_t length : {1u, 2u, 3u, 4u, 1024u}) run(std::string(length, '\0'));
}

TEST(FuzzCorpus, OneBlockListedThousandsOfTimesEnds) {
  run("bodies: [" + repeated("A, ", 9'000) + "A]\nA: {name: A, mass: 1, compound shape: [" +
      repeated("{shape: BOX, geometry: {x: 1, y: 1, z: 1}}, ", 500) + "]}\n");
  run("bodies: [" + repeated("A, ", 9'000) + "A]\nA: {mass: 1}\n");
}

TEST(FuzzCorpus, LargeAdfTextsEndWithinAGigabyte) {
#if AMBF_UNDER_SANITIZER
  GTEST_SKIP() << "a sanitizer needs memory of its own";
#endif
  constexpr std::size_t kSize = 8u << 20;
  for (const std::string part : {"[", "{a: ", "[:", "1,", "a: 1\n", "- a\n", "a", "*"})
    run("[" + repeated(part, kSize / part.size() - 1));
  std::string undefined = "bodies: [", defined;
  for (int i = 0; i < 9'999; ++i) undefined += "b" + std::to_string(i) + ",";
  for (int i = 0; i < 150'000; ++i) defined += "k" + std::to_string(i) + ": {}\n";
  run(undefined + "]\n" + defined);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 1l << 20);  // KiB
}

}  // namespace
