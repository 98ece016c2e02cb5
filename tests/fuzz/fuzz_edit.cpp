// Any text saved as a model file: unchanged it stays byte for byte; with bodies moved and removed, and for another
// folder, it ends in a text that loads with as many bodies or in a message. The first line gives the orders: a letter
// for each body, m: it has moved, r: it was removed; a / before them: for another folder.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "adf/save.h"
#include "adf/urdf_import.h"
#include "math/rotation.h"

namespace {

using namespace ambf;

// libFuzzer reports an abort with its input.
void require(bool good) {
  if (!good) std::abort();
}

math::Pose moved(const math::Pose& pose, char letter) {
  const double by = 0.25 + static_cast<unsigned char>(letter) / 100.0;
  return {pose.position + math::Vec3{by, 0, -by}, math::from_rpy(0.5, -by, by) * pose.orientation};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string input(reinterpret_cast<const char*>(data), size);
  const std::size_t line = input.find('\n');
  if (line == std::string::npos || line > 100) return 0;
  const std::string text = input.substr(line + 1);
  if (adf::is_urdf(text)) return 0;  // a process for each of thousands of texts
  adf::Options options;
  options.look_for_files = false;

  const adf::ModelResult read = adf::parse_model(text, "here/fuzz.yaml", options);
  adf::SaveOrder order{text, "here/fuzz.yaml", "here/fuzz.yaml", nullptr, {}};
  const adf::SavedModel same = adf::save_model(order, options);
  require(same.text.has_value() == read.model.has_value());
  require(same.text ? *same.text == text : base::has_errors(same.diagnostics));
  if (!read.model) return 0;

  scene::Model left = *read.model;
  left.bodies.clear();
  std::string orders = input.substr(0, line);
  if (orders.starts_with('/')) {
    order.to = "there/fuzz.yaml";
    orders.erase(0, 1);
  }
  for (std::size_t i = 0; i < read.model->bodies.size(); ++i) {
    const scene::Body& body = read.model->bodies[i];
    const char letter = i < orders.size() ? orders[i] : '-';
    if (letter == 'r') continue;
    left.bodies.push_back(body);
    if (letter != '-') order.present.bodies.push_back({body.identity.identifier, moved(body.T_world_body, letter)});
  }
  order.left = &left;
  const adf::SavedModel saved = adf::save_model(order, options);
  require(saved.text.has_value() || base::has_errors(saved.diagnostics));
  for (const base::Diagnostic& diagnostic : saved.diagnostics) require(!base::to_string(diagnostic).empty());
  if (!saved.text) return 0;
  const adf::ModelResult again = adf::parse_model(*saved.text, order.to, options);
  require(again.model.has_value() && again.model->bodies.size() <= read.model->bodies.size());
  // What was saved is saved again without a change.
  const adf::SavedModel twice = adf::save_model({*saved.text, order.to, order.to, nullptr, {}}, options);
  require(twice.text && *twice.text == *saved.text);
  return 0;
}
