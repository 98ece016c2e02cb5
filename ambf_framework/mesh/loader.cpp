#include "mesh/loader.h"

#include <exception>
#include <new>

#include "mesh/formats/detail/read_by_worker.h"
#include "mesh/formats/detail/recognise.h"
#include "mesh/formats/read_context.h"

namespace ambf::mesh {

namespace {

bool read_by_ours(std::string_view bytes, ReadContext& context, Format format, RawMesh& raw) {
  switch (format) {
    case Format::stl: return read_stl(bytes, context, raw);
    case Format::obj: return read_obj(bytes, context, raw);
    case Format::ply: return read_ply(bytes, context, raw);
    case Format::threeds: return read_3ds(bytes, context, raw);
    case Format::collada: return read_collada(bytes, context, raw);
    case Format::imported:
    case Format::unknown: break;
  }
  return false;
}

bool refuse_unknown(const Recognised& kind, ReadContext& context) {
  const std::string what =
      kind.refused_as.empty()
          ? "unknown kind of mesh file"
          : "files that end in ." + kind.ending + " are not read as meshes: such a file may be " + kind.refused_as;
  return context.fail(what +
                          ": expected a name that ends in .stl, .obj, .ply, .3ds, .dae, .gltf, .glb, .fbx, .3mf, "
                          ".x3d, .off or .amf",
                      "convert the mesh to one of these formats");
}

// What our reader does not understand, assimp may: it is more lenient.
bool read_by_either(std::string_view bytes, ReadContext& context, const Recognised& kind, RawMesh& raw) {
  std::string problem, hint;
  if (kind.format == Format::imported) {
    return read_by_worker(bytes, kind.ending, context, raw, problem, hint) || context.fail(problem, hint);
  }
  if (read_by_ours(bytes, context, kind.format, raw)) return true;
  if (!context.options().second_reader) return false;
  int line = 0;
  const std::string ours = context.withdraw_syntax_error(line);
  if (ours.empty()) return false;
  raw = RawMesh{};
  if (!read_by_worker(bytes, kind.ending, context, raw, problem, hint)) {
    return context.fail(ours, "export the mesh again; a second reader could not read it either: " + problem, line);
  }
  context.warn("our reader of " + kind.name + " files refused the file: " + ours + "; assimp's reader was used instead",
               "check the picture of the mesh, or export it again", line);
  return true;
}

// `bytes` are given back to the system before the mesh is built, which halves what a large file needs.
LoadResult load_and_release(std::string& bytes, const std::string& path, const LoadOptions& options) {
  LoadResult result;
  ReadContext context(path, options, result);
  try {
    if (bytes.size() > options.max_file_bytes) {
      context.fail("the file has " + std::to_string(bytes.size()) + " bytes, at most " +
                       std::to_string(options.max_file_bytes) + " are read",
                   "reduce (decimate) the mesh or use a binary format");
      return result;
    }
    const Recognised kind = recognise(path, bytes);
    result.format = kind.format;
    if (bytes.empty()) {
      context.fail("the file is empty", "export the mesh again");
      return result;
    }
    if (kind.format == Format::unknown) {
      refuse_unknown(kind, context);
      return result;
    }
    if (!kind.as_named) {
      context.warn(
          "the file is " + kind.name + " by its content, but its name does not end so; it is read as " + kind.name,
          "rename the file");
    }
    RawMesh raw;
    if (!read_by_either(bytes, context, kind, raw)) return result;
    std::string().swap(bytes);
    result.ok = build_mesh(std::move(raw), context, result.mesh);
  } catch (const std::bad_alloc&) {
    context.fail("there is not enough memory for this mesh", "reduce (decimate) the mesh");
    result.ok = false;
  } catch (const std::exception& error) {
    // Not expected from our readers: said rather than hidden.
    context.fail(std::string("reading failed: ") + error.what(), "please report this file");
    result.ok = false;
  }
  if (!result.ok) result.mesh = Mesh{};
  return result;
}

}  // namespace

const char* to_string(Format format) {
  switch (format) {
    case Format::stl: return "STL";
    case Format::obj: return "OBJ";
    case Format::ply: return "PLY";
    case Format::threeds: return "3DS";
    case Format::collada: return "COLLADA";
    case Format::imported: return "imported";
    case Format::unknown: break;
  }
  return "unknown";
}

LoadResult load(const std::string& path, const LoadOptions& options) {
  std::string bytes, why, hint;
  try {
    if (read_whole_file(path, options.max_file_bytes, bytes, why, hint)) return load_and_release(bytes, path, options);
  } catch (const std::bad_alloc&) {
    why = "there is not enough memory for this file";
    hint = "reduce (decimate) the mesh";
  }
  LoadResult result;
  result.diagnostics.push_back({base::Severity::error, path, 0, 0, "", "", why, hint});
  return result;
}

LoadResult load_bytes(std::string bytes, const std::string& path, const LoadOptions& options) {
  return load_and_release(bytes, path, options);
}

}  // namespace ambf::mesh
