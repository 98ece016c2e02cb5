#include "adf/urdf_import.h"

#include <algorithm>
#include <cctype>

#include "adf/detail/files.h"
#include "adf/detail/open_file.h"
#include "adf/detail/urdf_answer.h"
#include "adf/detail/urdf_text.h"
#include "adf/detail/urdf_writer.h"
#include "base/worker.h"

namespace ambf::adf {

namespace {

constexpr std::size_t kHead = 65536;  // where the first element must begin

std::string_view without_space(std::string_view text) {
  const std::size_t start = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  return start == std::string_view::npos ? std::string_view() : text.substr(start);
}

base::Diagnostic finding(base::Severity severity, const std::string& path, int line, int column,
                         const std::string& message, const std::string& hint) {
  return {severity, path, line, column, "", "", message, hint};
}

// What urdfdom makes of it; with a filled error, or a problem of the process, refused.
bool ask(const std::string& text, const std::string& path, urdf::Robot& robot, base::Diagnostics& diagnostics) {
  base::WorkerCall call;
  call.program = base::program_beside_library("ambf_file_reader");
  base::WireWriter writer;
  writer.text("urdf");
  writer.text(text);
  const base::WorkerAnswer reply = base::ask_worker(call, std::move(writer).bytes());
  const auto refuse = [&](int line, int column, const std::string& why, const std::string& hint) {
    diagnostics.push_back(finding(base::Severity::error, path, line, column, why, hint));
    return false;
  };
  if (!reply.ok) {
    return refuse(0, 0, "the reader of URDF files (urdfdom, in a process of its own) gave up: " + reply.problem,
                  "check the file with check_urdf");
  }
  base::WireReader reader(reply.bytes);
  urdf::transfer(reader, robot);
  const std::string wrong = reader.at_end() ? urdf::check(robot) : std::string("sizes");
  if (!wrong.empty())
    return refuse(robot.error_line, 0, "this is no robot that can be simulated: " + wrong, "mend the file");
  if (robot.error.empty()) return true;
  return refuse(robot.error_line, robot.error_column, "the URDF is refused: " + robot.error, "mend the element");
}

void report_unused(const urdf::Robot& robot, const std::string& path, base::Diagnostics& diagnostics) {
  for (const urdf::Unused& unused : robot.unused) {
    diagnostics.push_back(finding(base::Severity::information, path, unused.line, 0,
                                  std::to_string(unused.count) + " x " + unused.what + " without effect", ""));
  }
  std::size_t floating = 0;
  int floating_line = 0;
  for (const urdf::Joint& joint : robot.joints) {
    if (joint.kind == urdf::JointKind::floating && floating++ == 0) floating_line = joint.line;
  }
  if (floating > 0) {
    diagnostics.push_back(finding(base::Severity::information, path, floating_line, 0,
                                  std::to_string(floating) + " x joints of type floating: their links move freely",
                                  ""));
  }
}

}  // namespace

bool is_urdf(const std::string& text) {
  const std::string head = urdf::as_utf8(std::string_view(text).substr(0, kHead));
  const std::string_view start = without_space(head);
  return start.starts_with("<") && start.find("<robot") != std::string_view::npos;
}

std::optional<std::string> other_xml(const std::string& text) {
  const std::string head = urdf::as_utf8(std::string_view(text).substr(0, kHead));
  const std::string_view start = without_space(head);
  const auto is_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  // In YAML, `<<` merges maps.
  if (start.size() < 2 || start[0] != '<' || !(is_name(start[1]) || start[1] == '?' || start[1] == '!'))
    return std::nullopt;
  for (std::size_t at = 0; at < start.size(); ++at) {
    if (start.substr(at, 4) == "<!--") at = std::min(start.find("-->", at), start.size());
    if (at + 1 >= start.size() || start[at] != '<' || !is_name(start[at + 1])) continue;
    std::size_t end = at + 1;
    while (end < start.size() && (is_name(start[end]) || start[end] == '-' || start[end] == ':')) ++end;
    return std::string(start.substr(at + 1, std::min<std::size_t>(end - at - 1, 40)));
  }
  return std::string();
}

ConvertedUrdf convert_urdf(const std::string& text, const std::string& path, const UrdfOptions& options) {
  ConvertedUrdf result;
  const std::string utf8 = urdf::as_utf8(text);
  if (const int line = urdf::line_of_macro(utf8); line > 0) {
    result.diagnostics.push_back(finding(base::Severity::error, path, line, 0, "the file has macros of xacro",
                                         "expand them: xacro " + path + " > robot.urdf"));
    return result;
  }
  urdf::Robot robot;
  if (!ask(utf8, path, robot, result.diagnostics)) return result;
  report_unused(robot, path, result.diagnostics);
  const urdf::Warn warn = [&](int line, const std::string& message, const std::string& hint) {
    result.diagnostics.push_back(finding(base::Severity::warning, path, line, 0, message, hint));
  };
  const std::string name = robot.name;
  const urdf::Plan plan = urdf::plan_of(std::move(robot), {options.free_base, options.merge_fixed}, warn);
  urdf::Written written = urdf::write_adf(plan, name, {path, options.adf_path}, warn);
  result.adf = std::move(written.adf);
  result.line_of_block = std::move(written.line_of_block);
  return result;
}

ConvertedUrdf convert_urdf_file(const std::string& path, const UrdfOptions& options) {
  const FileText file = read_text(path);
  ConvertedUrdf refused;
  if (!file.text) {
    refused.diagnostics.push_back(unreadable(path, file.problem));
  } else if (!is_urdf(*file.text)) {
    refused.diagnostics.push_back(finding(base::Severity::error, path, 0, 0, "this is no URDF file",
                                          "URDF is XML with an element `robot`; ADF files need no conversion"));
  } else {
    return convert_urdf(*file.text, path, options);
  }
  return refused;
}

ModelResult parse_urdf(const std::string& text, const std::string& path, const Options& options) {
  ConvertedUrdf converted = convert_urdf(text, path, options.urdf);
  if (!converted.adf) return {std::nullopt, std::move(converted.diagnostics)};
  ModelResult result = parse_model(*converted.adf, path, options);
  // Lines are those of the URDF file; of what the ADF text says by itself, nothing is reported.
  for (base::Diagnostic& d : result.diagnostics) {
    if (d.severity == base::Severity::information) continue;
    const auto line = converted.line_of_block.find(d.block);
    d.line = line == converted.line_of_block.end() ? 0 : line->second;
    d.column = 0;
    if (d.severity == base::Severity::error && d.hint.empty()) d.hint = "mend this element of the URDF file";
    converted.diagnostics.push_back(std::move(d));
  }
  result.diagnostics = std::move(converted.diagnostics);
  if (result.model) {
    const auto place = [&](scene::Identity& identity, const std::string& block) {
      const auto line = converted.line_of_block.find(block);
      if (line != converted.line_of_block.end()) identity.where = {line->second, 1};
    };
    for (scene::Body& body : result.model->bodies) place(body.identity, body.identity.identifier);
    for (scene::Joint& joint : result.model->joints) place(joint.identity, joint.identity.identifier);
  }
  return result;
}

}  // namespace ambf::adf
