#include "mesh/formats/detail/read_by_worker.h"

#include <cstdio>
#include <memory>
#include <set>

#include "base/hash.h"
#include "base/worker.h"
#include "mesh/formats/reader_answer.h"
#include "mesh/formats/text.h"

namespace ambf::mesh {

namespace {

// The name contains a hash of the bytes: caches by name notice that the file changed.
std::string name_within(const std::string& path, const std::string& place, const std::string& bytes) {
  base::Fnv1a hash;
  hash.add_bytes(bytes.data(), bytes.size());
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash.value()));
  return path + place + "-" + digits;
}

// Names in the answer become files beside the mesh, or pictures that the mesh itself holds.
void resolve_textures(ReaderAnswer& answer, ReadContext& context) {
  RawMesh& raw = answer.raw;
  for (Material& m : raw.materials) {
    for (std::string* file : {&m.texture_file, &m.normal_map_file}) {
      if (file->empty()) continue;
      if (file->front() != '*') {
        *file = context.find_texture(*file, context.path());
        continue;
      }
      std::string& bytes = answer.pictures[std::stoul(file->substr(1))];
      *file = name_within(context.path(), *file, bytes);
      if (raw.pictures.count(*file) == 0) raw.pictures[*file] = std::make_shared<const std::string>(bytes);
    }
  }
}

}  // namespace

bool read_by_worker(std::string_view bytes, const std::string& ending, ReadContext& context, RawMesh& out,
                    std::string& out_problem, std::string& out_hint) {
  const LoadOptions& options = context.options();
  base::WorkerCall call;
  call.program =
      options.worker_program.empty() ? base::program_beside_library("ambf_file_reader") : options.worker_program;
  call.limits.silence_s = options.worker_silence_s;
  call.file = [&context](const std::string& name) -> std::optional<std::string> {
    std::string path, content;
    if (!context.read_beside(name, path, content)) return std::nullopt;
    return content;
  };
  ReaderQuestion question;
  question.ending = ending;
  question.max_triangles = options.max_triangles;
  question.max_vertices = options.max_vertices;
  question.bytes = bytes;
  base::WireWriter writer;
  writer.text("mesh");
  transfer_question(writer, question);
  question.bytes = {};

  base::WorkerAnswer reply = base::ask_worker(call, std::move(writer).bytes());
  out_hint = "convert the mesh to OBJ, STL or PLY";
  if (!reply.ok) {
    out_problem = "the reader of ." + ending + " files (assimp, in a process of its own) gave up: " + reply.problem;
    return false;
  }
  ReaderAnswer answer;
  base::WireReader reader(reply.bytes);
  transfer_answer(reader, answer);
  const std::string wrong =
      reader.at_end() ? check(answer, options.max_triangles, options.max_vertices) : std::string("sizes");
  if (!wrong.empty()) {
    out_problem = "the reader of ." + ending + " files (assimp, in a process of its own) answered nonsense: " + wrong;
    return false;
  }
  if (!answer.error.empty()) {
    out_problem = (answer.importer.empty() ? "assimp" : answer.importer + " (assimp)") + ": " + answer.error;
    return false;
  }
  if (answer.raw.faces.empty() && answer.raw.lines.empty()) {
    out_problem = answer.importer + " (assimp) finds no triangles and no lines in it";
    out_hint = "check that the exported selection is not empty";
    return false;
  }
  std::set<std::string> reported;
  for (const std::string& note : answer.warnings) {
    if (reported.insert(note).second) context.warn(note, "check the picture of the mesh, or export it again");
  }
  for (const std::string& note : answer.information) {
    if (reported.insert(note).second) context.inform(note);
  }
  resolve_textures(answer, context);
  out = std::move(answer.raw);
  return true;
}

}  // namespace ambf::mesh
