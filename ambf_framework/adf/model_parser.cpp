// Model files (ADF 1, 13).
#include "adf/detail/body_parser.h"
#include "adf/detail/files.h"
#include "adf/detail/joint_parser.h"
#include "adf/detail/open_file.h"
#include "adf/detail/view_parser.h"
#include "scene/lookup.h"

namespace ambf::adf {

namespace {

void parse_header(const Fields& fields, const FileContext& file, scene::Model& model) {
  model.ignore_inter_collision = fields.flag("ignore inter-collision", false);
  model.gravity = fields.vector("gravity");
  model.joint_erp = fields.number("joint erp");
  model.joint_cfm = fields.number("joint cfm");
  model.shaders = parse_shaders(fields, "shaders", file);
  if (!fields.has("namespace")) {
    file.report.information(fields.mark(), "namespace", "missing; topics start with the object's name",
                            "usually /ambf/env/");
  }
}

// Blocks of one kind, in the order of their list.
template <typename Object, typename Parse>
void parse_blocks(Header& header, const scene::HeaderList& list, const FileContext& file, std::vector<Object>& objects,
                  Parse parse) {
  NameBook names;
  for (const Block& block : header.blocks(std::string(list.key), list.block, file.report)) {
    file.report.set_block(block.identifier);
    if (auto object = parse(block, file, names)) objects.push_back(std::move(*object));
  }
  file.report.set_block({});
}

}  // namespace

ModelResult parse_model(const std::string& text, const std::string& path, const Options& options) {
  Report report(path);
  const auto document = open_document(text, scene::Group::model, report);
  if (!document) return {std::nullopt, report.take()};
  Header header(document->root());
  const Fields& fields = header.fields();
  const FileContext file{report,
                         options,
                         folder_of(path),
                         scene::join_namespace({}, fields.text("namespace")),
                         fields.text("high resolution path"),
                         fields.text("low resolution path")};
  scene::Model model;
  model.file = path;
  model.name = file_name_of(path);
  parse_header(fields, file, model);
  for (const scene::HeaderList& list : scene::model_lists()) {
    switch (list.block) {
      case scene::Group::body: parse_blocks(header, list, file, model.bodies, parse_body); break;
      case scene::Group::joint: parse_blocks(header, list, file, model.joints, parse_joint); break;
      case scene::Group::camera: parse_blocks(header, list, file, model.cameras, parse_camera); break;
      case scene::Group::light: parse_blocks(header, list, file, model.lights, parse_light); break;
      default: header.blocks(std::string(list.key), list.block, report, false); break;
    }
  }
  return {std::move(model), report.take()};
}

ModelResult load_model(const std::string& path, const Options& options) {
  const FileText file = read_text(path);
  if (!file.text) return {std::nullopt, {unreadable(path, file.problem)}};
  return parse_model(*file.text, path, options);
}

}  // namespace ambf::adf
