// Collects what building a model finds, each with its file, line and block. Loader thread.
#pragma once

#include <string>
#include <utility>

#include "base/diagnostic.h"
#include "scene/description.h"

namespace ambf::model {

class Findings {
 public:
  explicit Findings(std::string file) : file_(std::move(file)) {}

  void error(const scene::Identity& at, std::string key, std::string message, std::string hint = {}) {
    add(base::Severity::error, at, std::move(key), std::move(message), std::move(hint));
  }
  void warning(const scene::Identity& at, std::string key, std::string message, std::string hint = {}) {
    add(base::Severity::warning, at, std::move(key), std::move(message), std::move(hint));
  }
  void information(const scene::Identity& at, std::string key, std::string message, std::string hint = {}) {
    add(base::Severity::information, at, std::move(key), std::move(message), std::move(hint));
  }
  base::Diagnostics take() { return std::move(found_); }

 private:
  void add(base::Severity severity, const scene::Identity& at, std::string key, std::string message, std::string hint) {
    found_.push_back({severity, file_, at.where.line, at.where.column, at.identifier, std::move(key),
                      std::move(message), std::move(hint)});
  }

  std::string file_;
  base::Diagnostics found_;
};

}  // namespace ambf::model
