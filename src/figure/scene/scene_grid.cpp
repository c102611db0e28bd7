// Scenes on one sheet: row by row, with one legend, and one colour bar where all show the same field.
#include <iterator>
#include <list>

#include "figure/canvas/sheet.hpp"
#include "figure/door/drawing.hpp"
#include "figure/scene/stage.hpp"

namespace dotyk::figure {

namespace {

constexpr double gap = 0.8;  // between panels, em

// The scale of the panels whose field has colours, if there are several and all show the same one.
std::optional<ColourScale> common_scale(const std::vector<ScenePicture>& panels) {
  std::optional<ColourScale> common;
  const ScenePicture* first = nullptr;
  int several = 0;
  for (const ScenePicture& p : panels) {
    const ColourScale own = colour_scale(p, p.window ? std::optional(box_of(*p.window)) : std::nullopt);
    if (!own.shown || p.field_label.empty()) continue;
    if (first && (p.field_label != first->field_label || p.field_unit != first->field_unit || p.field_signed != first->field_signed || p.field_range != first->field_range)) return std::nullopt;
    if (!first) first = &p, common = own;
    common->low = std::min(common->low, own.low), common->high = std::max(common->high, own.high);
    common->least = std::min(common->least, own.least), common->greatest = std::max(common->greatest, own.greatest);
    common->diverging = common->diverging || own.diverging;
    ++several;
  }
  return several > 1 ? common : std::nullopt;
}

class Rows {
public:
  explicit Rows(const SceneGrid& given) : sheet_(given), columns_(static_cast<std::size_t>(given.columns)), em_(letters(given)), panels_(given.panels), scale_(common_scale(panels_)) {
    if (scale_)
      for (ScenePicture& p : panels_)
        if (!p.field_label.empty()) p.field_range = {scale_->low, scale_->high}, p.field_signed = scale_->diverging;
    title_ = fitted(sheet_.title, 1.15 * em_, sheet_.width - em_, true);
    above_ = sheet_.title.empty() ? 0 : 1.9 * em_ + title_.depth();
    // The height of the legend depends on what the panels show, their height on that of the legend.
    for (int round = 0; round < 3; ++round) {
      const double missing = lay_out_panels();
      if (!(missing > 0)) continue;
      sheet_.height = std::min(std::max(sheet_.height, greatest_side), sheet_.height + static_cast<int>(std::ceil(missing * static_cast<double>(rows()))));
    }
    lay_out_panels();
  }

  void write() {
    Canvas canvas;
    canvas.text({sheet_.width / 2.0, sheet_.height - 0.6 * em_}, title_, title_style());
    legend_.draw(canvas, {(sheet_.width - legend_.width()) / 2, 0.2 * em_}, false);
    if (scale_) {
      const double bottom = legend_.height() + 0.5 * em_, top = sheet_.height - above_ - 0.5 * em_, half = std::min((top - bottom) / 2, 11 * em_);
      const double left = sheet_.width - bar_width() - 0.3 * em_, middle = (top + bottom) / 2;
      draw_colour_bar(canvas, *scale_, field_of(shown()), em_, {left, middle - half, sheet_.width - 0.3 * em_, middle + half});
    }
    std::vector<Painted> parts;
    for (Stage& stage : stages_) std::ranges::move(painted(stage), std::back_inserter(parts));
    parts.push_back({{}, {}, {}, std::move(canvas)});
    write_picture(sheet_, parts);
  }

private:
  std::size_t rows() const { return (panels_.size() + columns_ - 1) / columns_; }
  const ScenePicture& shown() const {
    return *std::ranges::find_if(panels_, [](const ScenePicture& p) { return !p.field_label.empty(); });
  }
  double bar_width() const { return scale_ ? colour_bar_width(*scale_, field_of(shown()), em_) : 0; }

  // Returns the pixels of height that a panel lacks at most.
  double lay_out_panels() {
    const double bar = scale_ ? bar_width() + 0.8 * em_ : 0, spacing = gap * em_;
    const double wide = (sheet_.width - bar - spacing * static_cast<double>(columns_ - 1)) / static_cast<double>(columns_);
    const double high = (sheet_.height - above_ - legend_.height()) / static_cast<double>(rows());
    stages_.clear();
    double missing = 0;
    std::vector<LegendEntry> entries;
    for (std::size_t i = 0; i < panels_.size(); ++i) {
      ScenePicture& p = panels_[i];
      p.file = sheet_.file, p.width = static_cast<int>(wide), p.height = static_cast<int>(high);
      p.printed = printed_width(sheet_) * p.width / sheet_.width;
      const Point corner{std::floor(static_cast<double>(i % columns_) * (wide + spacing)), std::floor(sheet_.height - above_ - high * static_cast<double>(i / columns_ + 1))};
      Stage& stage = stages_.emplace_back(p, corner);
      stage.own_bar = !scale_, stage.own_legend = false;
      missing = std::max(missing, lay_out(stage));
      for (const LegendEntry& entry : stage.entries)
        if (std::ranges::none_of(entries, [&](const LegendEntry& other) { return other.name == entry.name; })) entries.push_back(entry);
    }
    legend_ = Legend(std::move(entries), small_text * em_, sheet_.width - em_);
    return missing;
  }

  SceneGrid sheet_;
  std::size_t columns_;
  double em_, above_ = 0;
  std::vector<ScenePicture> panels_;
  std::optional<ColourScale> scale_;
  FittedText title_;
  Legend legend_{{}, 1};
  std::list<Stage> stages_;
};

}  // namespace

void render(const SceneGrid& grid) { Rows(grid).write(); }

}  // namespace dotyk::figure
