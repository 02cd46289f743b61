#include "geometry/queries/rays/line_intersections.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "geometry/bodies/trims/trim.h"
#include "geometry/queries/implicit_curves/smooth_parts.h"
#include "geometry/queries/rays/fitted_pieces.h"
#include "geometry/queries/rays/line_cells.h"
#include "geometry/queries/rays/line_group.h"
#include "geometry/queries/rays/patch_target.h"
#include "geometry/queries/rays/sampled_extent.h"
#include "geometry/queries/rays/trimmed_hits.h"
#include "geometry/spatial/box_tree.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Of a surface that only its enclosures tell about: each cell costs several evaluations over intervals.
constexpr size_t kMaxEnclosedCells = 1 << 13;
// Cells that are smaller in both parameters are searched as they are: only about a singular place any get so small.
constexpr double kMinShareOfDomain = 1.0 / 4096;
// Cells at an edge that is a point are none the simpler for being made narrower: those that are smaller than this
// towards the pole stay as they are, else all cells would be spent there.
constexpr double kMinShareAtPole = 1.0 / 64;
// Of a surface of many smooth parts each has so many at least.
constexpr size_t kMinShare = 1 << 9;

// A surface with a closed form: one piece.
class FormulaTarget final : public LineTarget {
 public:
  FormulaTarget(SurfacePtr surface, std::shared_ptr<const TrimRegion> trim)
      : surface_(std::move(surface)), acceptance_(std::move(trim)), box_(geometry::bounds(*surface_)) {
    if (const TrimRegion* region = acceptance_.trim(); region && !box_.bounded())
      box_ = surface_->enclose({region->u_range(), region->v_range()}, 0).values[0];
  }
  int piece_count() const override { return 1; }
  std::string_view method() const override { return "closed form"; }
  Box3 piece_bounds(int) const override { return box_; }
  void piece_hits(int, const PreparedLine& line, const Interval& t, LineHits& hits) const override {
    if (acceptance_.trim())
      trimmed_hits(line.line(), t, hits);
    else
      surface_->line_hits(line.line(), t, hits);
  }
  const Surface& surface() const override { return *surface_; }
  size_t memory() const override { return sizeof *this; }

 private:
  void trimmed_hits(const Line& line, const Interval& t, LineHits& hits) const;

  SurfacePtr surface_;
  HitFilter acceptance_;
  Box3 box_;
};

void FormulaTarget::trimmed_hits(const Line& line, const Interval& t, LineHits& hits) const {
  LineHits all;
  surface_->line_hits(line, t, all);
  for (int i = 0; i < all.size(); ++i)
    if (acceptance_.keeps(all[i], t, line, *surface_)) hits.add(all[i]);
}

// What of a surface counts: the rectangles of its domain in which there may be something of that, and the share of
// kMaxEnclosedCells that it may have.
struct CellBudget {
  std::function<bool(const Rectangle&)> has_some;  // none: all
  size_t max_cells = kMaxEnclosedCells;
};

// Any other surface: rectangles certified by its own enclosures.
class EnclosureTarget final : public LineTarget {
 public:
  EnclosureTarget(SurfacePtr surface, const std::vector<Rectangle>& boxes, std::shared_ptr<const TrimRegion> trim,
                  const CellBudget& wanted)
      : surface_(std::move(surface)), acceptance_(std::move(trim)) {
    cut(boxes, wanted);
  }
  int piece_count() const override { return static_cast<int>(cells_.size()); }
  std::string_view method() const override { return "enclosed pieces"; }
  Box3 piece_bounds(int i) const override { return cells_[i].hull; }
  void piece_hits(int i, const PreparedLine& line, const Interval& t, LineHits& hits) const override {
    const Cell& cell = cells_[i];
    double foot_point;
    LineBasis basis = line.near(cell.model.point, foot_point);
    basis.line.origin += cell.model.point;
    CellHits found;
    intersect(*surface_, cell.box, cell.model, cell.proxy, cell.hull, basis, found);
    for (int k = 0; k < found.size(); ++k) {
      LineHit hit;
      hit.t = foot_point + found[k].t;
      hit.u = cell.box.u.clamp(cell.box.u.middle() + 0.5 * cell.box.u.width() * found[k].x);
      hit.v = cell.box.v.clamp(cell.box.v.middle() + 0.5 * cell.box.v.width() * found[k].y);
      if (acceptance_.keeps(hit, t, line.line(), *surface_)) hits.add(hit);
    }
  }
  bool meets_once(int i, const Vec3& direction) const override {
    return geometry::meets_once(cells_[i].model, direction);
  }
  const Surface& surface() const override { return *surface_; }
  size_t memory() const override { return sizeof *this + cells_.size() * sizeof(Cell); }

 private:
  struct Cell {
    CellModel model;
    Rectangle box;
    ProxyPatch proxy;
    Box3 hull;  // of its points
    double size = 0;
  };
  // Halves the largest cells that are not flat first: around singular points none ever is, and those are small soon.
  // What is halved next depends only on what there is, so that any number of threads makes the same cells.
  void cut(const std::vector<Rectangle>& boxes, const CellBudget& wanted) {
    const SampledExtent sampled(*surface_);
    const Rectangle domain = surface_->domain();
    // By the bounds: on a line of singular points in the middle of a cell one of the derivatives there may vanish.
    const auto is_halved_across_u = [&](const Cell& cell) {
      if (cell.model.is_bounded()) return cell.model.reach_x() >= cell.model.reach_y();
      return cell.box.u.width() * domain.v.width() >= cell.box.v.width() * domain.u.width();
    };
    const DegenerateEdges edges = surface_->degenerate_edges();
    const auto is_small_at_pole = [&](const Rectangle& box) {
      const bool at_pole_of_u = (edges.u_min && box.u.lo == domain.u.lo) || (edges.u_max && box.u.hi == domain.u.hi),
                 at_pole_of_v = (edges.v_min && box.v.lo == domain.v.lo) || (edges.v_max && box.v.hi == domain.v.hi);
      return (at_pole_of_u && box.u.width() < kMinShareAtPole * domain.u.width()) ||
             (at_pole_of_v && box.v.width() < kMinShareAtPole * domain.v.width());
    };
    const auto for_each = [](size_t count, const auto& make) {
      tbb::parallel_for(tbb::blocked_range<size_t>(0, count), [&](const tbb::blocked_range<size_t>& part) {
        for (size_t i = part.begin(); i < part.end(); ++i) make(i);
      });
    };
    std::vector<Cell> fresh(boxes.size()), rough;
    for (size_t i = 0; i < boxes.size(); ++i) fresh[i].box = boxes[i];
    for (;;) {
      if (wanted.has_some) std::erase_if(fresh, [&](const Cell& cell) { return !wanted.has_some(cell.box); });
      for_each(fresh.size(), [&](size_t i) {
        fresh[i].model = model_of(*surface_, fresh[i].box);
        fresh[i].size = sampled.size(fresh[i].box, fresh[i].model);
      });
      for (const Cell& cell : fresh) {
        const bool is_done =
            roughness(cell.model) <= kFlat || sampled.share(cell.box) < kMinShareOfDomain || is_small_at_pole(cell.box);
        (is_done ? cells_ : rough).push_back(cell);
      }
      const size_t count = cells_.size() + rough.size();
      if (rough.empty() || count >= wanted.max_cells) break;
      // The largest, and those not much smaller.
      std::stable_sort(rough.begin(), rough.end(), [](const Cell& a, const Cell& b) { return a.size > b.size; });
      const double least = 0.7 * rough.front().size;
      fresh.clear();
      size_t halved = 0;
      for (; halved < rough.size() && count + halved < wanted.max_cells; ++halved) {
        const Cell& cell = rough[halved];
        if (cell.size < least) break;
        Cell first{{}, cell.box, {}}, second = first;
        if (is_halved_across_u(cell))
          first.box.u.hi = second.box.u.lo = cell.box.u.middle();
        else
          first.box.v.hi = second.box.v.lo = cell.box.v.middle();
        fresh.push_back(first);
        fresh.push_back(second);
      }
      rough.erase(rough.begin(), rough.begin() + static_cast<std::ptrdiff_t>(halved));
    }
    cells_.insert(cells_.end(), rough.begin(), rough.end());
    for_each(cells_.size(), [&](size_t i) {
      cells_[i].proxy = proxy_of(*surface_, cells_[i].box);
      cells_[i].hull = sampled.hull(cells_[i].box, cells_[i].model);
    });
  }

  SurfacePtr surface_;
  HitFilter acceptance_;
  std::vector<Cell> cells_;
};

// Several targets in place of one.
class JointTarget : public LineTarget {
 public:
  explicit JointTarget(SurfacePtr surface) : surface_(std::move(surface)) {}
  void add(std::unique_ptr<LineTarget> target) {
    for (int i = 0; i < target->piece_count(); ++i) pieces_.emplace_back(targets_.size(), i);
    targets_.push_back(std::move(target));
  }
  int piece_count() const override { return static_cast<int>(pieces_.size()); }
  std::string_view method() const override { return targets_[0]->method(); }
  Box3 piece_bounds(int i) const override { return target(i).piece_bounds(pieces_[i].second); }
  void piece_hits(int i, const PreparedLine& line, const Interval& t, LineHits& hits) const override {
    target(i).piece_hits(pieces_[i].second, line, t, hits);
  }
  void group_hits(int first, int end, const unsigned* asked, const LineGroup& lines, GroupHits& hits) const override {
    for (int i = first; i < end; ++i) {
      const int piece = pieces_[i].second;
      GroupHits found;
      target(i).group_hits(piece, piece + 1, asked + (i - first), lines, found);
      for (GroupHit hit : found) {
        hit.piece = i;
        hits.add(hit);
      }
    }
  }
  bool meets_once(int i, const Vec3& direction) const override {
    return target(i).meets_once(pieces_[i].second, direction);
  }
  const Surface& surface() const override { return *surface_; }
  SurfaceJet jet_at(int i, double u, double v, const Vec3& near) const override {
    return target(i).jet_at(pieces_[i].second, u, v, near);
  }
  size_t memory() const override {
    size_t sum = sizeof *this + pieces_.size() * sizeof pieces_[0];
    for (const auto& target : targets_) sum += target->memory();
    return sum;
  }

 protected:
  size_t target_of(int i) const { return pieces_[i].first; }

 private:
  const LineTarget& target(int i) const { return *targets_[pieces_[i].first]; }

  SurfacePtr surface_;
  std::vector<std::unique_ptr<LineTarget>> targets_;
  std::vector<std::pair<size_t, int>> pieces_;  // target, its piece
};

std::unique_ptr<LineTarget> make_fitted_target(const SurfacePtr& surface, const std::shared_ptr<const TrimRegion>& trim,
                                               double min_area, const CellBudget& wanted) {
  const std::shared_ptr<const FittedPieces> fitted = fitted_pieces(surface);
  auto result = std::make_unique<JointTarget>(surface);
  if (!fitted->patches.empty()) result->add(std::make_unique<PatchTarget>(surface, fitted->patches, trim, min_area));
  if (!fitted->rest.empty()) result->add(std::make_unique<EnclosureTarget>(surface, fitted->rest, trim, wanted));
  return result;
}

std::unique_ptr<LineTarget> make_smooth_target(SurfacePtr surface, std::shared_ptr<const TrimRegion> trim,
                                               double min_area, const CellBudget& wanted) {
  if (surface->has_line_formula()) return std::make_unique<FormulaTarget>(std::move(surface), std::move(trim));
  std::vector<SurfacePiece> pieces = surface->pieces();
  const bool rational =
      std::all_of(pieces.begin(), pieces.end(), [](const SurfacePiece& piece) { return piece.is_rational(); });
  if (rational) return std::make_unique<PatchTarget>(std::move(surface), std::move(pieces), std::move(trim), min_area);
  if (surface->is_composed()) return make_fitted_target(surface, trim, min_area, wanted);
  std::vector<Rectangle> boxes;
  for (const SurfacePiece& piece : pieces) boxes.push_back(piece.domain);
  return std::make_unique<EnclosureTarget>(std::move(surface), boxes, std::move(trim), wanted);
}

// A surface of formulas with kinks: its smooth parts, with the hits on the right sides. At a crease both parts may have
// one, as neighbours have at a common border.
class PartsTarget final : public JointTarget {
 public:
  PartsTarget(const SurfacePtr& surface, std::vector<SmoothPart> parts, const std::shared_ptr<const TrimRegion>& trim,
              double min_area)
      : JointTarget(surface), parts_(std::move(parts)) {
    const Rectangle domain = surface->domain();
    slack_ = kHitSlack * Vec3(domain.u.width(), domain.v.width(), 0);
    const size_t share = std::max(kMaxEnclosedCells / parts_.size(), kMinShare);
    for (const SmoothPart& part : parts_) {
      const auto may_hold = [&](const Rectangle& r) {
        return geometry::may_hold(part.sides, {{r.u.lo, r.v.lo, 0}, {r.u.hi, r.v.hi, 0}});
      };
      add(make_smooth_target(part.surface, trim, min_area, {may_hold, share}));
    }
  }
  void piece_hits(int i, const PreparedLine& line, const Interval& t, LineHits& hits) const override {
    LineHits all;
    JointTarget::piece_hits(i, line, t, all);
    for (int k = 0; k < all.size(); ++k)
      if (holds(parts_[target_of(i)], {all[k].u, all[k].v, 0})) hits.add(all[k]);
  }
  void group_hits(int first, int end, const unsigned* asked, const LineGroup& lines, GroupHits& hits) const override {
    LineTarget::group_hits(first, end, asked, lines, hits);  // each hit is looked at above
  }

 private:
  bool holds(const SmoothPart& part, const Vec3& uv) const {
    return std::all_of(part.sides.begin(), part.sides.end(), [&](const ImplicitSide& side) {
      const double value = side.value(uv);
      return value >= 0 || value >= -glm::dot(slack_, glm::abs(side.height->gradient(uv)));
    });
  }

  std::vector<SmoothPart> parts_;
  Vec3 slack_{0};
};

}  // namespace

void LineTarget::group_hits(int first, int end, const unsigned* asked, const LineGroup&, GroupHits& hits) const {
  for (int piece = first; piece < end; ++piece)
    for (unsigned rest = asked[piece - first]; rest; rest &= rest - 1)
      hits.add({std::countr_zero(rest), piece, true, {}});
}

std::unique_ptr<LineTarget> make_line_target(SurfacePtr surface, std::shared_ptr<const TrimRegion> trim,
                                             double min_area) {
  if (std::vector<SmoothPart> parts = smooth_parts(surface); parts.size() > 1)
    return std::make_unique<PartsTarget>(surface, std::move(parts), trim, min_area);
  return make_smooth_target(std::move(surface), std::move(trim), min_area, {});
}

std::vector<std::unique_ptr<LineTarget>> make_line_targets(const Body& body, double min_area) {
  std::vector<std::unique_ptr<LineTarget>> targets(body.faces.size());
  tbb::parallel_for(size_t{0}, targets.size(), [&](size_t k) {
    targets[k] = make_line_target(body.faces[k].surface, trim_of(body, static_cast<int>(k)), min_area);
  });
  return targets;
}

namespace {

// Whether the surface is at two hits in places that it joins itself: two hits as near to each other that it does not
// are crossings of two sheets, where it goes through itself. Over the border of the domain anything may be joined
// (seams, poles, a twisted band).
bool are_joined(const Surface& surface, const SurfaceHit& a, const SurfaceHit& b, double reach) {
  const Rectangle domain = surface.domain();
  const SurfaceJet at_a = surface.evaluate(a.u, a.v, 1), at_b = surface.evaluate(b.u, b.v, 1);
  const auto is_near_border = [&](const SurfaceHit& hit, const SurfaceJet& jet) {
    const double u = std::min(hit.u - domain.u.lo, domain.u.hi - hit.u) * glm::length(jet.du());
    const double v = std::min(hit.v - domain.v.lo, domain.v.hi - hit.v) * glm::length(jet.dv());
    return !(u > 2 * reach && v > 2 * reach);
  };
  if (is_near_border(a, at_a) && is_near_border(b, at_b)) return true;
  const Vec3 between = surface.point(0.5 * (a.u + b.u), 0.5 * (a.v + b.v));
  return glm::length(between - at_a.point()) <= reach;
}

}  // namespace

void merge_hits(std::vector<SurfaceHit>& hits, const Line& line, double size,
                const std::function<Vec3(const SurfaceHit&)>& normal,
                const std::function<const Surface*(const SurfaceHit&)>& surface, size_t first) {
  if (hits.size() - first < 2) return;
  std::sort(hits.begin() + static_cast<std::ptrdiff_t>(first), hits.end(),
            [](const SurfaceHit& a, const SurfaceHit& b) {
              if (a.t != b.t) return a.t < b.t;
              return a.face != b.face ? a.face < b.face : a.piece < b.piece;
            });
  const double length = glm::length(line.direction);
  const auto slope = [&](const SurfaceHit& hit) { return glm::dot(normal(hit), line.direction) / length; };
  // What the line's own rounding moves it by; a hit moves by as much over its steepness, and HitFilter lets it.
  const auto rounding = [&](const SurfaceHit& hit) {
    return kShallowSlack * (glm::length(line.origin) + std::abs(hit.t) * length);
  };
  constexpr double kMinSteepness = 1e-4;
  size_t kept = first + 1;
  for (size_t i = first + 1; i < hits.size(); ++i) {
    const SurfaceHit hit = hits[i];
    bool again = false, turned = false;
    // Hits far from the one before them, as nearly all are, need no normals.
    for (size_t k = kept; k-- > first && !again;) {
      const double apart = (hit.t - hits[k].t) * length;
      if (apart > (kSameHit * size + rounding(hit)) / kMinSteepness) break;
      const double a = slope(hit), b = slope(hits[k]);
      const double steepness = std::max(std::min(std::abs(a), std::abs(b)), kMinSteepness);
      const double reach = (kSameHit * size + rounding(hit)) / steepness;
      const Surface* const one = surface(hit);
      again = apart <= reach && (a > 0) == (b > 0) &&
              (!one || one != surface(hits[k]) || are_joined(*one, hits[k], hit, reach));
      // Beside a vertex a line may leave and enter again in between, and what it crosses next tells that it did.
      const double surely = kSameHit * size + rounding(hit);
      if (again && turned && (hits[kept - 1].t - hits[k].t) * length > surely &&
          (hit.t - hits[kept - 1].t) * length > surely)
        again = (i + 1 < hits.size() ? slope(hits[i + 1]) > 0 : false) == (a > 0);
      if (k + 1 == kept) turned = (a > 0) != (b > 0);
    }
    if (!again) hits[kept++] = hit;
  }
  hits.resize(kept);
}

struct LineIntersector::Parts {
  std::vector<std::unique_ptr<LineTarget>> targets;
  std::vector<double> signs;  // of each face's outward normal against the surface's
  struct Piece {
    int target, piece;
  };
  std::vector<Piece> pieces;
  BoxTree tree;
  double size = 1;

  void finish() {
    std::vector<Box3> boxes;
    Box3 all;
    for (int target = 0; target < static_cast<int>(targets.size()); ++target)
      for (int piece = 0; piece < targets[target]->piece_count(); ++piece) {
        pieces.push_back({target, piece});
        const Box3 box = targets[target]->piece_bounds(piece);
        // A piece accepts roots that far outside of its border.
        boxes.push_back(box.bounded() ? box.inflated(kBorderSlack * box.diameter()) : box);
        if (box.bounded()) all.include(box);
      }
    if (!all.empty()) size = all.diameter();
    tree = BoxTree(boxes);
  }
};

LineIntersector::LineIntersector(SurfacePtr surface) : parts_(std::make_unique<Parts>()) {
  parts_->signs.push_back(1);
  parts_->targets.push_back(make_line_target(std::move(surface)));
  parts_->finish();
}

LineIntersector::LineIntersector(const Body& body) : parts_(std::make_unique<Parts>()) {
  for (const Face& face : body.faces) parts_->signs.push_back(face.forward ? 1 : -1);
  parts_->targets = make_line_targets(body);
  parts_->finish();
}

LineIntersector::~LineIntersector() = default;
LineIntersector::LineIntersector(LineIntersector&&) noexcept = default;
LineIntersector& LineIntersector::operator=(LineIntersector&&) noexcept = default;

std::vector<SurfaceHit> LineIntersector::all_hits(const Line& line, const Interval& t) const {
  std::vector<SurfaceHit> result;
  add_all_hits(line, t, result);
  return result;
}

void LineIntersector::add_all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& result) const {
  const size_t first = result.size();
  LineHits hits;
  const PreparedLine prepared(line);
  parts_->tree.along(line, t, [&](int index) {
    const Parts::Piece& piece = parts_->pieces[index];
    hits.clear();
    parts_->targets[piece.target]->piece_hits(piece.piece, prepared, t, hits);
    for (int i = 0; i < hits.size(); ++i)
      result.push_back({hits[i].t, hits[i].u, hits[i].v, piece.target, piece.piece});
  });
  merge_hits(
      result, line, parts_->size,
      [&](const SurfaceHit& hit) {
        const Surface& surface = parts_->targets[hit.face]->surface();
        return parts_->signs[hit.face] * surface.normal(hit.u, hit.v);
      },
      [&](const SurfaceHit& hit) { return &parts_->targets[hit.face]->surface(); }, first);
}

}  // namespace lekalo::geometry
