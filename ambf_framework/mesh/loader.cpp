#include "mesh/loader.h"

#include <algorithm>
#include <exception>
#include <new>

#include "mesh/formats/read_context.h"
#include "mesh/formats/text.h"

namespace ambf::mesh {

namespace {

Format format_of_ending(const std::string& path) {
  const std::size_t dot = path.find_last_of("./");
  const std::string_view ending =
      dot == std::string::npos || path[dot] == '/' ? std::string_view() : std::string_view(path).substr(dot + 1);
  if (equal_ignoring_case(ending, "stl")) return Format::stl;
  if (equal_ignoring_case(ending, "obj")) return Format::obj;
  if (equal_ignoring_case(ending, "ply")) return Format::ply;
  if (equal_ignoring_case(ending, "3ds")) return Format::threeds;
  if (equal_ignoring_case(ending, "dae")) return Format::collada;
  return Format::unknown;
}

// What the content says for certain; unknown otherwise (an OBJ has no mark, an ascii STL shares "solid" with names).
Format format_of_content(std::string_view bytes) {
  const std::string_view start = trim(bytes.substr(0, 1024));
  if (bytes.substr(0, 4) == "ply\n" || bytes.substr(0, 4) == "ply\r") return Format::ply;
  if (start.find("<COLLADA") != std::string_view::npos) return Format::collada;
  if (bytes.size() >= 84) {
    const auto byte = [&bytes](std::size_t i) {
      return static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i]));
    };
    const std::uint64_t count = byte(80) | byte(81) << 8 | byte(82) << 16 | byte(83) << 24;
    if (bytes.size() == 84 + 50 * count) return Format::stl;
  }
  if (starts_with_ignoring_case(start, "solid") && start.find("facet") != std::string_view::npos) return Format::stl;
  if (bytes.size() >= 6 && bytes.substr(0, 2) == "MM") {
    const auto byte = [&bytes](std::size_t i) {
      return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i]));
    };
    if ((byte(2) | byte(3) << 8 | byte(4) << 16 | byte(5) << 24) == bytes.size()) return Format::threeds;
  }
  return Format::unknown;
}

void choose_format(const std::string& path, std::string_view bytes, ReadContext& context, LoadResult& result) {
  const Format named = format_of_ending(path), found = format_of_content(bytes);
  result.format = found == Format::unknown ? named : found;
  if (found != Format::unknown && named != found) {
    context.warn(std::string("the file is ") + to_string(found) +
                     " by its content, but its name does not end so; it is read as " + to_string(found),
                 "rename the file");
  }
}

bool read(std::string_view bytes, ReadContext& context, Format format, RawMesh& raw) {
  switch (format) {
    case Format::stl: return read_stl(bytes, context, raw);
    case Format::obj: return read_obj(bytes, context, raw);
    case Format::ply: return read_ply(bytes, context, raw);
    case Format::threeds: return read_3ds(bytes, context, raw);
    case Format::collada: return read_collada(bytes, context, raw);
    case Format::unknown: break;
  }
  return context.fail("unknown kind of mesh file: expected a name that ends in .stl, .obj, .ply, .3ds or .dae",
                      "convert the mesh to one of these formats");
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
    choose_format(path, bytes, context, result);
    RawMesh raw;
    if (bytes.empty()) {
      context.fail("the file is empty", "export the mesh again");
      return result;
    }
    if (!read(bytes, context, result.format, raw)) return result;
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
