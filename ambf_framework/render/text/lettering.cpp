#include "render/text/lettering.h"

#include <imgui/imgui_internal.h>

#include <cfloat>
#include <cmath>

#include "render/text/fonts.h"

namespace ambf::render {

namespace {

constexpr double kLine_px = 17.0;  // height of a line at scale 1

}  // namespace

struct Lettering::Impl {
  ImFontAtlas atlas;
  ImDrawListSharedData shared;
  Texels texels{};
};

Lettering::Lettering(double scale) : scale_(scale), impl_(std::make_unique<Impl>()) {
  ImFontAtlas& atlas = impl_->atlas;
  atlas.Flags |= ImFontAtlasFlags_NoMouseCursors;
  ImFont* font = add_font(atlas, FontWeight::regular, static_cast<float>(line_height(scale)));
  unsigned char* bytes = nullptr;
  atlas.GetTexDataAsAlpha8(&bytes, &impl_->texels.width, &impl_->texels.height);  // builds it
  impl_->texels.bytes = bytes;
  ImDrawListSharedData& shared = impl_->shared;
  shared.Font = font;
  shared.FontSize = font->FontSize;
  shared.TexUvWhitePixel = atlas.TexUvWhitePixel;
  shared.TexUvLines = atlas.TexUvLines;
  shared.InitialFlags = ImDrawListFlags_AntiAliasedFill;
  shared.SetCircleTessellationMaxError(0.3F);
}

Lettering::~Lettering() = default;

double Lettering::width(const std::string& line, double scale) const {
  const auto size = static_cast<float>(line_height(scale));
  const char* begin = line.data();
  return static_cast<double>(impl_->shared.Font->CalcTextSizeA(size, FLT_MAX, 0.0F, begin, begin + line.size()).x);
}

double Lettering::line_height(double scale) { return std::round(kLine_px * scale); }

const ImDrawListSharedData& Lettering::shared() const { return impl_->shared; }

Lettering::Texels Lettering::texels() const { return impl_->texels; }

}  // namespace ambf::render
