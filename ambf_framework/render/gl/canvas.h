// What a picture is drawn into: colour and depth with several samples a pixel where the machine offers them, in
// memory of our own so that windows, tests and files get the same picture. One a context. Main thread. Private to
// render/.
#pragma once

#include <string>

#include "render/gl/handle.h"
#include "render/images/image_file.h"

namespace ambf::render {

class Canvas {
 public:
  explicit Canvas(const Gl& gl) : gl_(gl) {}

  // Makes it so large, with up to so many samples. False with the reason in `why`.
  bool resize(int width, int height, int samples, std::string& why);
  void bind() const;  // draws go here
  // Part of a framebuffer, px.
  struct Place {
    int left = 0, bottom = 0, width = 0, height = 0;
  };
  // Copies the picture into the framebuffer `target`, stretched where the place has another size (not with several
  // samples).
  void resolve_to(GLuint target, const Place& place) const;
  void resolve_mirrored_to(GLuint target, const Place& place);  // the same upside down
  void show_to_read();  // binds the finished picture for reading: RGBA, 8 bits a channel
  Image read();         // rows from top to bottom
  // The depths drawn so far, one a pixel, as a texture to be read. Leaves the canvas bound.
  GLuint depth_texture();

  int width() const { return width_; }
  int height() const { return height_; }
  int samples() const { return samples_; }

 private:
  bool attach(GlFramebuffer& framebuffer, GlRenderbuffer& color, GlRenderbuffer* depth, int samples, std::string& why);

  const Gl& gl_;
  int width_ = 0, height_ = 0, wanted_samples_ = 0, samples_ = 0;
  GlFramebuffer framebuffer_, single_framebuffer_;
  GlRenderbuffer color_, depth_, single_color_;
  GlFramebuffer depth_framebuffer_;
  GlTexture depth_texture_;  // made when first asked for
};

}  // namespace ambf::render
