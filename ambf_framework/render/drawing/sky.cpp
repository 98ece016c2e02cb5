#include "render/drawing/sky.h"

#include <algorithm>

namespace ambf::render {

namespace {

constexpr int kLargestSide = 4096, kSoftwareLargestSide = 1024;

std::array<const std::string*, 6> files_of(const state::Skybox& sky) {
  return {&sky.right, &sky.left, &sky.top, &sky.bottom, &sky.front, &sky.back};
}

base::Diagnostic warning(const std::string& file, std::string message, std::string hint) {
  base::Diagnostic finding;
  finding.severity = base::Severity::warning;
  finding.file = file;
  finding.message = std::move(message);
  finding.hint = std::move(hint);
  return finding;
}

float brightness(const LinearColor& c) { return 0.2126F * c[0] + 0.7152F * c[1] + 0.0722F * c[2]; }

// The sky's hue at the brightness of the plain surroundings: a night sky must not hide what is simulated.
LinearColor tinted(const LinearColor& plain, const LinearColor& sky) {
  const float of_sky = brightness(sky);
  if (of_sky < 1e-4F) return plain;
  LinearColor out;
  for (std::size_t c = 0; c < 3; ++c) out[c] = 0.5F * (plain[c] + sky[c] * brightness(plain) / of_sky);
  return out;
}

}  // namespace

Sky::Sky(const Gl& gl) : gl_(gl), loader_(draws_in_software(gl) ? kSoftwareLargestSide : kLargestSide) {}

base::Diagnostics Sky::take(const state::Skybox& skybox) {
  const auto wanted = files_of(skybox), known = files_of(asked_);
  const bool same = std::equal(wanted.begin(), wanted.end(), known.begin(),
                               [](const std::string* a, const std::string* b) { return *a == *b; });
  if (!same) {
    asked_ = skybox;
    pictures_.clear();
    texture_ = GlTexture();
    user_texture_ = GlTexture();
    surroundings_ = {};
    if (skybox.given()) {
      for (const std::string* file : wanted) {
        if (pictures_.try_emplace(*file).second) loader_.ask({*file, TextureUse::sky});
      }
    }
  }
  return pictures_.empty() ? base::Diagnostics() : collect();
}

base::Diagnostics Sky::finish() {
  loader_.wait();
  return pictures_.empty() ? base::Diagnostics() : collect();
}

base::Diagnostics Sky::collect() {
  base::Diagnostics findings;
  for (Decoded& decoded : loader_.take_finished()) {
    const auto wanted = pictures_.find(decoded.key.file);
    if (wanted == pictures_.end()) continue;  // of an earlier skybox
    if (decoded.levels.empty()) {
      findings.push_back(warning(decoded.key.file, "picture of the skybox cannot be read: " + decoded.why,
                                 "there is no skybox; convert the picture to PNG or JPEG"));
      pictures_.clear();
      return findings;
    }
    wanted->second = std::move(decoded);
  }
  const auto missing = [](const auto& entry) { return entry.second.levels.empty(); };
  if (std::any_of(pictures_.begin(), pictures_.end(), missing)) return findings;
  const Image& first = pictures_.at(asked_.right).levels.front();
  for (const auto& [file, picture] : pictures_) {
    const Image& image = picture.levels.front();
    if (image.width == image.height && image.width == first.width) continue;
    findings.push_back(warning(file, "the pictures of a skybox must be square and of one size",
                               "there is no skybox; scale the six pictures alike"));
    pictures_.clear();
    return findings;
  }
  texture_ = upload(false);
  if (asked_.shaders.given()) user_texture_ = upload(true);
  LinearColor side{}, top{}, bottom{};
  const auto add = [&](const std::string& file, float weight, LinearColor& sum) {
    const Image& texel = pictures_.at(file).levels.back();  // all of it in one
    for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * linear_from_srgb(static_cast<float>(texel.rgba[c]) / 255.0F);
  };
  for (const std::string* file : {&asked_.right, &asked_.left, &asked_.front, &asked_.back}) add(*file, 0.125F, side);
  add(asked_.top, 0.5F, top);
  add(asked_.bottom, 0.5F, bottom);
  for (std::size_t c = 0; c < 3; ++c) {
    top[c] += side[c];
    bottom[c] += side[c];
  }
  surroundings_ = {tinted(Surroundings().up, top), tinted(Surroundings().down, bottom)};
  pictures_.clear();
  return findings;
}

GlTexture Sky::upload(bool for_users) const {
  GlTexture texture(gl_);
  gl_.BindTexture(GL_TEXTURE_CUBE_MAP, texture.name());
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  auto files = files_of(asked_);  // at +x, -x, +y, -y, +z, -z
  if (for_users) std::swap(files[2], files[3]);
  for (std::size_t face = 0; face < 6; ++face) {
    GLint level = 0;
    for (Image image : pictures_.at(*files[face]).levels) {
      if (for_users) flip_rows(image);
      gl_.TexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), level++,
                     for_users ? GL_RGBA8 : GL_SRGB8_ALPHA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                     image.rgba.data());
    }
  }
  gl_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace ambf::render
