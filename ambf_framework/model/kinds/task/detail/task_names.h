// The names in a task block: what they mean in the world, and reports of those that mean nothing. Loader thread. For
// use inside model/kinds/task* only.
#pragma once

#include <string>

#include "model/detail/catalogue_impl.h"
#include "scene/description.h"

namespace ambf::model {

class TaskNames {
 public:
  TaskNames(const Catalogue::Impl& all, const scene::Identity& identity, const LoadedModel& model,
            const LoadOptions& options, Findings& findings);

  // False once any name was not found, or an error was reported.
  bool good() const { return good_; }

  // Null, and a report, when it means none or several; `where` and `key`: where it is written.
  const Entry* body(const std::string& wanted, scene::Location where, const std::string& key);
  const Entry* placed(const std::string& wanted, scene::Location where, const std::string& key);
  const Entry* sensor(const std::string& wanted, scene::Location where, const std::string& key);
  void error(scene::Location where, const std::string& key, const std::string& message);

 private:
  const Entry* find(const std::string& wanted, const char* what, scene::Location where, const std::string& key,
                    bool (*allowed)(state::ObjectKind));
  void report_absent(const scene::Identity& at, const std::string& key, const std::string& wanted, const char* what,
                     const std::vector<std::string>& known);

  const Catalogue::Impl& all_;
  const scene::Identity& identity_;
  const state::ModelId model_;
  const std::string name_space_;
  Findings& findings_;
  bool good_ = true;
};

}  // namespace ambf::model
