// The first steps with every file: its YAML, its top level against the table. One thread.
#pragma once

#include "adf/detail/file_context.h"

namespace ambf::adf {

// A document whose top level has passed; none when the file is refused, with the reason in the report.
std::optional<Document> open_document(const std::string& text, const scene::Group& group, Report& report);

base::Diagnostic unreadable(const std::string& path, const std::string& problem);

}  // namespace ambf::adf
