// Model files (ADF 1, 13).
#include "adf/detail/actuator_parser.h"
#include "adf/detail/bind.h"
#include "adf/detail/body_parser.h"
#include "adf/detail/files.h"
#include "adf/detail/ghost_parser.h"
#include "adf/detail/joint_parser.h"
#include "adf/detail/open_file.h"
#include "adf/detail/scalars.h"
#include "adf/detail/sensor_parser.h"
#include "adf/detail/soft_body_parser.h"
#include "adf/detail/task_parser.h"
#include "adf/detail/vehicle_parser.h"
#include "adf/detail/view_parser.h"
#include "adf/urdf_import.h"
#include "scene/actuator.h"
#include "scene/block_kinds.h"
#include "scene/ghost.h"
#include "scene/lookup.h"
#include "scene/sensor.h"
#include "scene/soft_body.h"
#include "scene/task.h"
#include "scene/vehicle.h"

namespace ambf::adf {

namespace {

void parse_header(const Fields& fields, const FileContext& file, scene::Model& model) {
  model.shaders = parse_shaders(fields, "shaders", file);
  if (!fields.has("namespace")) {
    file.report.information(fields.mark(), "namespace", "missing; topics start with the object's name",
                            "usually /ambf/env/");
  }
}

std::map<std::string, std::string> conflict_numbers(const Fields& header, Report& report) {
  std::map<std::string, std::string> numbers;
  const Value map = header.map("conflict numbers").value();
  for (std::size_t i = 0; map.is_map() && i < map.size(); ++i) {
    const auto [block, value] = map.entry(i);
    const std::int64_t number = value.is_scalar() ? to_integer(value.text()).value_or(-1) : -1;
    if (!block.is_scalar() || number < 0) {
      report.warning(value.mark(), "conflict numbers", "expected the key of a block and a whole number from 0 on",
                     "the smallest free number is taken");
    } else if (number > 0) {
      numbers.emplace(block.text(), std::to_string(number));
    }
  }
  return numbers;
}

// Blocks of one kind, in the order of their list.
template <typename Object, typename Parse>
void parse_blocks(Header& header, const scene::BlockKind& kind, const FileContext& file, std::vector<Object>& objects,
                  Parse parse) {
  NameBook names;
  for (const Block& block : header.blocks(std::string(kind.list.name), *kind.group, file.report)) {
    file.report.set_block(block.identifier);
    if (auto object = parse(block, file, names)) objects.push_back(std::move(*object));
  }
  file.report.set_block({});
}

// A block of a kind that is read from its rows alone.
std::optional<scene::KindBlock> parse_kind_block(const scene::BlockKind& kind, const Block& block,
                                                 const FileContext& file, NameBook& names) {
  const std::shared_ptr<void> description = kind.make(file.options.defaults);
  fill_untyped(block.fields.value(), *kind.group, description.get());
  bool good = true;
  if (kind.check != nullptr) {
    for (const scene::BlockFinding& found : kind.check(description.get())) {
      const base::Severity severity = found.is_error ? base::Severity::error : base::Severity::warning;
      file.report.add(severity, block.fields.mark(found.key), found.key, found.message, found.hint);
      good &= !found.is_error;
    }
  }
  if (!good) return std::nullopt;
  return scene::KindBlock{&kind, parse_identity(block, file, names), description};
}

void parse_bodies(Header& header, const scene::BlockKind& kind, const FileContext& file, scene::Model& model) {
  parse_blocks(header, kind, file, model.bodies,
               [&model](const Block& block, const FileContext& context, NameBook& names) {
                 std::optional<scene::Body> body = parse_body(block, context, names);
                 if (body && block.fields.has("resistive surface"))
                   if (auto surface = parse_resistive_surface(block, *body, context))
                     model.blocks.push_back(std::move(*surface));
                 return body;
               });
}

void parse_kind(Header& header, const scene::BlockKind& kind, const FileContext& file, scene::Model& model) {
  if (kind.group == &scene::group::kBody) return parse_bodies(header, kind, file, model);
  if (kind.group == &scene::group::kJoint) return parse_blocks(header, kind, file, model.joints, parse_joint);
  if (kind.group == &scene::group::kCamera) return parse_blocks(header, kind, file, model.cameras, parse_camera);
  if (kind.group == &scene::group::kLight) return parse_blocks(header, kind, file, model.lights, parse_light);
  if (kind.group == &scene::group::kGhostObject) return parse_blocks(header, kind, file, model.blocks, parse_ghost);
  if (kind.group == scene::kind::kActuator.group) return parse_blocks(header, kind, file, model.blocks, parse_actuator);
  if (kind.group == scene::kind::kSensor.group) return parse_blocks(header, kind, file, model.blocks, parse_sensor);
  if (kind.group == &scene::group::kSoftBody) return parse_blocks(header, kind, file, model.blocks, parse_soft_body);
  if (kind.group == scene::kind::kTask.group) return parse_blocks(header, kind, file, model.blocks, parse_task);
  if (kind.group == scene::kind::kVehicle.group) {
    return parse_blocks(header, kind, file, model.blocks,
                        [&model](const Block& block, const FileContext& context, NameBook& names) {
                          return parse_vehicle(block, context, names, model.bodies);
                        });
  }
  if (kind.make == nullptr) {
    header.blocks(std::string(kind.list.name), *kind.group, file.report, kind.simulated);
    return;
  }
  const auto parse = [&kind](const Block& block, const FileContext& context, NameBook& names) {
    return parse_kind_block(kind, block, context, names);
  };
  parse_blocks(header, kind, file, model.blocks, parse);
}

}  // namespace

ModelResult parse_model(const std::string& text, const std::string& path, const Options& options) {
  if (is_urdf(text)) return parse_urdf(text, path, options);
  Report report(path);
  if (const auto element = other_xml(text)) {
    report.error({1, 1}, {},
                 element->empty() ? "this is XML without an element"
                                  : "this is XML, but no URDF: its first element is `" + *element + "`, not `robot`",
                 "robots are read as URDF or ADF: convert it, or expand its macros, first");
    return {std::nullopt, report.take()};
  }
  std::optional<Document> document = open_document(text, scene::group::kModel, report);
  if (!document) return {std::nullopt, report.take()};
  Header header(document->root());
  const Fields& fields = header.fields();
  const FileContext file{report,
                         options,
                         folder_of(path),
                         scene::join_namespace({}, fields.text("namespace")),
                         fields.text("high resolution path"),
                         fields.text("low resolution path")};
  auto model = read<scene::Model>(fields.value(), scene::group::kModel, options.defaults);
  model.file = path;
  model.name = file_name_of(path);
  parse_header(fields, file, model);
  for (const scene::BlockKind* kind : scene::block_kinds()) parse_kind(header, *kind, file, model);
  check_actuators(model, report);
  auto numbers = conflict_numbers(fields, report);
  return {std::move(model), report.take(), std::make_shared<const Document>(std::move(*document)),
          std::make_shared<const std::string>(text), std::move(numbers)};
}

ModelResult load_model(const std::string& path, const Options& options) {
  const FileText file = read_text(path);
  if (!file.text) return {std::nullopt, {unreadable(path, file.problem)}};
  return parse_model(*file.text, path, options);
}

}  // namespace ambf::adf
