#include "ros_comm/header_fields.h"

#include <dlfcn.h>
#include <ros/header.h>

#include <cstdint>
#include <cstring>
#include <string>

namespace {

using Parser = bool (*)(ros::Header* self, std::uint8_t* buffer, std::uint32_t size, std::string& error);

Parser library_parser() {
  static const auto parser = reinterpret_cast<Parser>(
      dlsym(RTLD_NEXT, "_ZN3ros6Header5parseEPhjRNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE"));
  return parser;
}

// Whether each field, its length before it, lies within the header.
bool fits(const std::uint8_t* buffer, std::uint32_t size) {
  for (std::uint32_t at = 0; at < size;) {
    std::uint32_t length = 0;
    if (size - at < sizeof length) return false;
    std::memcpy(&length, buffer + at, sizeof length);
    at += sizeof length;
    if (length > size - at) return false;
    at += length;
  }
  return true;
}

}  // namespace

// The dynamic linker takes the program's definition of a function before a library's, also for calls within the
// library: both forms of parse() end here.
bool ros::Header::parse(std::uint8_t* buffer, std::uint32_t size, std::string& error) {
  const Parser parser = library_parser();
  if (parser != nullptr && fits(buffer, size)) return parser(this, buffer, size, error);
  error = "a field of the connection header is longer than the header";
  return false;
}

namespace ambf::ros_comm {

bool check_header_fields() {
  if (library_parser() == nullptr) return false;
  // A field of three bytes in a header of five; the library alone reads the other two behind it.
  const boost::shared_array<std::uint8_t> bytes(new std::uint8_t[7]{3, 0, 0, 0, 'a', '=', 'b'});
  ros::Header header;
  std::string error;
  return !header.parse(bytes, 5, error) && header.parse(bytes, 7, error);
}

}  // namespace ambf::ros_comm
