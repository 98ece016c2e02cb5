#include "render/window/help_card.h"

#include <algorithm>
#include <cmath>

#include "render/window/overlay.h"

namespace ambf::render {

namespace {

constexpr double kPad = 10.0, kColumnGap = 28.0, kNameGap = 14.0;  // px at scale 1
constexpr double kShrinks[] = {1.0, 0.9, 0.8, 0.7, 0.6};           // the last is a line of 10 pixels at density 1

struct Measures {
  explicit Measures(double scale)
      : margin(std::round(kOverlayMargin_px * scale)),
        pad(std::round(kPad * scale)),
        line(std::round(1.15 * Lettering::line_height(scale))),
        column_gap(std::round(kColumnGap * scale)),
        name_gap(std::round(kNameGap * scale)) {}
  double margin, pad, line, column_gap, name_gap;
};

struct Column {
  double name = 0.0, text = 0.0;  // px
};

std::vector<Column> columns_of(const std::vector<HelpLine>& table, std::size_t rows, const Lettering& letters) {
  std::vector<Column> columns((table.size() + rows - 1) / rows);
  for (std::size_t i = 0; i < table.size(); ++i) {
    Column& column = columns[i / rows];
    column.name = std::max(column.name, std::ceil(letters.width(table[i].name, letters.scale())));
    column.text = std::max(column.text, std::ceil(letters.width(table[i].text, letters.scale())));
  }
  return columns;
}

double width_of(const std::vector<Column>& columns, std::size_t first, std::size_t count, const Measures& sizes) {
  double wide = 2 * sizes.pad - sizes.column_gap;
  for (std::size_t i = first; i < std::min(first + count, columns.size()); ++i) {
    wide += columns[i].name + sizes.name_gap + columns[i].text + sizes.column_gap;
  }
  return wide;
}

// Lines of a column; the last one of the picture is kept free for which page this is.
std::size_t rows_of(int height_px, const Measures& sizes) {
  const double room = (height_px - 2 * sizes.margin - 2 * sizes.pad) / sizes.line;
  return static_cast<std::size_t>(std::max(3.0, room)) - 1;
}

}  // namespace

HelpLayout help_layout(const std::vector<HelpLine>& table, int width_px, int height_px, double density) {
  HelpLayout layout;
  for (const double shrink : kShrinks) {
    layout.scale = density * shrink;
    const Measures sizes(layout.scale);
    const Lettering letters(layout.scale);
    const std::size_t most = rows_of(height_px, sizes);
    const std::size_t all_columns = (table.size() + most - 1) / most;
    layout.rows = (table.size() + all_columns - 1) / all_columns;
    std::vector<Column> columns = columns_of(table, layout.rows, letters);
    const double room = width_px - 2 * sizes.margin;
    layout.columns = columns.size();
    layout.pages = 1;
    if (width_of(columns, 0, columns.size(), sizes) <= room) return layout;
    layout.rows = most;
    columns = columns_of(table, most, letters);
    const auto fit = [&](std::size_t count) {
      for (std::size_t first = 0; first < columns.size(); first += count) {
        if (width_of(columns, first, count, sizes) > room) return false;
      }
      return true;
    };
    layout.columns = columns.size();
    while (layout.columns > 1 && !fit(layout.columns)) --layout.columns;
    layout.pages = (columns.size() + layout.columns - 1) / layout.columns;
  }
  return layout;
}

void HelpCard::turn() { page_ = page_ > 0 && page_ >= layout_.pages ? 0 : page_ + 1; }

const TextDrawing* HelpCard::drawing(int width_px, int height_px, double density) {
  if (page_ == 0) return nullptr;
  const bool other_size =
      !drawing_ || drawing_->width() != width_px || drawing_->height() != height_px || density != density_;
  if (other_size) layout_ = help_layout(help_table(), width_px, height_px, density);
  density_ = density;
  page_ = std::min(page_, layout_.pages);
  if (other_size || drawn_page_ != page_) draw(width_px, height_px);
  drawn_page_ = page_;
  return &*drawing_;
}

void HelpCard::draw(int width_px, int height_px) {
  const double scale = layout_.scale;
  const bool same_letters = drawing_ && drawing_->letters()->scale() == scale;
  const std::shared_ptr<const Lettering> letters =
      same_letters ? drawing_->letters() : std::make_shared<const Lettering>(scale);
  drawing_.emplace(letters, width_px, height_px);
  const Measures sizes(scale);
  const std::vector<HelpLine> table = help_table();
  const std::vector<Column> columns = columns_of(table, layout_.rows, *letters);
  const std::size_t first = (page_ - 1) * layout_.columns, last = std::min(first + layout_.columns, columns.size());
  const bool pages = layout_.pages > 1;
  const double wide = width_of(columns, first, layout_.columns, sizes);
  const double tall = static_cast<double>(layout_.rows + (pages ? 1 : 0)) * sizes.line + 2 * sizes.pad;
  drawing_->card(sizes.margin, sizes.margin, wide, tall, kOverlayPaper, scale);
  double x = sizes.margin + sizes.pad;
  for (std::size_t c = first; c < last; ++c) {
    for (std::size_t row = 0; row < layout_.rows && c * layout_.rows + row < table.size(); ++row) {
      const HelpLine& line = table[c * layout_.rows + row];
      const double y = sizes.margin + sizes.pad + static_cast<double>(row) * sizes.line;
      drawing_->text(x, y, line.name, kOverlayAccent, scale);
      drawing_->text(x + columns[c].name + sizes.name_gap, y, line.text, kOverlayInk, scale);
    }
    x += columns[c].name + sizes.name_gap + columns[c].text + sizes.column_gap;
  }
  if (!pages) return;
  const std::string more = "page " + std::to_string(page_) + " of " + std::to_string(layout_.pages) + ": H turns over";
  drawing_->text(sizes.margin + sizes.pad, sizes.margin + sizes.pad + static_cast<double>(layout_.rows) * sizes.line,
                 more, kOverlayAccent, scale);
}

}  // namespace ambf::render
