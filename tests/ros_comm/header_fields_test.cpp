// Connection headers of strangers.
#include "ros_comm/header_fields.h"

#include <gtest/gtest.h>
#include <ros/header.h>

#include <string>

namespace ambf::ros_comm {
namespace {

bool parses(const std::string& bytes) {
  ros::Header header;
  std::string error, copy = bytes;
  return header.parse(reinterpret_cast<std::uint8_t*>(copy.data()), static_cast<std::uint32_t>(copy.size()), error);
}

std::string field(std::uint32_t length, const std::string& text) {
  return std::string(reinterpret_cast<const char*>(&length), sizeof length) + text;
}

TEST(HeaderFields, TheProgramsParserStandsBeforeTheLibrarys) { EXPECT_TRUE(check_header_fields()); }

TEST(HeaderFields, ThatClaimMoreThanCameAreRefused) {
  EXPECT_TRUE(parses(field(3, "a=b") + field(4, "c=de")));
  EXPECT_FALSE(parses(field(999'999, "a=b")));
  EXPECT_FALSE(parses(field(3, "a=b") + field(5, "c=de")));
  EXPECT_FALSE(parses(field(3, "a=b") + "xy"));
  EXPECT_FALSE(parses(field(0xffffffff, "")));
}

}  // namespace
}  // namespace ambf::ros_comm
