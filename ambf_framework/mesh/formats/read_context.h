// Private to mesh/: what every reader is given and where it reports. A reader returns false after exactly one fail();
// warnings and information may precede it. Readers hold no state and know nothing of files: texture and library
// look-ups go through here.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "mesh/formats/raw_mesh.h"
#include "mesh/loader.h"

namespace ambf::mesh {

class ReadContext {
 public:
  ReadContext(const std::string& path, const LoadOptions& options, LoadResult& result);

  const std::string& path() const { return path_; }
  const LoadOptions& options() const { return options_; }

  bool fail(const std::string& message, const std::string& hint, int line = 0);  // always false
  void warn(const std::string& message, const std::string& hint, int line = 0);
  void inform(const std::string& message, const std::string& hint = {}, int line = 0);
  // As fail, warn and inform, about another file than the mesh itself.
  void warn_in(const std::string& file, const std::string& message, const std::string& hint, int line = 0);

  // As fail, of what the reader cannot make sense of, where another reader may do better.
  bool not_understood(const std::string& message, const std::string& hint, int line = 0);
  // Takes back the error of not_understood(), to be reported with another reader's. Empty: there was another error,
  // about damage or a limit, which holds for every reader.
  std::string withdraw_syntax_error(int& out_line);

  // Each false after fail() when one more would break the limit; `what` of the file so far.
  bool allow_triangles(std::size_t total, int line = 0);
  bool allow_vertices(std::size_t total, int line = 0);

  // The existing file that `name` (as written in the mesh file, perhaps with backslashes, of another machine, or in
  // other letter case) means, looked up beside the mesh. Empty and one warning per name when there is none.
  std::string find_texture(const std::string& name, const std::string& named_in, int line = 0);
  // Reads a library beside the mesh; false (no message) when it is not there or longer than the file limit.
  bool read_beside(const std::string& name, std::string& out_path, std::string& out_bytes);

 private:
  std::string find_beside(const std::string& name);

  std::string path_, folder_;
  const LoadOptions& options_;
  LoadResult& result_;
  bool not_understood_ = false;
  std::map<std::string, std::string> textures_;  // by name as written; value empty when missing
};

// Each false after context.fail(). The raw mesh has only valid indices and finite numbers on success.
bool read_stl(std::string_view bytes, ReadContext& context, RawMesh& out);
bool read_obj(std::string_view bytes, ReadContext& context, RawMesh& out);
bool read_ply(std::string_view bytes, ReadContext& context, RawMesh& out);
bool read_3ds(std::string_view bytes, ReadContext& context, RawMesh& out);
bool read_collada(std::string_view bytes, ReadContext& context, RawMesh& out);

// The whole of a regular file of at most `max_bytes`. On failure false and a sentence why (never blocks on pipes or
// devices).
bool read_whole_file(const std::string& path, std::size_t max_bytes, std::string& out_bytes, std::string& out_why,
                     std::string& out_hint);

}  // namespace ambf::mesh
