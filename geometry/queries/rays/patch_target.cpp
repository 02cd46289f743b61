#include "geometry/queries/rays/patch_target.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "geometry/queries/rays/cell_newton.h"
#include "geometry/queries/rays/line_group.h"

namespace lekalo::geometry {

namespace {

// Cells of one piece when the target is built; what is not flat by then is halved along the line that asks.
constexpr int kMaxCellsPerPiece = 1024;
constexpr int kDeepestCut = 9;

static_assert(1 << kDeepestCut <= PatchCell::kPlaces);

// Boxes of cells are numbers of steps from one end of the piece's reach to the other.
constexpr double kSteps = 65535;
Vec3 in_space(const std::array<uint16_t, 3>& steps, const Vec3& reach) {
  return (2 / kSteps * Vec3(steps[0], steps[1], steps[2]) - 1.0) * reach;
}

}  // namespace

// Cuts one piece after the other.
class PatchTarget::Cutter {
 public:
  Cutter(const PatchTarget& target, double min_area, std::vector<Cell>& cells)
      : target_(target), min_area_(min_area), cells_(cells) {}

  void cut(int patch) {
    const PatchView view = target_.view_of(target_.patches_[patch]);
    patch_ = patch;
    budget_ = kMaxCellsPerPiece;
    room_.resize(static_cast<size_t>(view.count()) * (2 * kDeepestCut + 1));
    std::copy(view.points, view.points + view.count(), room_.begin());
    cut(room_.data(), geometry::model_of({room_.data(), view.degree_u, view.degree_v}), {}, 0);
  }

 private:
  bool is_done(const CellModel& model, int depth) const {
    return roughness(model) <= kFlat || depth == kDeepestCut || budget_ <= 1 ||
           glm::length(glm::cross(model.dx, model.dy)) < 0.25 * min_area_;
  }

  // What lies behind the cell's points is free for its halves.
  void cut(const Vec4* points, const CellModel& model, const CellPlace& place, int depth) {
    const Patch& patch = target_.patches_[patch_];
    const PatchView view{points, patch.degree_u, patch.degree_v};
    if (is_done(model, depth)) return add(view, model, place);
    --budget_;
    Vec4 *const first = room_.data() + (2 * depth + 1) * view.count(), *const second = first + view.count();
    const bool along_x = flattens_across_u(view, glm::length(model.dx), glm::length(model.dy));
    along_x ? halve_u(view, first, second) : halve_v(view, first, second);
    CellPlace half = place;
    (along_x ? half.hx : half.hy) *= 0.5;
    const CellModel models[] = {geometry::model_of({first, view.degree_u, view.degree_v}),
                                geometry::model_of({second, view.degree_u, view.degree_v})};
    for (const int side : {-1, 1}) {
      CellPlace at = half;
      (along_x ? at.x : at.y) += side * (along_x ? half.hx : half.hy);
      cut(side < 0 ? first : second, models[side > 0], at, depth + 1);
    }
  }

  // What of a cell the trim keeps.
  TrimRegion::Coverage coverage(const CellPlace& place) const {
    const TrimRegion* trim = target_.acceptance_.trim();
    if (!trim) return TrimRegion::Coverage::inside;
    const Patch& patch = target_.patches_[patch_];
    const auto natural = [](const ParameterMap& map, const Interval& range, double x, double half) -> Interval {
      const double middle = range.middle(), reach = 0.5 * range.width();
      return {map.natural(middle + reach * (x - half)), map.natural(middle + reach * (x + half))};
    };
    return trim->coverage(
        {natural(patch.map_u, patch.s, place.x, place.hx), natural(patch.map_v, patch.t, place.y, place.hy)});
  }

  void add(const PatchView& view, const CellModel& m, const CellPlace& place) {
    const TrimRegion::Coverage kept = coverage(place);
    if (kept == TrimRegion::Coverage::outside) return;
    Box3 box;
    for (int k = 0; k < view.count(); ++k) {
      const Vec4& p = view.points[k];
      if (!(p.w > 0)) {
        box = Box3::everything();
        break;
      }
      box.include(Vec3(p) / p.w);
    }
    Cell cell{
        PatchCell(view, m, place), {1, 1, 1}, {}, static_cast<uint32_t>(patch_), kept == TrimRegion::Coverage::inside};
    if (box.bounded() && target_.patches_[patch_].is_bounded()) {
      // A thousandth of a step is much more than the rounding.
      const Vec3 steps = 0.5 * kSteps / target_.patches_[patch_].reach;
      const Vec3 lo = 0.5 * kSteps + steps * box.lo - 1e-3, hi = 0.5 * kSteps + steps * box.hi + 1e-3;
      for (int k = 0; k < 3; ++k) {
        cell.lo[k] = static_cast<uint16_t>(std::clamp(std::floor(lo[k]), 0.0, kSteps));
        cell.hi[k] = static_cast<uint16_t>(std::clamp(std::ceil(hi[k]), 0.0, kSteps));
      }
    }
    cells_.push_back(cell);
  }

  const PatchTarget& target_;
  double min_area_;
  std::vector<Cell>& cells_;
  std::vector<Vec4> room_;
  int patch_ = 0, budget_ = 0;
};

PatchTarget::PatchTarget(SurfacePtr surface, std::vector<SurfacePiece> pieces, std::shared_ptr<const TrimRegion> trim,
                         double min_area)
    : surface_(std::move(surface)), acceptance_(std::move(trim)) {
  for (const SurfacePiece& piece : pieces) {
    Patch patch;
    patch.map_u = piece.map_u;
    patch.map_v = piece.map_v;
    patch.domain = piece.domain;
    patch.s = {piece.map_u.rational(piece.domain.u.lo), piece.map_u.rational(piece.domain.u.hi)};
    patch.t = {piece.map_v.rational(piece.domain.v.lo), piece.map_v.rational(piece.domain.v.hi)};
    patch.degree_u = piece.degree_u;
    patch.degree_v = piece.degree_v;
    patch.first_point = points_.size();
    // With weights that are not positive the piece leaves the hull of its control points.
    Box3 box;
    for (const Vec4& p : piece.points) box.include(p.w > 0 ? Vec3(p) / p.w : Vec3(kInfinity));
    if (!box.bounded()) box = bounds(*surface_, piece);
    if (box.bounded()) patch.center = box.center();
    // Fused: far off the origin the product's rounding would open gaps between pieces.
    const Vec3& c = patch.center;
    for (const Vec4& p : piece.points)
      points_.push_back({std::fma(-p.w, c.x, p.x), std::fma(-p.w, c.y, p.y), std::fma(-p.w, c.z, p.z), p.w});
    if (box.bounded()) {
      patch.reach = glm::max(box.hi - patch.center, patch.center - box.lo);
      for (size_t k = patch.first_point; k < points_.size(); ++k)
        if (points_[k].w > 0) patch.reach = glm::max(patch.reach, glm::abs(Vec3(points_[k]) / points_[k].w));
      // The rounding of cutting, and a width for what is flat.
      patch.reach += 1e-14 * (patch.reach.x + patch.reach.y + patch.reach.z) + 1e-300;
    }
    patches_.push_back(patch);
  }
  cut_all(min_area);
  points_.shrink_to_fit();
}

void PatchTarget::cut_all(double min_area) {
  constexpr size_t kStretch = 16;  // pieces for one thread at a time
  std::vector<std::vector<Cell>> cut((patches_.size() + kStretch - 1) / kStretch);
  tbb::parallel_for(size_t{0}, cut.size(), [&](size_t k) {
    Cutter cutter(*this, min_area, cut[k]);
    for (size_t i = k * kStretch; i < std::min((k + 1) * kStretch, patches_.size()); ++i)
      cutter.cut(static_cast<int>(i));
  });
  size_t count = 0;
  for (const std::vector<Cell>& some : cut) count += some.size();
  cells_.reserve(count);
  for (const std::vector<Cell>& some : cut) cells_.insert(cells_.end(), some.begin(), some.end());
}

Box3 PatchTarget::piece_bounds(int i) const {
  const Cell& cell = cells_[i];
  const Patch& patch = patches_[cell.patch];
  if (!patch.is_bounded()) return Box3::everything();
  const Vec3 &center = patch.center, &reach = patch.reach;
  const bool is_known = cell.lo[0] <= cell.hi[0];
  const Box3 box{is_known ? in_space(cell.lo, reach) : -reach, is_known ? in_space(cell.hi, reach) : reach};
  return Box3{box.lo + center, box.hi + center}.inflated(1e-15 * glm::length(center));
}

LineHit PatchTarget::natural_hit(const Patch& patch, const PatchCell& cell, double foot_point,
                                 const CellHit& found) const {
  const CellPlace place = cell.place();
  const double x = place.x + place.hx * found.x, y = place.y + place.hy * found.y;
  LineHit hit;
  hit.t = foot_point + found.t;
  hit.u = patch.domain.u.clamp(patch.map_u.natural(patch.s.middle() + 0.5 * patch.s.width() * x));
  hit.v = patch.domain.v.clamp(patch.map_v.natural(patch.t.middle() + 0.5 * patch.t.width() * y));
  return hit;
}

void PatchTarget::piece_hits(int i, const PreparedLine& line, const Interval& t, LineHits& hits) const {
  const Cell& cell = cells_[i];
  const Patch& patch = patches_[cell.patch];
  double foot_point;
  const LineBasis& basis = line.near(patch.center, foot_point);
  CellHits found;
  intersect(view_of(patch), cell.cell, basis, {t.lo - foot_point, t.hi - foot_point}, found);
  for (int k = 0; k < found.size(); ++k) {
    const LineHit hit = natural_hit(patch, cell.cell, foot_point, found[k]);
    const bool keeps = cell.whole ? t.contains(hit.t) : acceptance_.keeps(hit, t, line.line(), *surface_);
    if (keeps) hits.add(hit);
  }
}

void PatchTarget::group_hits(int first, int end, const unsigned* asked, const LineGroup& lines, GroupHits& hits) const {
  std::array<LineGroup::Start, LineGroup::kMaxLines * GroupHits::kMaxPieces> starts;
  size_t count = 0;
  const auto iterate = [&](const Patch& patch) {
    std::array<LineGroup::End, LineGroup::kMaxLines * GroupHits::kMaxPieces> ends;
    lines.iterate(view_of(patch), std::span(starts.data(), count), ends.data());
    for (size_t k = 0; k < count; ++k) {
      const LineGroup::Start& start = starts[k];
      GroupHit hit{start.line, start.piece, ends[k].verdict == Verdict::unsure, {}};
      if (ends[k].verdict == Verdict::none) continue;
      if (!hit.is_open) {
        const Cell& cell = cells_[start.piece];
        hit.hit = natural_hit(patch, cell.cell, lines.foot_point(start.line), ends[k].hit);
        const Interval t = lines.range(start.line);
        if (!(cell.whole ? t.contains(hit.hit.t) : acceptance_.keeps(hit.hit, t, lines.line(start.line), *surface_)))
          continue;
      }
      hits.add(hit);
    }
    count = 0;
  };
  for (int i = first; i < end; ++i) {
    const Cell& cell = cells_[i];
    LineGroup::Guesses guesses;
    unsigned met = lines.may_meet(asked[i - first], cell.cell, patches_[cell.patch].center, guesses);
    for (; met; met &= met - 1) {
      const int line = std::countr_zero(met);
      const Guess guess = guesses.of(line);
      if (judge(guess, kBorderSlack, kBorderSlack) == Verdict::none) continue;
      if (is_certain(guess))
        starts[count++] = {line, i, &cell.cell, guess};
      else
        hits.add({line, i, true, {}});
    }
    if (count > 0 && (i + 1 == end || cells_[i + 1].patch != cell.patch)) iterate(patches_[cell.patch]);
  }
}

bool PatchTarget::meets_once(int i, const Vec3& direction) const {
  return geometry::meets_once(cells_[i].cell, direction);
}

SurfaceJet PatchTarget::jet_at(int i, double u, double v, const Vec3& near) const {
  const Patch& patch = patches_[cells_[i].patch];
  constexpr auto affine = ParameterMap::Kind::affine;
  if (patch.map_u.kind != affine || patch.map_v.kind != affine) return LineTarget::jet_at(i, u, v, near);
  const double of_s = 1 / patch.s.width(), of_t = 1 / patch.t.width();
  const PatchPoint p = evaluate(view_of(patch), (u - patch.s.lo) * of_s, (v - patch.t.lo) * of_t);
  SurfaceJet jet;
  jet.order = 1;
  jet.d(0, 0) = patch.center + p.point;
  jet.d(1, 0) = of_s * p.ds;
  jet.d(0, 1) = of_t * p.dt;
  return jet;
}

size_t PatchTarget::memory() const {
  return sizeof *this + cells_.size() * sizeof(Cell) + points_.size() * sizeof(Vec4) + patches_.size() * sizeof(Patch);
}

}  // namespace lekalo::geometry
