#include "file_names.h"

namespace ambf::file_reader {

namespace {

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

}  // namespace

std::string decoded_uri(const std::string& uri) {
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escaped = uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
    name += escaped ? static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
    i += escaped ? 2 : 0;
  }
  return name;
}

std::string with_plain_urls(std::string x3d) {
  for (std::size_t at = x3d.find("url="); at != std::string::npos; at = x3d.find("url=", at + 4)) {
    const std::size_t open = at + 4;
    if (open >= x3d.size() || (x3d[open] != '\'' && x3d[open] != '"')) continue;
    const std::size_t close = x3d.find(x3d[open], open + 1);
    if (close == std::string::npos) break;
    const std::string value = x3d.substr(open + 1, close - open - 1);
    for (const std::string quote : {"\"", "&quot;"}) {
      const std::size_t first = value.find(quote);
      const std::size_t last = first == std::string::npos ? first : value.find(quote, first + quote.size());
      if (last == std::string::npos) continue;
      const std::size_t begin = first + quote.size();
      x3d.replace(open + 1, close - open - 1, value.substr(begin, last - begin));
      break;
    }
  }
  return x3d;
}

}  // namespace ambf::file_reader
