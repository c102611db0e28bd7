// Lays the cells of a page out in rows and columns and draws them.
#include <numeric>
#include <set>

#include "figure/door/drawing.hpp"
#include "figure/canvas/paper.hpp"
#include "figure/canvas/sheet.hpp"
#include "figure/page/page_cells.hpp"

namespace dotyk::figure {

namespace {

class Page {
public:
  explicit Page(const PagePicture& picture) : picture_(picture), columns_(picture.rows.front().size()), em_(letters(picture)) {
    double top = picture.height - 0.4 * em_;
    top = draw_title(top);
    top = draw_legend(top);
    place(top);
    align();
    for (std::size_t i = 0; i < axes_.size(); ++i)
      for (std::size_t j = 0; j < columns_; ++j) draw(i, j);
  }

  const Canvas& canvas() const { return canvas_; }

  // Pixels of height that the page lacks for plots that are not too low.
  double missing() const {
    double most = 0;
    for (std::size_t i = 0; i < axes_.size(); ++i)
      most = std::max(most, (least_plot(picture_) - axes_[i].front().room.height()) * total(picture_.row_weights) / picture_.row_weights[i]);
    return most;
  }

private:
  static double total(const std::vector<double>& weights) { return std::accumulate(weights.begin(), weights.end(), 0.0); }
  const PageCell& cell(std::size_t i, std::size_t j) const { return picture_.rows[i][j]; }
  bool labels_x(std::size_t i) const { return !picture_.shared_x || i + 1 == picture_.rows.size(); }

  double draw_title(double top) {
    if (picture_.title.empty()) return top - 0.4 * em_;
    const FittedText title = fitted(picture_.title, 1.1 * em_, picture_.width - 2 * em_, true);
    canvas_.text({picture_.width / 2.0, top - 0.4 * em_}, title, title_style());
    return top - 0.7 * em_ - 1.5 * title.size - title.depth();
  }

  // States of supports that occur, but where all do no more than act; displacements that cannot be.
  double draw_legend(double top) {
    std::set<SupportState> seen;
    bool idle = false, forbidden = false;
    for (const auto& row : picture_.rows)
      for (const PageCell& c : row)
        if (const auto* beam = std::get_if<BeamDrawing>(&c.drawing)) {
          for (const BeamSupport& s : beam->supports)
            for (const SupportElement& e : {s.below, s.arc}) {
              if (e.kind != ElementKind::none) seen.insert(e.state);
              idle = idle || (e.kind == ElementKind::paired_springs && (e.state == SupportState::pushing || e.state == SupportState::pulling));
            }
        } else {
          forbidden = forbidden || !std::get<CurveDrawing>(c.drawing).forbidden.empty();
        }
    if (seen == std::set{SupportState::acting}) seen.clear();
    std::vector<LegendEntry> entries;
    const auto add = [&](const std::string& name, Colour colour, bool hollow, double gap) {
      entries.push_back({name, [=](Canvas& c, const Box& b) {
                           const Box bar{b.left + 0.3 * b.width(), b.centre().y - 0.16 * b.height(), b.right, b.centre().y + 0.16 * b.height()};
                           const double middle = bar.centre().x, half = 0.5 * gap * bar.width();
                           if (hollow) return c.outline(bar.grown(-0.05 * b.height()), 0.1 * b.height(), colour);
                           if (gap == 0) return c.box(bar, colour);
                           c.box({bar.left, bar.bottom, middle - half, bar.top}, colour), c.box({middle + half, bar.bottom, bar.right, bar.top}, colour);
                         }});
    };
    for (const SupportState state : seen)
      add(std::string("support ") + state_name(state), state_colour(state), state == SupportState::open, state == SupportState::broken ? 0.3 : 0);
    if (idle) add("spring that does not act", idle_ink, false, 0);
    if (forbidden) add("impossible displacement", forbidden_grey, false, 0);
    if (entries.empty()) return top;
    const Legend legend(std::move(entries), em_, picture_.width - em_);
    legend.draw(canvas_, {(picture_.width - legend.width()) / 2, top - legend.height()}, false);
    return top - legend.height();
  }

  // Rooms without the margins on the left, which align() finds.
  void place(double top) {
    const double gap = 0.5 * em_, width = picture_.width, height = top;
    double y = height;
    const double shared = picture_.shared_x ? 2.8 * em_ : 0;
    for (std::size_t i = 0; i < picture_.rows.size(); ++i) {
      const double share = (height - shared - gap) * picture_.row_weights[i] / total(picture_.row_weights);
      std::vector<Axes> row;
      double x = 0;
      const bool titled = std::any_of(picture_.rows[i].begin(), picture_.rows[i].end(), [](const PageCell& c) { return !c.title.empty(); });
      for (std::size_t j = 0; j < columns_; ++j) {
        const double wide = width * picture_.column_weights[j] / total(picture_.column_weights);
        Axes& axes = row.emplace_back();
        axes.em = em_;
        axes.room = {x, y - share + (picture_.shared_x ? 0.35 * em_ : 3.1 * em_), x + wide - 1.5 * em_, y - (titled ? 1.7 : 0.45) * em_};
        x += wide;
      }
      axes_.push_back(std::move(row));
      y -= share;
    }
  }

  void align() {
    for (std::size_t j = 0; j < columns_; ++j) {
      double widest = 0, depth = 0;  // of labels
      for (std::size_t i = 0; i < axes_.size(); ++i) {
        std::visit([&](const auto& drawing) { fit_y(drawing, axes_[i][j]); }, cell(i, j).drawing);
        widest = std::max(widest, widest_label(axes_[i][j].y_ticks, em_));
        depth = std::max(depth, y_label(i, j).depth());
      }
      for (auto& row : axes_) {
        row[j].room.left += widest + (0.6 + 1.7 + 0.5) * em_ + depth;
        row[j].x.from = row[j].room.left, row[j].x.to = row[j].room.right;
      }
      for (std::size_t i = 0; i < axes_.size(); ++i) fit_x(i, j);
    }
  }

  FittedText y_label(std::size_t i, std::size_t j) const { return fitted(axis_name(cell(i, j).y_label, axes_[i][j].y_ticks), em_, axes_[i][j].room.height()); }

  // In em of symbols, of all beams of a column.
  double beyond_ends_of(std::size_t j) const {
    double most = 0.9;
    for (const auto& row : picture_.rows)
      if (const auto* beam = std::get_if<BeamDrawing>(&row[j].drawing)) most = std::max(most, beyond_ends(*beam));
    return most;
  }

  // Of a beam with room for walls beyond its ends; a diagram has the axis of the beam it belongs to.
  void fit_x(std::size_t i, std::size_t j) {
    Axes& axes = axes_[i][j];
    const auto* curve = std::get_if<CurveDrawing>(&cell(i, j).drawing);
    if (curve && curve->x_range) {
      axes.x.low = (*curve->x_range)[0], axes.x.high = (*curve->x_range)[1];
      axes.x_ticks = spaced_ticks(axes.x, em_);
      return;
    }
    const double length = curve ? curve->curves.front().x.back() : std::get<BeamDrawing>(cell(i, j).drawing).length;
    const double pad = beyond_ends_of(j) * std::min(1.4 * em_, axes.room.width() / 22);
    const double per_unit = (axes.room.width() - 2 * pad) / length;
    axes.x.low = -pad / per_unit, axes.x.high = length + pad / per_unit;
    axes.x_ticks = spaced_ticks(axes.x, em_);
    const double low = -1e-9 * axes.x.high, high = length * (1 + 1e-9);
    std::erase_if(axes.x_ticks.ticks, [&](const Tick& t) { return t.value < low || t.value > high; });
  }

  void draw(std::size_t i, std::size_t j) {
    const Axes& axes = axes_[i][j];
    const PageCell& c = cell(i, j);
    draw_grid(canvas_, axes);
    std::visit([&](const auto& drawing) { draw_cell(canvas_, drawing, axes); }, c.drawing);
    draw_ticks(canvas_, axes, Side::left);
    draw_ticks(canvas_, axes, Side::below, labels_x(i));
    draw_frame(canvas_, axes);
    const Point middle = axes.room.centre();
    const std::string across = labels_x(i) ? axis_name(c.x_label, axes.x_ticks) : "";
    const double size = fitting_size(across, em_, axes.room.right - left_of(j) - 0.5 * em_);
    canvas_.text({std::min(middle.x, axes.room.right - text_extent(across, size).x / 2), axes.room.bottom - 1.75 * em_}, across, {.size = size, .across = Align::middle, .up = Align::high});
    canvas_.text({left_of(j) + 0.5 * em_, middle.y}, y_label(i, j), {.up = Align::middle, .upright = true});
    std::size_t next = j + 1;  // titles go on over cells that have none
    while (next < columns_ && cell(i, next).title.empty()) ++next;
    const double wide = (next < columns_ ? left_of(next) : picture_.width) - axes.room.left - em_;
    canvas_.text({axes.room.left, axes.room.top + 0.4 * em_}, c.title, {.size = fitting_size(c.title, em_, wide, true), .bold = true});
  }

  double left_of(std::size_t j) const {
    return picture_.width * std::accumulate(picture_.column_weights.begin(), picture_.column_weights.begin() + static_cast<std::ptrdiff_t>(j), 0.0) / total(picture_.column_weights);
  }

  const PagePicture& picture_;
  Canvas canvas_;
  std::size_t columns_;
  double em_;
  std::vector<std::vector<Axes>> axes_;
};

PagePicture grown(PagePicture picture) {
  picture.height = std::min(std::max(picture.height, greatest_side), picture.height + static_cast<int>(std::ceil(Page(picture).missing())));
  return picture;
}

}  // namespace

void render(const PagePicture& given) {
  const PagePicture picture = grown(given);
  write_canvas(Page(picture).canvas(), picture);
}

std::vector<DataMark> read(const PagePicture& picture) { return Page(grown(picture)).canvas().told(); }

}  // namespace dotyk::figure
