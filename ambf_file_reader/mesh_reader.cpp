#include "mesh_reader.h"

#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>

#include "assimp_files.h"
#include "file_names.h"
#include "scene_converter.h"
#include "units.h"

namespace ambf::file_reader {

namespace {

// assimp's warnings and errors: "Warn,  T0: text\n".
class Warnings : public Assimp::LogStream {
 public:
  explicit Warnings(std::vector<std::string>& out) : out_(out) {}
  void write(const char* message) override {
    constexpr std::size_t kMost = 20;
    std::string text(message);
    const std::size_t prefix = text.find(": ");
    if (prefix != std::string::npos && prefix < 16) text.erase(0, prefix + 2);
    text.erase(text.find_last_not_of(" \n\r") + 1);
    if (out_.size() < kMost && std::find(out_.begin(), out_.end(), text) == out_.end()) out_.push_back(text);
  }

 private:
  std::vector<std::string>& out_;
};

}  // namespace

mesh::ReaderAnswer read_mesh(const mesh::ReaderQuestion& question) {
  mesh::ReaderAnswer answer;
  Assimp::Importer importer;
  const std::size_t number = importer.GetImporterIndex(question.ending.c_str());
  if (number == static_cast<std::size_t>(-1)) {
    answer.error = "there is no importer for ." + question.ending + " files in this build of assimp";
    return answer;
  }
  answer.importer = importer.GetImporterInfo(number)->mName;
  Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
  Assimp::DefaultLogger::get()->attachStream(new Warnings(answer.warnings), Assimp::Logger::Warn);

  const std::string name = "file." + question.ending;
  const std::string bytes = question.ending == "x3d" ? with_plain_urls(question.bytes) : question.bytes;
  importer.SetIOHandler(new AssimpFiles(name, bytes));  // which the importer deletes
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, false);
  const aiScene* scene = importer.ReadFile(name, 0);
  if (scene == nullptr) {
    answer.error = importer.GetErrorString();
    if (answer.error.empty()) answer.error = "the file could not be read";
    return answer;
  }
  // assimp turns 3DS files so that y is up, in their root node.
  const bool skip_root = question.ending == "3ds" || question.ending == "prj";
  const Units units = units_of(question, *scene);
  if (!units.note.empty()) answer.information.push_back(units.note);
  SceneConverter(*scene, question, answer).convert(units.metres, skip_root);
  return answer;
}

}  // namespace ambf::file_reader
