// Scenes on one sheet: row by row, with one legend, and one colour bar where all show the same field.
#include <iterator>
#include <list>
#include <map>
#include <numeric>
#include <set>

#include "base/error.hpp"
#include "figure/canvas/sheet.hpp"
#include "figure/door/drawing.hpp"
#include "figure/scene/stage.hpp"

namespace dotyk::figure {

namespace {

constexpr double gap = 0.8;  // between panels, em

// The scale of panels that show one field, if there are several and no range is given to some alone.
std::optional<ColourScale> common_scale(const std::vector<ScenePicture*>& panels) {
  std::optional<ColourScale> common;
  int several = 0;
  for (const ScenePicture* p : panels) {
    const ColourScale own = colour_scale(*p, p->window ? std::optional(box_of(*p->window)) : std::nullopt);
    if (p->field_range != panels.front()->field_range) return std::nullopt;
    if (!own.shown) continue;
    if (!common) common = own;
    common->low = std::min(common->low, own.low), common->high = std::max(common->high, own.high);
    common->least = std::min(common->least, own.least), common->greatest = std::max(common->greatest, own.greatest);
    common->diverging = common->diverging || own.diverging;
    ++several;
  }
  return several > 1 ? common : std::nullopt;
}

// Ordinates and arrows of the same length stand for the same in all panels.
void share_lengths(std::vector<ScenePicture>& panels) {
  std::array<double, 3> longest{};
  for (const ScenePicture& p : panels) {
    const Stage stage(p);
    longest = {std::max(longest[0], stage.greatest_pressure), std::max(longest[1], stage.greatest_shear), std::max(longest[2], stage.greatest_load)};
  }
  for (ScenePicture& p : panels) p.longest = longest;
}

class Rows {
public:
  explicit Rows(const SceneGrid& given) : sheet_(given), columns_(static_cast<std::size_t>(given.columns)), em_(letters(given)), panels_(given.panels) {
    share_ranges();
    share_lengths(panels_);
    name_scales();
    title_ = fitted(sheet_.title, 1.15 * em_, sheet_.width - em_, true);
    above_ = sheet_.title.empty() ? 0 : 1.9 * em_ + title_.depth();
    heights_.assign(rows(), (sheet_.height - above_) / static_cast<double>(rows()));
    // Heights of rows depend on what the panels lack or do not need, and that on their heights.
    for (int round = 0; round < 4; ++round) {
      const std::vector<double> missing = lay_out_panels();
      for (std::size_t r = 0; r < rows(); ++r) heights_[r] = std::max(least_plot(sheet_), heights_[r] + missing[r]);
      sheet_.height = static_cast<int>(std::ceil(above_ + std::accumulate(heights_.begin(), heights_.end(), 0.0) + legend_.height()));
    }
    if (sheet_.height > greatest_side)
      throw InputError(text("the pictures of ", sheet_.file, " need ", sheet_.height, " pixels of height in ", rows(), " rows, at most ", greatest_side, " are possible; give more 'columns'"));
    lay_out_panels();
    double lacks = 0;
    for (const Stage& stage : stages_) lacks = std::max(lacks, static_cast<double>(columns_) * lacking_width(stage));
    refuse_narrow(sheet_, lacks, columns_ > 1 ? ", or give fewer 'columns'" : "");
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

  // Panels that show the same field share the range of its colours; if all panels show it, they share one bar, too.
  void share_ranges() {
    std::map<std::pair<std::string, std::string>, std::vector<ScenePicture*>> fields;
    for (ScenePicture& p : panels_)
      if (!p.field_label.empty()) fields[{p.field_label, p.field_unit}].push_back(&p);
    for (const auto& [field, panels] : fields)
      if (const std::optional<ColourScale> common = common_scale(panels)) {
        for (ScenePicture* p : panels) p->field_range = {common->low, common->high}, p->field_signed = common->diverging;
        if (fields.size() == 1) scale_ = common;
      }
  }

  // If the deformation factors of the panels differ, each panel states its own below the scene.
  void name_scales() {
    std::set<double> factors;
    for (const ScenePicture& p : panels_)
      if (displaced(p)) factors.insert(p.deformation);
    several_factors_ = factors.size() > 1;
    for (ScenePicture& p : panels_)
      if (several_factors_ && displaced(p)) p.caption = scale_name(p) + (p.caption.empty() ? "" : "; ") + p.caption;
  }

  // Returns the pixels that each row's height lacks; below 0: that it does not need.
  std::vector<double> lay_out_panels() {
    const double bar = scale_ ? bar_width() + 0.8 * em_ : 0, spacing = gap * em_;
    const double wide = (sheet_.width - bar - spacing * static_cast<double>(columns_ - 1)) / static_cast<double>(columns_);
    if (wide < least_side) throw InputError(text("the pictures of ", sheet_.file, " are ", std::floor(wide), " pixels wide in ", columns_, " columns, they need ", least_side, "; give fewer 'columns' or a greater 'size'"));
    stages_.clear();
    std::vector<double> missing(rows(), -1e300);
    std::vector<Named> entries;
    double top = sheet_.height - above_;
    for (std::size_t i = 0; i < panels_.size(); ++i) {
      const std::size_t row = i / columns_;
      if (i % columns_ == 0) top -= heights_[row];
      ScenePicture& p = panels_[i];
      p.file = sheet_.file, p.width = static_cast<int>(wide), p.height = static_cast<int>(heights_[row]);
      p.printed = printed_width(sheet_) * p.width / sheet_.width;
      Stage& stage = stages_.emplace_back(p, Point{std::floor(static_cast<double>(i % columns_) * (wide + spacing)), std::floor(top)});
      stage.own_bar = !scale_, stage.own_legend = false, stage.names_scale = !several_factors_;
      missing[row] = std::max(missing[row], lay_out(stage));
      for (const LegendEntry& entry : stage.entries) add(entry, stage, entries);
    }
    std::vector<LegendEntry> all;
    for (Named& entry : entries) all.push_back(joined(std::move(entry)));
    legend_ = Legend(std::move(all), small_text * em_, sheet_.width - em_);
    return missing;
  }

  // An entry, and its samples on the kinds of pictures that have it.
  struct Named {
    LegendEntry entry;
    std::map<int, std::function<void(Canvas&, const Box&)>> samples;
  };

  static void add(const LegendEntry& entry, const Stage& stage, std::vector<Named>& entries) {
    const int kind = stage.map() ? (stage.scale.shown ? 2 : 3) : stage.plane ? 1 : 0;
    const auto same = std::ranges::find_if(entries, [&](const Named& other) { return other.entry.name == entry.name; });
    if (same == entries.end()) entries.push_back({entry, {{kind, entry.sample}}});
    else same->samples.emplace(kind, entry.sample);
  }

  // Statuses and the pressure are drawn differently in space, in the plane and on maps: their entries show all samples side by side.
  static LegendEntry joined(Named named) {
    const auto is_status = [&](Status s) { return named.entry.name == status_name(s); };
    const bool differs = std::ranges::any_of(std::array{Status::open, Status::closed, Status::stick, Status::slip}, is_status) || named.entry.name.starts_with("contact pressure");
    if (named.samples.size() < 2 || !differs) return named.entry;
    return {named.entry.name, [samples = named.samples](Canvas& c, const Box& b) {
              const double each = b.width() / static_cast<double>(samples.size());
              double left = b.left;
              for (const auto& [kind, sample] : samples) sample(c, {left, b.bottom, left + each, b.top}), left += each;
            }};
  }

  SceneGrid sheet_;
  std::size_t columns_;
  double em_, above_ = 0;
  bool several_factors_ = false;
  std::vector<double> heights_;  // of rows
  std::vector<ScenePicture> panels_;
  std::optional<ColourScale> scale_;
  FittedText title_;
  Legend legend_{{}, 1};
  std::list<Stage> stages_;
};

}  // namespace

void render(const SceneGrid& grid) { Rows(grid).write(); }

}  // namespace dotyk::figure
