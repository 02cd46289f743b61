#include "render/drawing/visibility/hidden_lines.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>

#include "geometry/queries/contours/contour_approximation.h"
#include "geometry/queries/contours/silhouette_crossings.h"
#include "geometry/queries/intersections/curve_intersections.h"
#include "geometry/transformed.h"
#include "render/drawing/visibility/picture_crossings.h"
#include "render/drawing/visibility/piercings.h"
#include "render/drawing/visibility/quantitative_invisibility.h"
#include "render/model/placed_objects.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Events nearer than this part of a curve's domain are one.
constexpr double kSameEvent = 1e-9;
// A line that goes round its surface touches the outline in the picture, which is found to so many pixels.
constexpr double kSameTurn = 5e-4;
// Pieces of a curve go on in one another if their directions, and their ends, of the curve's length, differ by no more.
constexpr double kSmooth = 1e-7;
constexpr double kNearer = 1e-2;  // rays are aimed by that nearer to a line where they disagree, again and again
// Nearer to the end of a stretch, in pixels, a ray through a line that goes round its surface there may miss both
// sheets.
constexpr double kFromEnds = 0.02;
// Where rays disagree inside of a stretch the place is found to this part of the domain.
constexpr double kBisected = 1e-10;
// Cells of curves bend as the picture of a line of no width does.
constexpr double kReach = 0.01;
// What stands for a contour is that near to it, of its size; for one of a fitted copy.
constexpr double kExactContour = 1e-13, kNearContour = 1e-9;
// Lines nearer to one another, of the scene's radius, lie on one another.
constexpr double kNear = 1e-7;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

class Drawing {
 public:
  Drawing(const World& world, const std::function<void(double)>& progress)
      : world_(world), camera_(*world.model().camera), progress_(progress), layers_(world) {}

  VisibleLines run(LineWork work) {
    auto begin = std::chrono::steady_clock::now();
    result_.incomplete = work.incomplete;
    result_.incomplete_objects = std::move(work.incomplete_objects);
    strokes_ = std::move(work.strokes);
    curves_.resize(strokes_.size());
    own_outlines_.resize(strokes_.size());
    each_line([&](size_t k) {
      simplify(strokes_[k]);
      curves_[k] = std::make_shared<ProjectedCurve>(strokes_[k].curve, strokes_[k].to_world, camera_, kReach);
    });
    for (size_t k = 0; k < strokes_.size(); ++k)
      if (strokes_[k].kind == "self_intersection") self_intersections_.push_back(static_cast<int>(k));
    find_repeated_lines();
    piercings_.emplace(world_, strokes_);
    std::vector<const ProjectedCurve*> outlines;
    for (size_t k = 0; k < strokes_.size(); ++k)
      if (strokes_[k].outlines) outlines.push_back(curves_[k].get()), outline_of_.push_back(static_cast<int>(k));
    const PictureCrossings crossings(outlines, camera_.width(), camera_.height());
    result_.statistics.seconds_of_lines = seconds_since(begin);
    begin = std::chrono::steady_clock::now();
    const auto is_asked = [&](size_t k) {
      const bool is_border = work.fills && (strokes_[k].outlines || strokes_[k].borders);
      return (strokes_[k].drawn || is_border) && !curves_[k]->cells().empty();
    };
    // Lines along one another ask for one another's.
    std::vector<char> tells_outlines(strokes_.size(), 0);
    for (size_t k = 0; k < strokes_.size(); ++k) {
      if (!is_asked(k)) continue;
      tells_outlines[k] = 1;
      for (const int coincident : coincident_[k]) tells_outlines[static_cast<size_t>(coincident)] = 1;
    }
    each_line([&](size_t k) {
      if (tells_outlines[k]) add_own_outlines(strokes_[k], own_outlines_[k]);
    });
    std::mutex telling;
    size_t done = 0;
    const auto tell = [&] {
      if (!progress_) return;
      const std::lock_guard lock(telling);
      progress_(0.5 * static_cast<double>(++done) / strokes_.size());
    };
    std::vector<std::vector<double>> events(strokes_.size());
    std::vector<int> crossings_seen(strokes_.size(), 0);
    each_line([&](size_t k) {
      if (is_asked(k)) events[k] = events_of(static_cast<int>(k), crossings, crossings_seen[k]);
      tell();
    });
    for (const int seen : crossings_seen) result_.statistics.crossings += seen;
    result_.statistics.seconds_of_crossings = seconds_since(begin);
    begin = std::chrono::steady_clock::now();
    std::vector<std::vector<VisiblePiece>> pieces(strokes_.size());
    each_line([&](size_t k) {
      if (is_asked(k)) pieces[k] = pieces_of(static_cast<int>(k), std::move(events[k]));
      tell();
    });
    result_.statistics.seconds_of_rays = seconds_since(begin);
    for (size_t k = 0; k < strokes_.size(); ++k) {
      if (!is_asked(k)) continue;
      result_.statistics.pieces += static_cast<int>(pieces[k].size());
      ++result_.statistics.lines;
      result_.lines.push_back({strokes_[k], curves_[k], std::move(pieces[k])});
    }
    for (const Mark& mark : work.marks) {
      const PicturePoint at = camera_.project(mark.point);
      if (at.visible_side) result_.marks.push_back({mark, {at.x, at.y}, layers_.before(mark.point)});
    }
    for (PointText& text : work.texts) {
      const PicturePoint at = camera_.project(text.point);
      const int layers = text.hidden_opacity < 1 ? layers_.before(text.point) : 0;
      if (at.visible_side) result_.texts.push_back({std::move(text), {at.x, at.y}, layers});
    }
    result_.statistics.rays = layers_.rays();
    return std::move(result_);
  }

 private:
  // Lines are apart from one another but for their crossings.
  template <class Visit>
  void each_line(const Visit& visit) const {
    tbb::parallel_for(size_t{0}, strokes_.size(), visit);
  }

  // Contours that solve their equations at every point are asked too often for that. Silhouettes of fitted copies are
  // no better than the copies.
  void simplify(Stroke& stroke) const {
    const bool is_of_copy =
        stroke.kind == "silhouette" && std::any_of(stroke.supporting_surfaces.begin(), stroke.supporting_surfaces.end(),
                                                   [](const auto& one) { return one.surface->is_composed(); });
    const double tolerance = is_of_copy ? kNearContour : kExactContour;
    // Rounding leaves less of a small contour: then what is near enough in the scene.
    const double length = kExactContour * world_.radius();
    for (auto& [surface, image] : stroke.supporting_surfaces) {
      Curve2Ptr simple = contour_approximation(stroke.curve, *surface, image, tolerance, tolerance);
      if (simple == image) simple = contour_approximation_within(stroke.curve, *surface, image, length);
      image = std::move(simple);
    }
    CurvePtr simple = contour_approximation(stroke.curve, tolerance, tolerance);
    if (simple == stroke.curve) simple = contour_approximation_within(stroke.curve, length);
    stroke.curve = std::move(simple);
  }

  // The border at which two surfaces join is one of each: one is enough to hide what lies behind it. And what is drawn
  // along a border, all of it, crosses it nowhere.
  void find_repeated_lines() {
    constexpr int kPlaces = 4;
    const double same = QuantitativeInvisibility::kOnSupportingSurface * world_.radius();
    using Places = std::array<Vec3, kPlaces + 1>;
    std::vector<std::pair<Places, int>> lines;
    for (size_t k = 0; k < strokes_.size(); ++k) {
      const Stroke& stroke = strokes_[k];
      if (stroke.kind == "silhouette") continue;
      const Interval domain = stroke.curve->domain();
      Places places;
      for (int i = 0; i <= kPlaces; ++i)
        places[i] = stroke.to_world.point(stroke.curve->point(domain.lo + domain.width() * i / kPlaces));
      lines.emplace_back(places, static_cast<int>(k));
    }
    std::sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) {
      return a.first[kPlaces / 2].x != b.first[kPlaces / 2].x ? a.first[kPlaces / 2].x < b.first[kPlaces / 2].x
                                                              : a.second < b.second;
    });
    const auto agree = [&](const Places& a, const Places& b) {
      const auto near = [&](bool backwards) {
        for (int i = 0; i <= kPlaces; ++i)
          if (glm::length(a[i] - b[backwards ? kPlaces - i : i]) > same) return false;
        return true;
      };
      return near(false) || near(true);
    };
    coincident_.resize(strokes_.size());
    for (size_t k = 0; k < lines.size(); ++k)
      for (size_t j = k + 1; j < lines.size(); ++j) {
        if (lines[j].first[kPlaces / 2].x > lines[k].first[kPlaces / 2].x + same) break;
        const int a = lines[k].second, b = lines[j].second;
        if (!(strokes_[a].outlines || strokes_[b].outlines) || !agree(lines[k].first, lines[j].first)) continue;
        if (strokes_[a].outlines) strokes_[b].outlines = false;
        coincident_[a].push_back(b), coincident_[b].push_back(a);
      }
  }

  double depth_at(int line, double t) const { return camera_.project(curves_[line]->tangent(t).origin).depth; }

  std::vector<double> events_of(int line, const PictureCrossings& crossings, int& crossings_seen) {
    const Stroke& stroke = strokes_[line];
    std::vector<double> events = stroke.cusps;
    const std::vector<double>& own = own_outlines_[line];
    events.insert(events.end(), own.begin(), own.end());
    add_outlines_of_coincident_lines(line, events);
    add_self_piercings(stroke, events);
    std::vector<const Stroke*> along;
    for (const int coincident : coincident_[line]) along.push_back(&strokes_[coincident]);
    piercings_->add(stroke, along, events);
    // Where it goes round its own surface, has a cusp or ends on an outline, it only touches that in the picture: such
    // a place is known better than as a crossing.
    std::vector<Vec2> known;
    for (const double t : events) known.push_back(curves_[line]->place(t).p);
    for (const double end : {stroke.curve->domain().lo, stroke.curve->domain().hi})
      known.push_back(curves_[line]->place(end).p);
    const auto is_known = [&](double t) {
      const Vec2 place = curves_[line]->place(t).p;
      return std::any_of(known.begin(), known.end(),
                         [&](const Vec2& one) { return glm::length(place - one) < kSameTurn; });
    };
    for (const CurvePiece& piece : stroke.curve->pieces())
      if (is_corner(*stroke.curve, piece.domain.lo) && !is_known(piece.domain.lo)) events.push_back(piece.domain.lo);
    const auto is_coincident = [&](int other) {
      const std::vector<int>& coincident_lines = coincident_[line];
      return std::find(coincident_lines.begin(), coincident_lines.end(), outline_of_[other]) != coincident_lines.end();
    };
    const auto add_crossing = [&](int of, int outline, const PictureCrossing& crossing, double t) {
      if ((crossing.touching || share_supporting_surface(strokes_[outline], stroke)) && is_known(t)) return;
      const double near = QuantitativeInvisibility::kTouch * world_.radius();
      if (outline == of || depth_at(outline, crossing.t_other) < depth_at(of, crossing.t) + near) events.push_back(t);
    };
    crossings.with(*curves_[line], is_coincident, [&](int other, const PictureCrossing& crossing) {
      ++crossings_seen;
      add_crossing(line, outline_of_[other], crossing, crossing.t);
    });
    // A twin's with itself are the line's too.
    for (const int coincident : coincident_[line])
      if (strokes_[coincident].outlines)
        crossings.with(
            *curves_[coincident], [&](int other) { return outline_of_[other] != coincident; },
            [&](int, const PictureCrossing& crossing) {
              if (const auto t = same_place(line, coincident, crossing.t))
                add_crossing(coincident, coincident, crossing, *t);
            });
    return events;
  }

  // Where a curve changes its direction, or jumps.
  static bool is_corner(const Curve& curve, double t) {
    if (!(t > curve.domain().lo)) return false;
    const CurveJet before = curve.evaluate(next_down(t), 1), behind = curve.evaluate(t, 1);
    const double a = glm::length(before.d[1]), b = glm::length(behind.d[1]);
    return !(a > 0 && b > 0) || glm::length(before.d[1] / a - behind.d[1] / b) > kSmooth ||
           glm::length(before.d[0] - behind.d[0]) > kSmooth * (a + b) * curve.domain().width();
  }

  static bool share_supporting_surface(const Stroke& a, const Stroke& b) {
    if (a.object != b.object || a.placement != b.placement) return false;
    if (a.supporting_surfaces.empty() && b.supporting_surfaces.empty() && (a.outward_offset || b.outward_offset))
      return true;  // of one tube
    for (const Stroke::SupportingSurface& one : a.supporting_surfaces)
      for (const Stroke::SupportingSurface& other : b.supporting_surfaces)
        if (one.surface == other.surface && same_map(a.to_world, b.to_world)) return true;
    return false;
  }

  // Where the line goes round a surface on which it lies.
  void add_own_outlines(const Stroke& stroke, std::vector<double>& events) const {
    if (stroke.kind == "silhouette") return;  // it is one
    const Affine back = stroke.to_world.inverse();
    const ViewOf view = camera_.is_parallel() ? ViewOf{false, back.direction(camera_.view_direction())}
                                              : ViewOf{true, back.point(layers_.eye())};
    for (const Stroke::SupportingSurface& supporting_surface : stroke.supporting_surfaces)
      add_silhouette_crossings(*stroke.curve, *supporting_surface.surface, *supporting_surface.image, view, events);
  }

  // The place of a twin at t, on the line itself.
  std::optional<double> same_place(int line, int coincident, double t) const {
    const Stroke &stroke = strokes_[line], &other = strokes_[coincident];
    const Vec3 point = (stroke.to_world.inverse() * other.to_world).point(other.curve->point(t));
    const auto meets = [&](double at) {
      return glm::length(stroke.curve->point(at) - point) < kNear * world_.radius();
    };
    // Most have the same parameter, or run the other way.
    const Interval from = other.curve->domain(), to = stroke.curve->domain();
    const double along = to.width() * (t - from.lo) / from.width();
    for (const double at : {to.clamp(to.lo + along), to.clamp(to.hi - along)})
      if (meets(at)) return at;
    const double at = nearest(*stroke.curve, point);
    return meets(at) ? std::optional(at) : std::nullopt;
  }

  // Where it goes round surfaces that join its own along it.
  void add_outlines_of_coincident_lines(int line, std::vector<double>& events) {
    for (const int coincident : coincident_[line])
      for (const double turn : own_outlines_[coincident])
        if (const auto t = same_place(line, coincident, turn)) events.push_back(*t);
  }

  // Where it meets the lines in which a surface on which it lies goes through itself.
  void add_self_piercings(const Stroke& stroke, std::vector<double>& events) const {
    for (const int line : self_intersections_) {
      const Stroke& other = strokes_[line];
      if (&other == &stroke || !share_supporting_surface(other, stroke)) continue;
      if (!runs_along(*stroke.curve, *other.curve)) {
        for (const CurveIntersection& intersection : intersect(*stroke.curve, *other.curve).points)
          events.push_back(intersection.s);
        continue;
      }
      // Then it lies on two sheets, and goes round either; to find it out as a common part would take long.
      std::vector<double> turns;
      add_own_outlines(other, turns);
      for (const double turn : turns) {
        const Vec3 point = other.curve->point(turn);
        const double t = nearest(*stroke.curve, point);
        if (glm::length(stroke.curve->point(t) - point) < kNear * world_.radius()) events.push_back(t);
      }
    }
  }
  // As far as a few places of the curve tell, each the nearest to it of the other.
  bool runs_along(const Curve& curve, const Curve& other) const {
    const Interval domain = curve.domain();
    for (const double share : {0.43, 0.07, 0.91, 0.26, 0.71}) {
      const Vec3 point = curve.point(domain.lo + share * domain.width());
      if (glm::length(other.point(nearest(other, point)) - point) > kNear * world_.radius()) return false;
    }
    return true;
  }
  // The parameter of a curve's point that is nearest to one on or far from it.
  static double nearest(const Curve& curve, const Vec3& point) {
    constexpr int kPlaces = 256, kSteps = 8;
    const Interval domain = curve.domain();
    const auto at = [&](int k) { return domain.lo + domain.width() * k / kPlaces; };
    int best = 0;
    double least = kInfinity;
    for (int k = 0; k <= kPlaces; ++k)
      if (const double off = glm::length(curve.point(at(k)) - point); off < least) least = off, best = k;
    double t = at(best);
    for (int step = 0; step < kSteps; ++step) {
      const CurveJet jet = curve.evaluate(t, 1);
      const double square = glm::dot(jet.d[1], jet.d[1]);
      if (!(square > 0)) break;
      t = domain.clamp(t + glm::dot(point - jet.d[0], jet.d[1]) / square);
    }
    return t;
  }

  std::vector<VisiblePiece> pieces_of(int line, std::vector<double> events) {
    const Interval domain = strokes_[line].curve->domain();
    const double same = kSameEvent * domain.width();
    std::vector<VisiblePiece> pieces;
    std::sort(events.begin(), events.end());
    const auto& cells = curves_[line]->cells();
    for (size_t first = 0; first < cells.size();) {
      size_t last = first;
      while (last + 1 < cells.size() && cells[last + 1].t.lo == cells[last].t.hi) ++last;
      // What reaches out of the picture goes on as it is at the picture's border: what crosses it there is not known.
      const size_t before = pieces.size();
      for (const Interval& part : parts_in_picture(line, first, last)) {
        if (pieces.size() > before) add_piece({pieces.back().t.hi, part.lo}, pieces.back().layers, pieces);
        std::vector<double> cuts{part.lo};
        for (const double t : events)
          if (t > cuts.back() + same && t < part.hi - same) cuts.push_back(t);
        cuts.push_back(part.hi);
        for (size_t k = 0; k + 1 < cuts.size(); ++k) add_stretch(line, {cuts[k], cuts[k + 1]}, pieces);
      }
      pieces[before].t.lo = cells[first].t.lo, pieces.back().t.hi = cells[last].t.hi;
      first = last + 1;
    }
    return pieces;
  }

  // Of a run of cells: what lies between the places where it enters and leaves the picture, with the margin in which
  // curves are known; all of it if no end of a cell is inside.
  std::vector<Interval> parts_in_picture(int line, size_t first, size_t last) const {
    const ProjectedCurve& curve = *curves_[line];
    const auto is_inside = [&](const Vec2& p) {
      return p.x >= -kReach && p.y >= -kReach && p.x <= camera_.width() + kReach && p.y <= camera_.height() + kReach;
    };
    std::vector<Interval> parts;
    bool inside = false;
    const auto& cells = curve.cells();
    for (size_t k = first; k <= last; ++k) {
      if (!inside && is_inside(cells[k].begin)) parts.emplace_back(cells[k].t.lo), inside = true;
      if (is_inside(cells[k].end) != inside) {
        constexpr int kHalvings = 40;
        Interval border = cells[k].t;
        for (int i = 0; i < kHalvings; ++i)
          (is_inside(curve.place(border.middle()).p) == inside ? border.lo : border.hi) = border.middle();
        if (!inside) parts.emplace_back(border.hi);
        inside = !inside;
        if (!inside) parts.back().hi = border.lo;
      }
      if (inside) parts.back().hi = cells[k].t.hi;
    }
    std::erase_if(parts, [](const Interval& part) { return !(part.lo < part.hi); });
    if (parts.empty()) parts.push_back({cells[first].t.lo, cells[last].t.hi});
    return parts;
  }

  static void add_piece(const Interval& t, int layers, std::vector<VisiblePiece>& pieces) {
    if (!pieces.empty() && pieces.back().layers == layers && pieces.back().t.hi == t.lo)
      pieces.back().t.hi = t.hi;
    else
      pieces.push_back({t, layers});
  }

  int layers_at(int line, double t, double lateral_offset) {
    return layers_.before(strokes_[line], *curves_[line], t, lateral_offset);
  }

  // Layers at places of a stretch: not so near its ends, where they can be farther, that rays nearly touch what ends
  // it.
  std::vector<std::pair<double, int>> seen_on(int line, const Interval& t, double lateral_offset) {
    const ProjectedCurve& curve = *curves_[line];
    const Vec2 middle = curve.point(t.middle());
    const double pixels = glm::length(curve.point(t.lo) - middle) + glm::length(curve.point(t.hi) - middle);
    const double first = kFromEnds < 0.5 * pixels ? std::max(0.17, kFromEnds / pixels) : 0.5;
    std::vector<std::pair<double, int>> seen;
    for (const double share : {first, 0.5, 1 - first}) {
      const double at = t.lo + share * t.width();
      if (seen.empty() || at > seen.back().first) seen.emplace_back(at, layers_at(line, at, lateral_offset));
    }
    return seen;
  }
  static bool agree(const std::vector<std::pair<double, int>>& seen) {
    return std::all_of(seen.begin(), seen.end(), [&](const auto& one) { return one.second == seen[0].second; });
  }

  void add_stretch(int line, const Interval& t, std::vector<VisiblePiece>& pieces) {
    // Where rays disagree they may be aimed too far beside a line that hardly leaves another; then nearer ones agree.
    const double lateral_offset = layers_.room_beside(*curves_[line], t);
    std::vector<std::pair<double, int>> seen = seen_on(line, t, lateral_offset);
    for (double nearer = kNearer * lateral_offset; !agree(seen) && nearer > QuantitativeInvisibility::kMinLateralOffset;
         nearer *= kNearer) {
      std::vector<std::pair<double, int>> again = seen_on(line, t, nearer);
      if (agree(again)) seen = std::move(again);
    }
    double from = t.lo;
    for (size_t k = 0; k + 1 < seen.size(); ++k) {
      if (seen[k].second == seen[k + 1].second) continue;
      double lo = seen[k].first, hi = seen[k + 1].first;
      while (hi - lo > kBisected * strokes_[line].curve->domain().width()) {
        const double middle = 0.5 * (lo + hi);
        (layers_at(line, middle, lateral_offset) == seen[k].second ? lo : hi) = middle;
      }
      add_piece({from, hi}, seen[k].second, pieces);
      from = hi;
    }
    add_piece({from, t.hi}, seen.back().second, pieces);
  }

  const World& world_;
  const Camera& camera_;
  const std::function<void(double)>& progress_;
  std::vector<Stroke> strokes_;
  std::vector<std::shared_ptr<const ProjectedCurve>> curves_;
  std::vector<int> self_intersections_;  // lines of this kind
  std::vector<int> outline_of_;
  std::vector<std::vector<int>> coincident_;       // lines along the whole of which another lies
  std::vector<std::vector<double>> own_outlines_;  // where lines go round their surfaces
  QuantitativeInvisibility layers_;
  std::optional<Piercings> piercings_;
  VisibleLines result_;
};

}  // namespace

VisibleLines visible_lines(const World& world, LineWork work, const std::function<void(double)>& progress) {
  return Drawing(world, progress).run(std::move(work));
}

}  // namespace lekalo::render
