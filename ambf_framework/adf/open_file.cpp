#include "adf/detail/open_file.h"

#include "adf/kind.h"

namespace ambf::adf {

std::optional<Document> open_document(const std::string& text, const scene::Group& group, Report& report) {
  Document document(text);
  if (document.error()) {
    report.error(document.error()->mark, {}, document.error()->message, document.error()->hint);
    return std::nullopt;
  }
  if (document.has_more_documents())
    report.warning({}, {}, "only the first document of the file counts",
                   "remove what follows its end ('---' or '...')");
  if (&group == &scene::group::kModel && !may_be_model(document.root(), report)) return std::nullopt;
  if (!Header::check(document.root(), group, report)) return std::nullopt;
  return document;
}

base::Diagnostic unreadable(const std::string& path, const std::string& problem) {
  base::Diagnostic diagnostic;
  diagnostic.file = path;
  diagnostic.message = "cannot be read: " + problem;
  diagnostic.hint = "check the path";
  return diagnostic;
}

}  // namespace ambf::adf
