// The font of text over a scene, rasterised for one screen density; measures text. Immutable once made: any thread.
#pragma once

#include <memory>
#include <string>

struct ImDrawListSharedData;

namespace ambf::render {

class Lettering {
 public:
  // `scale`: 2 on a high-density screen. Text of this scale is the sharpest.
  explicit Lettering(double scale);
  ~Lettering();
  Lettering(const Lettering&) = delete;
  Lettering& operator=(const Lettering&) = delete;

  double scale() const { return scale_; }
  double width(const std::string& line, double scale) const;  // px
  static double line_height(double scale);                    // px

  // For Dear ImGui's draw lists, and for the renderer: one byte a texel.
  const ImDrawListSharedData& shared() const;
  struct Texels {
    const unsigned char* bytes;
    int width, height;
  };
  Texels texels() const;

 private:
  struct Impl;
  const double scale_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ambf::render
