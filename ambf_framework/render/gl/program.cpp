#include "render/gl/program.h"

namespace ambf::render {

namespace {

GLuint compile(const Gl& gl, GLenum kind, const std::string& source, std::string& why) {
  const GLuint shader = gl.CreateShader(kind);
  const char* text = source.c_str();
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  GLint good = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good != 0) return shader;
  char log[2048] = "";
  gl.GetShaderInfoLog(shader, sizeof log, nullptr, log);
  why = std::string(kind == GL_VERTEX_SHADER ? "vertex" : "fragment") + " shader: " + log;
  gl.DeleteShader(shader);
  return 0;
}

}  // namespace

Program::~Program() {
  if (program_ != 0) gl_->DeleteProgram(program_);
}

bool Program::build(const Gl& gl, const std::string& vertex, const std::string& fragment,
                    const std::vector<const char*>& attributes, std::string& why) {
  gl_ = &gl;
  const GLuint vertex_shader = compile(gl, GL_VERTEX_SHADER, vertex, why);
  if (vertex_shader == 0) return false;
  const GLuint fragment_shader = compile(gl, GL_FRAGMENT_SHADER, fragment, why);
  if (fragment_shader == 0) {
    gl.DeleteShader(vertex_shader);
    return false;
  }
  program_ = gl.CreateProgram();
  gl.AttachShader(program_, vertex_shader);
  gl.AttachShader(program_, fragment_shader);
  GLuint index = 0;
  for (const char* attribute : attributes) gl.BindAttribLocation(program_, index++, attribute);
  gl.LinkProgram(program_);
  gl.DeleteShader(vertex_shader);
  gl.DeleteShader(fragment_shader);
  GLint good = 0;
  gl.GetProgramiv(program_, GL_LINK_STATUS, &good);
  if (good != 0) return true;
  char log[2048] = "";
  gl.GetProgramInfoLog(program_, sizeof log, nullptr, log);
  why = std::string("linking shaders: ") + log;
  return false;
}

std::vector<std::pair<std::string, GLenum>> Program::samplers() const {
  std::vector<std::pair<std::string, GLenum>> found;
  GLint count = 0;
  gl_->GetProgramiv(program_, GL_ACTIVE_UNIFORMS, &count);
  for (GLint i = 0; i < count; ++i) {
    char name[256] = "";
    GLint size = 0;
    GLenum type = 0;
    gl_->GetActiveUniform(program_, static_cast<GLuint>(i), sizeof name, nullptr, &size, &type, name);
    if (type == GL_SAMPLER_2D || type == GL_SAMPLER_2D_SHADOW || type == GL_SAMPLER_CUBE || type == GL_SAMPLER_3D) {
      found.emplace_back(name, type);
    }
  }
  return found;
}

GLint Program::location(const char* name) {
  const auto known = locations_.find(std::string_view(name));
  if (known != locations_.end()) return known->second;
  const GLint location = gl_->GetUniformLocation(program_, name);
  locations_.emplace(name, location);
  return location;
}

}  // namespace ambf::render
