// The log ring and its drain, with real threads.
#include "base/log.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <thread>
#include <vector>

#include "base/log_drain.h"

namespace ambf::base {
namespace {

TEST(Log, KeepsOrderSeverityAndFormat) {
  Log log;
  log.info("%d of %s", 3, "four");
  log.warning("second");
  log.error("third");
  LogRecord record;
  ASSERT_TRUE(log.take(record));
  EXPECT_EQ(record.text, "3 of four");
  EXPECT_EQ(record.severity, Severity::information);
  ASSERT_TRUE(log.take(record));
  EXPECT_EQ(record.severity, Severity::warning);
  ASSERT_TRUE(log.take(record));
  EXPECT_EQ(record.severity, Severity::error);
  EXPECT_FALSE(log.take(record));
}

TEST(Log, ShortensWhatIsTooLongVisibly) {
  Log log;
  log.info("%s", std::string(2000, 'x').c_str());
  LogRecord record;
  ASSERT_TRUE(log.take(record));
  EXPECT_EQ(record.text.size(), kLogTextSize - 1);
  EXPECT_EQ(record.text.substr(record.text.size() - 4), "x...");
}

TEST(Log, CountsWhatDoesNotFitAndKeepsTheOldest) {
  Log log(8);
  for (int i = 0; i < 20; ++i) log.info("%d", i);
  EXPECT_EQ(log.lost(), 12u);
  LogRecord record;
  for (int i = 0; i < 8; ++i) {
    ASSERT_TRUE(log.take(record));
    EXPECT_EQ(record.text, std::to_string(i));
  }
  EXPECT_FALSE(log.take(record));
}

TEST(Log, TakesDiagnosticsOfAnyLength) {
  Log log;
  Diagnostic d;
  d.file = std::string(3000, 'p');
  d.message = "m";
  log.report(d);
  LogRecord record;
  ASSERT_TRUE(log.take(record));
  EXPECT_EQ(record.text, to_string(d));
  EXPECT_TRUE(record.complete);
  log.report(d);  // left inside: freed with the log
}

TEST(Log, DoesNotWaitForADrainThatDoesNotExist) {
  Log log(2);
  Diagnostic d;
  for (int i = 0; i < 100; ++i) log.report(d);
  EXPECT_EQ(log.lost(), 98u);
}

TEST(LogDrain, DeliversEverythingInEachThreadsOrder) {
  Log log(256);
  std::map<int, int> next;
  int wrong = 0, told_lost = 0, delivered = 0;
  {
    LogDrain drain(log, [&](const LogLine& line) {
      int thread = 0, number = 0;
      if (std::sscanf(line.text.c_str(), "t%d n%d", &thread, &number) == 2) {
        wrong += number < next[thread];
        next[thread] = number + 1;
        ++delivered;
      } else if (std::sscanf(line.text.c_str(), "%d messages were lost", &number) == 1) {
        told_lost += number;
      } else {
        ++wrong;
      }
    });
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&, t] {
        for (int i = 0; i < 3000; ++i) log.warning("t%d n%d", t, i);
      });
    }
    for (auto& thread : threads) thread.join();
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(delivered + told_lost, 4 * 3000) << "what is missing was counted";
  EXPECT_EQ(static_cast<std::uint64_t>(told_lost), log.lost());
}

TEST(LogDrain, FlushBringsOutWhatWasSaidBefore) {
  Log log;
  std::vector<std::string> lines;
  LogDrain drain(log, [&](const LogLine& line) { lines.push_back(line.text); });
  for (int i = 0; i < 50; ++i) {
    log.info("same");
    drain.flush();
  }
  log.info("%s", "other");
  drain.flush();
  ASSERT_GE(lines.size(), 3u);
  EXPECT_EQ(lines.front(), "same");
  EXPECT_EQ(lines[1], "same (repeated once)");
  EXPECT_EQ(lines.back(), "other");
}

TEST(LogDrain, SaysPendingCountsAtItsEnd) {
  Log log;
  std::vector<std::string> lines;
  {
    LogDrain drain(log, [&](const LogLine& line) { lines.push_back(line.text); });
    for (int i = 0; i < 121; ++i) log.error("again");
  }
  EXPECT_EQ(lines, (std::vector<std::string>{"again", "again (repeated 120 times)"}));
}

TEST(LogDrain, LetsALoaderReportMoreThanFitsAtOnce) {
  Log log(16);
  int lines = 0;
  {
    LogDrain drain(log, [&](const LogLine&) { ++lines; });
    Diagnostics many(500);
    for (std::size_t i = 0; i < many.size(); ++i) many[i].line = static_cast<int>(i + 1), many[i].file = "f";
    log.report(many);
  }
  EXPECT_EQ(lines, 500);
  EXPECT_EQ(log.lost(), 0u);
}

}  // namespace
}  // namespace ambf::base
