#include "render/marks/label_layout.h"

#include <algorithm>
#include <cmath>

namespace ambf::render {

namespace {

constexpr double kPadding_px = 5.0, kAway_px = 10.0;  // of the paper around the words; from the point to the paper
constexpr double kGone_px = 4.0, kPlain_px = 18.0;    // sizes in the picture at which a label is gone, and full
constexpr float kFaintest = 0.15F;

struct Candidate {
  const DebugText* text = nullptr;
  double x_px = 0.0, y_px = 0.0, depth = 0.0, clear_px = 0.0;
  float alpha = 1.0F;
};

bool overlap(const Label& a, const Label& b) {
  return a.left_px < b.left_px + b.width_px && b.left_px < a.left_px + a.width_px &&
         a.top_px < b.top_px + b.height_px && b.top_px < a.top_px + a.height_px;
}

std::vector<Candidate> seen_of(const std::vector<DebugText>& texts, const Camera& camera, int width_px, int height_px,
                               double ui_scale) {
  const double aspect = static_cast<double>(width_px) / height_px;
  const Mat4 projection = projection_matrix(camera, aspect);
  const Mat4 world_to_clip = projection * view_matrix(camera.T_world_camera);
  const double focal_px = 0.5 * height_px * projection.m[5];  // of what is at w = 1
  std::vector<Candidate> seen;
  for (const DebugText& text : texts) {
    const auto clip = transform(world_to_clip, text.point);
    if (clip[3] < 1e-6 || std::abs(clip[0]) > clip[3] || std::abs(clip[1]) > clip[3] || std::abs(clip[2]) > clip[3]) {
      continue;
    }
    Candidate candidate{&text, 0.5 * (1.0 + clip[0] / clip[3]) * width_px, 0.5 * (1.0 - clip[1] / clip[3]) * height_px,
                        clip[2] / clip[3]};
    candidate.clear_px = text.clear_m * focal_px / clip[3];
    if (text.size_m > 0.0) {
      const double size_px = text.size_m * focal_px / clip[3] / ui_scale;
      candidate.alpha = static_cast<float>(std::clamp((size_px - kGone_px) / (kPlain_px - kGone_px), 0.0, 1.0));
      if (candidate.alpha < kFaintest) continue;
    }
    seen.push_back(candidate);
  }
  return seen;
}

}  // namespace

std::vector<Label> lay_out(const std::vector<DebugText>& texts, const Camera& camera, int width_px, int height_px,
                           const Lettering& letters) {
  const double ui_scale = letters.scale();
  std::vector<Candidate> seen = seen_of(texts, camera, width_px, height_px, ui_scale);
  std::stable_sort(seen.begin(), seen.end(), [](const Candidate& a, const Candidate& b) {
    const bool a_must = a.text->size_m <= 0.0, b_must = b.text->size_m <= 0.0;
    return a_must != b_must ? a_must : a.depth < b.depth;
  });
  std::vector<Label> placed;
  for (const Candidate& candidate : seen) {
    Label label;
    label.text = candidate.text;
    label.alpha = candidate.alpha;
    label.width_px = std::ceil(letters.width(candidate.text->text, ui_scale) + 2 * ui_scale * kPadding_px);
    label.height_px = Lettering::line_height(ui_scale);
    const double away = ui_scale * kAway_px + candidate.clear_px;
    const double places[][2] = {{candidate.x_px - 0.5 * label.width_px, candidate.y_px - away - label.height_px},
                                {candidate.x_px + away, candidate.y_px - 0.5 * label.height_px},
                                {candidate.x_px - away - label.width_px, candidate.y_px - 0.5 * label.height_px},
                                {candidate.x_px - 0.5 * label.width_px, candidate.y_px + away}};
    bool free = false;
    for (const auto& place : places) {
      // Whole pixels, within the picture.
      label.left_px = std::round(std::clamp(place[0], 0.0, std::max(0.0, width_px - label.width_px)));
      label.top_px = std::round(std::clamp(place[1], 0.0, std::max(0.0, height_px - label.height_px)));
      free = std::none_of(placed.begin(), placed.end(), [&](const Label& other) { return overlap(label, other); });
      if (free) break;
    }
    if (free || candidate.text->size_m <= 0.0) placed.push_back(label);
  }
  return placed;
}

void draw_labels(const std::vector<Label>& labels, TextDrawing& drawing) {
  const double ui_scale = drawing.letters()->scale();
  constexpr TextColor kPaper = {0.08F, 0.10F, 0.13F, 0.62F};
  for (auto label = labels.rbegin(); label != labels.rend(); ++label) {  // the near over the far
    TextColor paper = kPaper, ink = label->text->color;
    paper[3] *= label->alpha;
    ink[3] *= label->alpha;
    drawing.card(label->left_px, label->top_px, label->width_px, label->height_px, paper, ui_scale);
    drawing.text(label->left_px + std::round(ui_scale * kPadding_px), label->top_px, label->text->text, ink, ui_scale);
  }
}

}  // namespace ambf::render
