#include "geometry/queries/contours/surface_joints.h"

#include <algorithm>
#include <cmath>

#include "geometry/curves/operations/smooth_pieces.h"

namespace lekalo::geometry {

namespace {

Interval moved(const Interval& x, double sign, double shift) {
  return sign > 0 ? Interval(x.lo + shift, x.hi + shift) : Interval(shift - x.hi, shift - x.lo);
}

bool is_same(const DomainMotion& a, const DomainMotion& b, const Rectangle& domain) {
  return a.sign_u == b.sign_u && a.sign_v == b.sign_v && std::abs(a.shift_u - b.shift_u) <= 1e-9 * domain.u.width() &&
         std::abs(a.shift_v - b.shift_v) <= 1e-9 * domain.v.width();
}

// First b, then a.
DomainMotion product(const DomainMotion& a, const DomainMotion& b) {
  return {a.sign_u * b.sign_u, a.sign_u * b.shift_u + a.shift_u, a.sign_v * b.sign_v, a.sign_v * b.shift_v + a.shift_v};
}

// Derivatives over the part of a piece, as seen from the first tile.
struct Slopes {
  std::array<std::array<Interval, 2>, 3> j;
};

}  // namespace

Rectangle DomainMotion::of(const Rectangle& box) const {
  return {moved(box.u, sign_u, shift_u), moved(box.v, sign_v, shift_v)};
}
Rectangle DomainMotion::back(const Rectangle& box) const {
  return {moved(box.u, sign_u, -sign_u * shift_u), moved(box.v, sign_v, -sign_v * shift_v)};
}

SurfaceJoints::SurfaceJoints(const Surface& surface, double tolerance) : surface_(surface), domain_(surface.domain()) {
  for (const SurfacePiece& piece : surface.pieces()) pieces_.push_back(piece.domain);
  motions_.push_back({});
  find_joints(true, tolerance);
  goes_on_u_ = motions_.size() > 1;
  const size_t of_u = motions_.size();
  find_joints(false, tolerance);
  goes_on_v_ = motions_.size() > of_u;
  const size_t count = motions_.size();
  for (size_t a = 1; a < count; ++a)
    for (size_t b = 1; b < count; ++b) {
      const DomainMotion both = product(motions_[a], motions_[b]);
      if (std::none_of(motions_.begin(), motions_.end(),
                       [&](const DomainMotion& one) { return is_same(one, both, domain_); }))
        motions_.push_back(both);
    }
}

// The borders where u (or v) is constant, each against each: the surface beyond border `to` is that inside of `from`.
void SurfaceJoints::find_joints(bool of_u, double tolerance) {
  constexpr int kPlaces = 12;
  const DegenerateEdges poles = surface_.degenerate_edges();
  const bool is_pole[2] = {of_u ? poles.u_min : poles.v_min, of_u ? poles.u_max : poles.v_max};
  const Interval across = of_u ? domain_.u : domain_.v, along = of_u ? domain_.v : domain_.u;
  const double period = of_u ? surface_.periods().v : surface_.periods().u;
  const auto point = [&](double x, double y) { return of_u ? surface_.point(x, y) : surface_.point(y, x); };
  for (const bool to : {false, true})
    for (const bool from : {false, true}) {
      if (is_pole[to] || is_pole[from]) continue;
      const double at_to = to ? across.hi : across.lo, at_from = from ? across.hi : across.lo;
      for (const double sign : {1.0, -1.0})
        for (const double turn : {0.0, 0.5}) {
          if ((turn > 0 && !(period > 0)) || (to == from && sign > 0 && turn == 0)) continue;
          const double shift = (sign > 0 ? 0 : along.lo + along.hi) + turn * period;
          bool same = true;
          for (int k = 0; same && k <= kPlaces; ++k) {
            const double y = along.lo + along.width() * (k + (k == 0 || k == kPlaces ? 0 : 0.137)) / kPlaces;
            double image = sign * y + shift;
            if (period > 0 && image > along.hi) image -= period;
            same = glm::length(point(at_to, image) - point(at_from, y)) <= tolerance;
          }
          if (!same) continue;
          // Beyond `to` what is inside of `from`: the same way if these are opposite, mirrored if they are one.
          const double sign_across = to == from ? -1 : 1, shift_across = to == from ? 2 * at_to : at_to - at_from;
          motions_.push_back(of_u ? DomainMotion{sign_across, shift_across, sign, shift}
                                  : DomainMotion{sign, shift, sign_across, shift_across});
        }
    }
}

double SurfaceJoints::apart(const Vec2& a, const Vec2& b) const {
  double least = kInfinity;
  for (const DomainMotion& motion : motions_) {
    const Vec2 by = a - motion.of(b);
    least = std::min(least, std::max(std::abs(by.x) / domain_.u.width(), std::abs(by.y) / domain_.v.width()));
  }
  return least;
}

bool SurfaceJoints::is_same_place(const Vec2& a, const Vec2& b, double near) const { return apart(a, b) <= near; }

bool SurfaceJoints::is_one_to_one(const Rectangle& rectangle, KnownEnclosures& known) const {
  std::vector<Slopes> parts;
  std::array<std::array<double, 2>, 3> middle{};
  double covered = 0;
  for (const DomainMotion& motion : motions_)
    for (const Rectangle& piece : pieces_) {
      const Rectangle moved_piece = motion.of(piece);
      const Rectangle common{intersect(moved_piece.u, rectangle.u), intersect(moved_piece.v, rectangle.v)};
      const double area = common.u.empty() || common.v.empty() ? 0 : common.u.width() * common.v.width();
      if (!(area > 1e-12 * rectangle.u.width() * rectangle.v.width())) continue;
      covered += area;
      Rectangle box = motion.back(common);
      box = {intersect(box.u, piece.u), intersect(box.v, piece.v)};
      const KnownEnclosures::First& s = known.of(surface_, box);
      Slopes slopes;
      for (int k = 0; k < 3; ++k) {
        slopes.j[k] = {Interval(motion.sign_u) * along(s.du, k), Interval(motion.sign_v) * along(s.dv, k)};
        for (int i = 0; i < 2; ++i) middle[k][i] += slopes.j[k][i].middle();
      }
      parts.push_back(slopes);
    }
  if (covered < (1 - 1e-9) * rectangle.u.width() * rectangle.v.width()) return false;
  // Columns of about unit length.
  std::array<double, 2> scale{};
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < 3; ++k) scale[i] += middle[k][i] * middle[k][i];
    scale[i] = 1 / std::sqrt(scale[i]);
    if (!std::isfinite(scale[i])) return false;
    for (int k = 0; k < 3; ++k) middle[k][i] *= scale[i];
  }
  std::array<std::array<double, 3>, 2> c;
  if (!root_search::solve_for<2, 3>(middle, c)) return false;
  const double count = static_cast<double>(parts.size());
  for (const Slopes& slopes : parts)
    for (int i = 0; i < 2; ++i) {
      double sum = 0;
      for (int j = 0; j < 2; ++j) {
        Interval e(i == j ? 1.0 : 0.0);
        for (int k = 0; k < 3; ++k) e -= Interval(c[i][k]) * (slopes.j[k][j] * Interval(scale[j] * count));
        sum = next_up(sum + magnitude(e));
      }
      if (!(sum < 1)) return false;
    }
  return true;
}

}  // namespace lekalo::geometry
