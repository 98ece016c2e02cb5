#include "devices/drivers/options.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace ambf::devices {

namespace {

bool parse(const std::string& text, double& value) {
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && rest == end && std::isfinite(value);
}

std::string joined(const std::vector<std::string>& parts, const char* between) {
  std::string all;
  for (const std::string& part : parts) all += (all.empty() ? "" : between) + part;
  return all;
}

std::string short_number(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

const std::string* Options::find(const std::string& name) {
  known_.insert(name);
  const auto found = request_.options.find(name);
  return found == request_.options.end() ? nullptr : &found->second;
}

void Options::complain(const std::string& name, const std::string& value, const std::string& wanted) {
  problems_.push_back("'" + name + "' is '" + value + "', not " + wanted);
}

std::string Options::text(const std::string& name, const std::string& fallback) {
  const std::string* value = find(name);
  return value == nullptr ? fallback : *value;
}

double Options::number(const std::string& name, double fallback, double min, double max) {
  const std::string* text = find(name);
  if (text == nullptr) return fallback;
  double value = 0.0;
  if (parse(*text, value) && value >= min && value <= max) return value;
  complain(name, *text, "a number from " + short_number(min) + " to " + short_number(max));
  return fallback;
}

unsigned Options::count(const std::string& name, unsigned fallback, unsigned max) {
  const double value = number(name, fallback, 0.0, max);
  if (value == std::floor(value)) return static_cast<unsigned>(value);
  complain(name, *find(name), "a whole number");
  return fallback;
}

std::size_t Options::choice(const std::string& name, const std::vector<std::string>& words) {
  const std::string* text = find(name);
  if (text == nullptr) return 0;
  const auto found = std::find(words.begin(), words.end(), *text);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  complain(name, *text, "one of " + joined(words, ", "));
  return 0;
}

SourceAxis Options::axis(const std::string& name, const std::string& fallback, const std::vector<std::string>& names) {
  const std::string value = text(name, fallback);
  if (value == "none") return {};
  const bool reversed = !value.empty() && value.front() == '-';
  const auto found = std::find(names.begin(), names.end(), reversed ? value.substr(1) : value);
  if (found != names.end()) return {static_cast<int>(found - names.begin()), reversed ? -1.0 : 1.0};
  // A default that this hardware lacks is no mistake of the file's.
  if (find(name) != nullptr) complain(name, value, "none or, with or without a minus, one of " + joined(names, ", "));
  return {};
}

std::string Options::path(const std::string& name) {
  const std::string value = text(name);
  return value.empty() || value.front() == '/' || request_.folder.empty() ? value : request_.folder + "/" + value;
}

std::string Options::problems() const {
  std::vector<std::string> all = problems_;
  for (const auto& option : request_.options) {
    if (known_.count(option.first) == 0) all.push_back("'" + option.first + "' is no key of this driver");
  }
  return all.empty() ? "" : "key 'driver': " + joined(all, "; ");
}

}  // namespace ambf::devices
