#include "geometry/queries/line_intersections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

#include "geometry/queries/box_tree.h"
#include "geometry/queries/line_cells.h"
#include "geometry/queries/trim.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Cells of one piece when the target is built; what is not flat by then is halved along the line that asks.
constexpr int kMostCellsPerPiece = 1024;
constexpr int kDeepestCut = 9;

// Of a surface that only its enclosures tell about: each cell costs several evaluations over intervals.
constexpr size_t kMostEnclosedCells = 1 << 13;

// Cells up to this roughness are not cut further: few enough to be found quickly, flat enough that most lines are
// decided without halving.
constexpr double kFlat = 0.2;

// Keeps hits in the interval and inside the trims.
class Acceptance {
 public:
  explicit Acceptance(std::shared_ptr<const TrimRegion> trim) : trim_(std::move(trim)) {
    if (trim_) slack_ = kTrimSlack * std::max(trim_->u_range().width(), trim_->v_range().width());
  }
  bool keeps(const LineHit& hit, const Interval& t, const Line& line, const Surface& surface) const {
    if (!(hit.t >= t.lo && hit.t <= t.hi)) return false;
    if (!trim_ || trim_->contains(hit.u, hit.v, slack_)) return true;
    // The rounding of a line moves its hit with a surface that it hardly crosses much further than the slack, and the
    // neighbour across the edge, which it may cross steeply, has accepted it.
    const Interval &u = trim_->u_range(), &v = trim_->v_range();
    const double beyond = std::max({u.lo - hit.u, hit.u - u.hi, v.lo - hit.v, hit.v - v.hi});
    if (beyond > kShallowReach * std::max(u.width(), v.width())) return false;
    const SurfaceJet jet = surface.evaluate(hit.u, hit.v, 1);
    const Vec3 normal = glm::cross(jet.du(), jet.dv());
    const double area = glm::length(normal), length = glm::length(line.direction);
    if (!(area > 0)) return false;
    const double rounding = kShallowSlack * (glm::length(line.origin) + std::abs(hit.t) * length);
    const double sine = std::abs(glm::dot(normal, line.direction)) / (area * length);
    // The least length of a unit of parameters.
    const double stretch = area / std::max(glm::length(jet.du()), glm::length(jet.dv()));
    const double moved = rounding / (sine * stretch);
    return moved > slack_ &&
           trim_->contains(hit.u, hit.v, std::min(moved, kShallowReach * std::max(u.width(), v.width())));
  }
  const TrimRegion* trim() const { return trim_.get(); }

 private:
  std::shared_ptr<const TrimRegion> trim_;
  double slack_ = 0;
};

// A surface with a closed form: one piece.
class FormulaTarget final : public LineTarget {
 public:
  FormulaTarget(SurfacePtr surface, std::shared_ptr<const TrimRegion> trim)
      : surface_(std::move(surface)), acceptance_(std::move(trim)), box_(geometry::bounds(*surface_)) {
    if (const TrimRegion* region = acceptance_.trim(); region && !box_.bounded())
      box_ = surface_->enclose({region->u_range(), region->v_range()}, 0).values[0];
  }
  int piece_count() const override { return 1; }
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
  Acceptance acceptance_;
  Box3 box_;
};

void FormulaTarget::trimmed_hits(const Line& line, const Interval& t, LineHits& hits) const {
  LineHits all;
  surface_->line_hits(line, t, all);
  for (int i = 0; i < all.size(); ++i)
    if (acceptance_.keeps(all[i], t, line, *surface_)) hits.add(all[i]);
}

// The cut that flattens more, judged by the second differences of the control points: across the direction in which the
// patch bends more, or, where twist is most of it, across the longer of the cell's extents x and y.
bool flattens_across_u(const PatchView& patch, double x, double y) {
  const int p = patch.degree_u, q = patch.degree_v;
  const auto size = [](const Vec4& d) { return std::abs(d.x) + std::abs(d.y) + std::abs(d.z) + std::abs(d.w); };
  double bend_u = 0, bend_v = 0, twist = 0;
  for (int i = 0; i <= p; ++i)
    for (int j = 0; j <= q; ++j) {
      const Vec4& at = patch.at(i, j);
      if (i > 0 && i < p) bend_u = std::max(bend_u, size(patch.at(i - 1, j) - at - at + patch.at(i + 1, j)));
      if (j > 0 && j < q) bend_v = std::max(bend_v, size(patch.at(i, j - 1) - at - at + patch.at(i, j + 1)));
      if (i > 0 && j > 0)
        twist = std::max(twist, size(patch.at(i - 1, j - 1) - patch.at(i - 1, j) - patch.at(i, j - 1) + at));
    }
  bend_u *= p * (p - 1);
  bend_v *= q * (q - 1);
  twist *= p * q;
  return twist >= std::max(bend_u, bend_v) ? x >= y : bend_u >= bend_v;
}

// Rational Bezier pieces, cut into flat cells.
class PatchTarget final : public LineTarget {
 public:
  PatchTarget(SurfacePtr surface, std::vector<SurfacePiece> pieces, std::shared_ptr<const TrimRegion> trim)
      : surface_(std::move(surface)), acceptance_(std::move(trim)) {
    for (SurfacePiece& piece : pieces) {
      Patch patch;
      patch.map_u = piece.map_u;
      patch.map_v = piece.map_v;
      patch.domain = piece.domain;
      patch.s = {piece.map_u.rational(piece.domain.u.lo), piece.map_u.rational(piece.domain.u.hi)};
      patch.t = {piece.map_v.rational(piece.domain.v.lo), piece.map_v.rational(piece.domain.v.hi)};
      patch.degree_u = piece.degree_u;
      patch.degree_v = piece.degree_v;
      const int index = static_cast<int>(patches_.size());
      patches_.push_back(patch);
      // Coordinates relative to the piece's own centre: halving and evaluation then round at the piece's size, not at
      // its distance from the origin.
      Box3 box;
      for (const Vec4& p : piece.points)
        if (p.w > 0) box.include(Vec3(p) / p.w);
      const Vec3 center = box.empty() ? Vec3(0) : box.center();
      for (Vec4& p : piece.points) p = Vec4(Vec3(p) - p.w * center, p.w);
      int budget = kMostCellsPerPiece;
      cut(part_of(std::move(piece.points), index), index, center, 0, 0, 1, 1, 0, budget);
    }
    cells_.shrink_to_fit();
    points_.shrink_to_fit();
  }

  int piece_count() const override { return static_cast<int>(cells_.size()); }

  Box3 piece_bounds(int i) const override {
    const Cell& cell = cells_[i];
    Box3 box;
    double size = 0;
    const PatchView view = view_of(cell);
    for (int k = 0; k < view.count(); ++k) {
      const Vec4& p = view.points[k];
      if (!(p.w > 0)) return bounds(*surface_);
      box.include(Vec3(p) / p.w + cell.center);
      size = std::max({size, std::abs(p.x / p.w), std::abs(p.y / p.w), std::abs(p.z / p.w)});
    }
    return box.inflated(1e-15 * (size + glm::length(cell.center)));
  }

  void piece_hits(int i, const PreparedLine& line, const Interval& t, LineHits& hits) const override {
    const Cell& cell = cells_[i];
    double foot;
    const LineBasis basis = line.near(cell.center, foot);
    CellHits found;
    intersect(view_of(cell), cell.model, basis, found);
    const Patch& patch = patches_[cell.patch];
    for (int k = 0; k < found.size(); ++k) {
      LineHit hit;
      hit.t = foot + found[k].t;
      const double x = cell.x + cell.hx * found[k].x, y = cell.y + cell.hy * found[k].y;
      hit.u = patch.domain.u.clamp(patch.map_u.natural(patch.s.middle() + 0.5 * patch.s.width() * x));
      hit.v = patch.domain.v.clamp(patch.map_v.natural(patch.t.middle() + 0.5 * patch.t.width() * y));
      if (acceptance_.keeps(hit, t, line.line(), *surface_)) hits.add(hit);
    }
  }
  bool meets_once(int i, const Vec3& direction) const override {
    return geometry::meets_once(cells_[i].model, direction);
  }
  const Surface& surface() const override { return *surface_; }
  size_t memory() const override {
    return sizeof *this + cells_.size() * sizeof(Cell) + points_.size() * sizeof(Vec4) +
           patches_.size() * sizeof(Patch);
  }

 private:
  struct Patch {
    ParameterMap map_u, map_v;
    Rectangle domain;  // natural
    Interval s, t;     // rational parameters of the piece
    int degree_u, degree_v;
  };
  struct Cell {
    CellModel model;  // relative to the centre
    Vec3 center;
    double x, y, hx, hy;  // place in the piece's square [-1, 1]^2
    int patch;
    uint32_t first_point;
  };

  PatchView view_of(const Cell& cell) const {
    return {points_.data() + cell.first_point, patches_[cell.patch].degree_u, patches_[cell.patch].degree_v};
  }

  // Part of a patch: its control points and their model.
  struct Part {
    std::vector<Vec4> points;
    CellModel model;
  };
  Part part_of(std::vector<Vec4> points, int patch) const {
    const CellModel model = model_of(PatchView{points.data(), patches_[patch].degree_u, patches_[patch].degree_v});
    return {std::move(points), model};
  }

  void cut(const Part& part, int patch, const Vec3& center, double x, double y, double hx, double hy, int depth,
           int& budget) {
    if (roughness(part.model) <= kFlat || depth >= kDeepestCut || budget <= 1) {
      cells_.push_back({part.model, center, x, y, hx, hy, patch, static_cast<uint32_t>(points_.size())});
      points_.insert(points_.end(), part.points.begin(), part.points.end());
      return;
    }
    --budget;
    const PatchView view{part.points.data(), patches_[patch].degree_u, patches_[patch].degree_v};
    const bool along_x = flattens_across_u(view, glm::length(part.model.dx), glm::length(part.model.dy));
    std::vector<Vec4> first(part.points.size()), second(part.points.size());
    along_x ? halve_u(view, first.data(), second.data()) : halve_v(view, first.data(), second.data());
    const Part two[] = {part_of(std::move(first), patch), part_of(std::move(second), patch)};
    if (along_x)
      hx *= 0.5;
    else
      hy *= 0.5;
    for (const double side : {-1.0, 1.0})
      cut(two[side > 0], patch, center, along_x ? x + side * hx : x, along_x ? y : y + side * hy, hx, hy, depth + 1,
          budget);
  }

  SurfacePtr surface_;
  Acceptance acceptance_;
  std::vector<Patch> patches_;
  std::vector<Cell> cells_;
  std::vector<Vec4> points_;
};

// Any other surface: rectangles certified by its own enclosures.
class EnclosureTarget final : public LineTarget {
 public:
  EnclosureTarget(SurfacePtr surface, const std::vector<SurfacePiece>& pieces, std::shared_ptr<const TrimRegion> trim)
      : surface_(std::move(surface)), acceptance_(std::move(trim)) {
    std::vector<Rectangle> boxes;
    for (const SurfacePiece& piece : pieces) boxes.push_back(piece.domain);
    cut(boxes);
  }
  int piece_count() const override { return static_cast<int>(cells_.size()); }
  Box3 piece_bounds(int i) const override { return surface_->enclose(cells_[i].box, 0).values[0]; }
  void piece_hits(int i, const PreparedLine& line, const Interval& t, LineHits& hits) const override {
    const Cell& cell = cells_[i];
    double foot;
    LineBasis basis = line.near(cell.model.point, foot);
    basis.line.origin += cell.model.point;
    CellHits found;
    intersect(*surface_, cell.box, cell.model, cell.proxy, basis, found);
    for (int k = 0; k < found.size(); ++k) {
      LineHit hit;
      hit.t = foot + found[k].t;
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
  };
  // Halves the largest cells that are not flat first: around singular points none ever is, and those are small soon.
  void cut(const std::vector<Rectangle>& boxes) {
    const auto size_of = [](const Cell& cell) {
      return glm::length(cell.model.dx) + glm::length(cell.model.dy) + cell.model.variation;
    };
    const auto smaller = [&](const Cell& a, const Cell& b) { return size_of(a) < size_of(b); };
    std::priority_queue<Cell, std::vector<Cell>, decltype(smaller)> rough(smaller);
    const auto add = [&](const Rectangle& box) {
      const Cell cell{model_of(*surface_, box), box, {}};
      if (roughness(cell.model) <= kFlat)
        cells_.push_back(cell);
      else
        rough.push(cell);
    };
    for (const Rectangle& box : boxes) add(box);
    while (!rough.empty() && cells_.size() + rough.size() < kMostEnclosedCells) {
      const Cell cell = rough.top();
      rough.pop();
      Rectangle first = cell.box, second = cell.box;
      if (glm::length(cell.model.dx) >= glm::length(cell.model.dy))
        first.u.hi = second.u.lo = cell.box.u.middle();
      else
        first.v.hi = second.v.lo = cell.box.v.middle();
      add(first);
      add(second);
    }
    for (; !rough.empty(); rough.pop()) cells_.push_back(rough.top());
    for (Cell& cell : cells_) cell.proxy = proxy_of(*surface_, cell.box);
  }

  SurfacePtr surface_;
  Acceptance acceptance_;
  std::vector<Cell> cells_;
};

}  // namespace

std::unique_ptr<LineTarget> make_line_target(SurfacePtr surface, std::shared_ptr<const TrimRegion> trim) {
  if (surface->has_line_formula()) return std::make_unique<FormulaTarget>(std::move(surface), std::move(trim));
  std::vector<SurfacePiece> pieces = surface->pieces();
  const bool rational =
      std::all_of(pieces.begin(), pieces.end(), [](const SurfacePiece& piece) { return piece.is_rational(); });
  if (rational) return std::make_unique<PatchTarget>(std::move(surface), std::move(pieces), std::move(trim));
  return std::make_unique<EnclosureTarget>(std::move(surface), pieces, std::move(trim));
}

std::vector<std::unique_ptr<LineTarget>> make_line_targets(const Body& body) {
  std::vector<std::unique_ptr<LineTarget>> targets;
  for (int face = 0; face < static_cast<int>(body.faces.size()); ++face)
    targets.push_back(make_line_target(body.faces[face].surface, trim_of(body, face)));
  return targets;
}

void merge_hits(std::vector<SurfaceHit>& hits, const Line& line, double size,
                const std::function<Vec3(const SurfaceHit&)>& normal, size_t first) {
  if (hits.size() - first < 2) return;
  std::sort(hits.begin() + static_cast<std::ptrdiff_t>(first), hits.end(),
            [](const SurfaceHit& a, const SurfaceHit& b) {
              if (a.t != b.t) return a.t < b.t;
              return a.face != b.face ? a.face < b.face : a.piece < b.piece;
            });
  const double length = glm::length(line.direction);
  const auto slope = [&](const SurfaceHit& hit) { return glm::dot(normal(hit), line.direction) / length; };
  const auto rounding = [&](const SurfaceHit& hit) { return 4e-16 * std::abs(hit.t) * length; };
  constexpr double kLeastSteepness = 1e-4;
  size_t kept = first + 1;
  for (size_t i = first + 1; i < hits.size(); ++i) {
    const SurfaceHit hit = hits[i];
    bool again = false;
    // Hits far from the one before them, as nearly all are, need no normals.
    for (size_t k = kept; k-- > first && !again;) {
      const double apart = (hit.t - hits[k].t) * length;
      if (apart > kSameHit * size / kLeastSteepness + rounding(hit)) break;
      const double a = slope(hit), b = slope(hits[k]);
      const double steepness = std::max(std::min(std::abs(a), std::abs(b)), kLeastSteepness);
      again = apart <= kSameHit * size / steepness + rounding(hit) && (a > 0) == (b > 0);
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
        boxes.push_back(targets[target]->piece_bounds(piece));
        if (boxes.back().bounded()) all.include(boxes.back());
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
      first);
}

}  // namespace lekalo::geometry
