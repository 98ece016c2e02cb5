// A linked shader program and its uniforms by name. Main thread, context current. Private to render/.
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "render/camera/matrix.h"
#include "render/gl/detail/functions.h"

namespace ambf::render {

class Program {
 public:
  Program() = default;
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  // Attribute i is bound to attributes[i]. False with the compiler's words in `why`.
  bool build(const Gl& gl, const std::string& vertex, const std::string& fragment,
             const std::vector<const char*>& attributes, std::string& why);
  // Those that it reads, with their types.
  std::vector<std::pair<std::string, GLenum>> samplers() const;

  void use() const { gl_->UseProgram(program_); }

  // Of the program in use. A name the compiler dropped is ignored.
  void set(const char* name, int value) { gl_->Uniform1i(location(name), value); }
  void set(const char* name, float value) { gl_->Uniform1f(location(name), value); }
  void set(const char* name, float x, float y) { gl_->Uniform2f(location(name), x, y); }
  void set(const char* name, float x, float y, float z) { gl_->Uniform3f(location(name), x, y, z); }
  void set(const char* name, float x, float y, float z, float w) { gl_->Uniform4f(location(name), x, y, z, w); }
  void set(const char* name, const std::array<float, 9>& matrix) {
    gl_->UniformMatrix3fv(location(name), 1, GL_FALSE, matrix.data());
  }
  void set(const char* name, const Mat4& value) { gl_->UniformMatrix4fv(location(name), 1, GL_FALSE, value.m.data()); }

 private:
  GLint location(const char* name);

  const Gl* gl_ = nullptr;
  GLuint program_ = 0;
  std::map<std::string, GLint, std::less<>> locations_;
};

}  // namespace ambf::render
