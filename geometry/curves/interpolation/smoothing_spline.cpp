// A natural (or periodic) cubic spline with values z has the second derivatives M of R M = Q^T z and jumps of its third
// derivative D = Q M, where the integral of r''^2 is M^T R M:
//   R: (h_{i-1} + h_i) / 3 on the diagonal, h_i / 6 beside it;  Q^T z: first divided differences' differences.
// At an end with a given slope the divided difference beyond it is that slope: R M = Q^T z + c, c = (-s_1, 0, ...,
// s_N). Where the slope is given a length l before the first point, r'' stays the same up to there: R has l more there.
//
// Smoothing: W (z - p) + stiffness Q M = 0, so (R + stiffness Q^T W^-1 Q) M = Q^T p + c (Reinsch 1967).
//
// Corridor: a point inside its bounds has D_i = 0, so the curve is the spline through the points at their bounds alone,
// with D_i >= 0 at lower and <= 0 at upper ones (Zavyalov et al. 1985, 65): found by an active-set
// search.
#include "geometry/curves/interpolation/smoothing_spline.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "geometry/curves/interpolation/point_parameters.h"
#include "geometry/curves/interpolation/spline_curve.h"

namespace lekalo::geometry {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

Sparse matrix_of(int rows, int columns, const Triplets& entries) {
  Sparse matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// How far before the first and after the last point a slope is given; nothing where the end is free.
struct SlopePlaces {
  std::optional<double> start, end;
};

// Q and R of n points: of those whose second derivatives are unknown, all but free ends.
struct SplineSystem {
  Sparse q, r;
};

// `t` has one more entry when closed.
SplineSystem spline_system(std::span<const double> t, bool closed, const SlopePlaces& slopes) {
  const int count = static_cast<int>(t.size()) - (closed ? 1 : 0);
  const int first = closed || slopes.start ? 0 : 1, last = count - (closed || slopes.end ? 1 : 2);
  const int unknowns = std::max(last - first + 1, 0);
  const auto step = [&](int i) { return i < 0 ? t[count] - t[count - 1] : t[i + 1] - t[i]; };
  Triplets q, r;
  const auto add_step = [&](int k, int from, int to, double h) {
    q.emplace_back(from, k, -1 / h);
    q.emplace_back(to, k, 1 / h);
    r.emplace_back(k, k, h / 3);
  };
  for (int k = 0; k < unknowns; ++k) {
    const int i = first + k;
    if (closed || i > 0)
      add_step(k, i, (i + count - 1) % count, step(i - 1));
    else
      r.emplace_back(k, k, *slopes.start);
    if (closed || i + 1 < count)
      add_step(k, i, (i + 1) % count, step(i));
    else
      r.emplace_back(k, k, *slopes.end);
    if (k + 1 == unknowns && !closed) continue;
    r.emplace_back(k, (k + 1) % unknowns, step(i) / 6);
    r.emplace_back((k + 1) % unknowns, k, step(i) / 6);
  }
  return {matrix_of(count, unknowns, q), matrix_of(unknowns, unknowns, r)};
}

SplineEnd natural_end(const std::optional<Vec3>& tangent) { return {EndRule::natural, tangent, {}}; }

NurbsCurve spline_through(std::span<const Vec3> points, std::span<const double> parameters, bool closed,
                          const EndTangents& ends) {
  return closed ? closed_spline_curve(points, parameters, 3)
                : spline_curve(points, parameters, 3, natural_end(ends.start), natural_end(ends.end));
}

void refuse_ends_of_closed(bool closed, const EndTangents& ends) {
  if (closed && (ends.start || ends.end))
    throw FieldError(ends.start ? "start_tangent" : "end_tangent", "a closed curve has no ends",
                     "leave the tangent out, or closed");
}

struct Slopes {
  std::optional<double> start, end;
};
Slopes coordinate(const EndTangents& ends, int k) {
  Slopes slopes;
  if (ends.start) slopes.start = (*ends.start)[k];
  if (ends.end) slopes.end = (*ends.end)[k];
  return slopes;
}

// One coordinate of a corridor.
class Corridor {
 public:
  // A period of 0 says that it is open.
  Corridor(std::span<const double> t, double period, const Slopes& slopes, std::vector<double> center,
           std::span<const double> half_widths)
      : t_(t),
        period_(period),
        slopes_(slopes),
        center_(std::move(center)),
        half_widths_(half_widths),
        z_(center_),
        side_(t.size(), kFree) {
    for (size_t i = 0; i < t.size(); ++i)
      if (half_widths[i] == 0) side_[i] = kFixed;
  }

  // Each step brings a point to its bound or a smaller integral; there are finitely many sets of bounds.
  std::vector<double> smoothest() {
    const size_t limit = 100 * t_.size();
    for (size_t step = 0; step < limit; ++step) {
      const std::vector<double> goal = smoothest_between_bounds();
      if (!move_to(goal)) continue;
      if (!release_one()) return z_;
    }
    throw FieldError("corridor", "no smoothest curve was found in it", "a corridor of another width");
  }

 private:
  enum Side { kLower = -1, kFixed = 0, kUpper = 1, kFree = 2 };

  double bound(size_t i) const { return center_[i] + side_[i] * half_widths_[i]; }

  std::vector<size_t> at_bounds() const {
    std::vector<size_t> at;
    for (size_t i = 0; i < t_.size(); ++i)
      if (side_[i] != kFree) at.push_back(i);
    return at;
  }

  // Where nothing else bends the curve: its second derivative, by the slopes that are given, is the same everywhere. In
  // the mean at the centers, or through the only point at a bound if there is one; closed, a constant.
  std::vector<double> unbent(const std::vector<size_t>& at) const {
    double t0 = 0, z0 = 0;
    for (size_t i = 0; i < t_.size(); ++i) t0 += t_[i] / t_.size(), z0 += center_[i] / t_.size();
    if (!at.empty()) t0 = t_[at[0]], z0 = bound(at[0]);
    if (period_ > 0) return std::vector<double>(t_.size(), z0);
    double second = 0, slope = 0;
    if (slopes_.start && slopes_.end) second = (*slopes_.end - *slopes_.start) / (t_.back() - t_.front());
    if (slopes_.start)
      slope = *slopes_.start + second * (t0 - t_.front());
    else
      slope = slopes_.end ? *slopes_.end : nearest_slope(t0, z0);
    double shift = 0;  // of the mean of the values from that of the centers
    for (size_t i = 0; i < t_.size() && at.empty(); ++i) shift += second / 2 * (t_[i] - t0) * (t_[i] - t0) / t_.size();
    std::vector<double> result;
    for (const double t : t_) result.push_back(z0 - shift + (slope + second / 2 * (t - t0)) * (t - t0));
    return result;
  }

  // Of the straight line through (t0, z0) that is nearest to the centers.
  double nearest_slope(double t0, double z0) const {
    double tt = 0, tz = 0;
    for (size_t i = 0; i < t_.size(); ++i) {
      tt += (t_[i] - t0) * (t_[i] - t0);
      tz += (t_[i] - t0) * (center_[i] - z0);
    }
    return tz / tt;
  }

  struct Through {
    std::vector<double> t, z, second;
    Eigen::VectorXd jumps;  // of the third derivative
  };
  Through through(const std::vector<size_t>& at) const {
    Through spline;
    for (const size_t i : at) spline.t.push_back(t_[i]), spline.z.push_back(bound(i));
    const bool closed = period_ > 0;
    SlopePlaces places;
    if (slopes_.start) places.start = spline.t.front() - t_.front();
    if (slopes_.end) places.end = t_.back() - spline.t.back();
    if (closed) spline.t.push_back(spline.t[0] + period_);
    spline.second.assign(at.size(), 0);
    spline.jumps = Eigen::VectorXd::Zero(at.size());
    const SplineSystem system = spline_system(spline.t, closed, places);
    if (system.r.rows() > 0) {
      const Eigen::SimplicialLDLT<Sparse> factors(system.r);
      const Eigen::VectorXd z = Eigen::Map<const Eigen::VectorXd>(spline.z.data(), spline.z.size());
      Eigen::VectorXd right = system.q.transpose() * z;
      if (slopes_.start) right[0] -= *slopes_.start;
      if (slopes_.end) right[right.size() - 1] += *slopes_.end;
      const Eigen::VectorXd second = factors.solve(right);
      const int first = closed || slopes_.start ? 0 : 1;
      for (int k = 0; k < second.size(); ++k) spline.second[first + k] = second[k];
      spline.jumps = system.q * second;
    }
    if (closed) spline.z.push_back(spline.z[0]), spline.second.push_back(spline.second[0]);
    return spline;
  }

  // Beyond its ends the second derivative of the spline stays as it is: 0 at free ones.
  double value(const Through& s, double t) const {
    if (period_ > 0 && t < s.t[0]) t += period_;
    const size_t last = s.t.size() - 1;
    const size_t k = std::clamp<size_t>(std::upper_bound(s.t.begin(), s.t.end(), t) - s.t.begin(), 1, last) - 1;
    const double h = s.t[k + 1] - s.t[k], w = (t - s.t[k]) / h, slope = (s.z[k + 1] - s.z[k]) / h;
    const auto beyond = [&](size_t end, double end_slope) {
      const double off = t - s.t[end];
      return s.z[end] + off * (end_slope + off / 2 * s.second[end]);
    };
    if (w < 0) return beyond(0, slope - h / 6 * (2 * s.second[0] + s.second[1]));
    if (w > 1) return beyond(last, slope + h / 6 * (s.second[last - 1] + 2 * s.second[last]));
    return (1 - w) * s.z[k] + w * s.z[k + 1] -
           h * h / 6 * w * (1 - w) * ((2 - w) * s.second[k] + (1 + w) * s.second[k + 1]);
  }

  std::vector<double> smoothest_between_bounds() const {
    const std::vector<size_t> at = at_bounds();
    if (at.size() < 2) return unbent(at);
    const Through spline = through(at);
    std::vector<double> result;
    for (size_t i = 0; i < t_.size(); ++i) result.push_back(side_[i] == kFree ? value(spline, t_[i]) : bound(i));
    return result;
  }

  // Goes as far as the corridor allows; true where that is all the way.
  bool move_to(const std::vector<double>& goal) {
    double part = 1;
    size_t first = t_.size();
    for (size_t i = 0; i < t_.size(); ++i) {
      if (side_[i] != kFree || !(std::abs(goal[i] - center_[i]) > half_widths_[i])) continue;
      const double limit = center_[i] + std::copysign(half_widths_[i], goal[i] - center_[i]);
      const double reached = (limit - z_[i]) / (goal[i] - z_[i]);
      if (first == t_.size() || reached < part) part = std::max(0.0, reached), first = i;
    }
    for (size_t i = 0; i < t_.size(); ++i) z_[i] = part == 1 ? goal[i] : z_[i] + part * (goal[i] - z_[i]);
    if (first == t_.size()) return true;
    side_[first] = goal[first] > center_[first] ? kUpper : kLower;
    z_[first] = bound(first);
    return false;
  }

  // Lets go of the point that its bound pulls most instead of holding it; false where there is none.
  bool release_one() {
    const std::vector<size_t> at = at_bounds();
    if (at.size() < 2) return false;
    const Through spline = through(at);
    const double rounding = 1e-13 * spline.jumps.cwiseAbs().maxCoeff();
    double worst = rounding;
    size_t free = t_.size();
    for (size_t k = 0; k < at.size(); ++k)
      if (side_[at[k]] * spline.jumps[k] > worst) worst = side_[at[k]] * spline.jumps[k], free = at[k];
    if (free == t_.size()) return false;
    side_[free] = kFree;
    return true;
  }

  std::span<const double> t_;
  double period_;
  Slopes slopes_;
  std::vector<double> center_;
  std::span<const double> half_widths_;
  std::vector<double> z_;
  std::vector<int> side_;
};

void check_count(std::span<const Vec3> points) {
  if (points.size() < 3)
    throw FieldError("points", fmt::format("smoothing needs at least 3 points, not {}", points.size()));
}

}  // namespace

NurbsCurve smoothing_spline(std::span<const Vec3> points, std::span<const double> parameters, bool closed,
                            double stiffness, std::span<const double> weights, const EndTangents& ends) {
  check_count(points);
  refuse_ends_of_closed(closed, ends);
  const int count = static_cast<int>(points.size());
  if (!weights.empty() && static_cast<int>(weights.size()) != count)
    throw FieldError("weights", fmt::format("{} weights do not fit {} points", weights.size(), count));
  Eigen::VectorXd softness = Eigen::VectorXd::Ones(count);
  for (size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] > 0))
      throw FieldError("weights", fmt::format("weight {} is {}, not positive", i, weights[i]),
                       "a small one lets the curve pass far from the point; leave out a point that has none");
    softness[i] = 1 / weights[i];
  }
  Eigen::MatrixX3d p(count, 3);
  for (int i = 0; i < count; ++i) p.row(i) << points[i].x, points[i].y, points[i].z;
  SlopePlaces places;
  if (ends.start) places.start = 0;
  if (ends.end) places.end = 0;
  const SplineSystem system = spline_system(parameters, closed, places);
  Eigen::MatrixX3d right = system.q.transpose() * p;
  if (ends.start) right.row(0) -= Eigen::RowVector3d(ends.start->x, ends.start->y, ends.start->z);
  if (ends.end) right.row(right.rows() - 1) += Eigen::RowVector3d(ends.end->x, ends.end->y, ends.end->z);
  const Sparse bent = system.r + stiffness * Sparse(system.q.transpose() * softness.asDiagonal() * system.q);
  const Eigen::SimplicialLDLT<Sparse> factors(bent);
  const Eigen::MatrixX3d second = factors.solve(right);
  const Eigen::MatrixX3d z = p - stiffness * (softness.asDiagonal() * (system.q * second));
  std::vector<Vec3> smooth;
  for (int i = 0; i < count; ++i) smooth.emplace_back(z(i, 0), z(i, 1), z(i, 2));
  return spline_through(smooth, parameters, closed, ends);
}

void check_corridor(std::span<const double> half_widths, size_t points) {
  if (half_widths.size() != points)
    throw FieldError("corridor", fmt::format("{} half-widths do not fit {} points", half_widths.size(), points),
                     "give one length, or one for each point");
  for (size_t i = 0; i < half_widths.size(); ++i)
    if (!(half_widths[i] >= 0))
      throw FieldError("corridor", fmt::format("half-width {} is negative", i), "0 holds the point fast");
}

NurbsCurve corridor_spline(std::span<const Vec3> points, std::span<const double> parameters, bool closed,
                           std::span<const double> half_widths, const EndTangents& ends) {
  check_count(points);
  refuse_ends_of_closed(closed, ends);
  check_corridor(half_widths, points.size());
  const std::span<const double> t = parameters.first(points.size());
  const double period = closed ? parameters.back() - parameters.front() : 0;
  std::vector<Vec3> smooth(points.begin(), points.end());
  for (int k = 0; k < 3; ++k) {
    std::vector<double> center;
    for (const Vec3& p : points) center.push_back(p[k]);
    const std::vector<double> z = Corridor(t, period, coordinate(ends, k), center, half_widths).smoothest();
    for (size_t i = 0; i < z.size(); ++i) smooth[i][k] = z[i];
  }
  return spline_through(smooth, parameters, closed, ends);
}

TypeDeclaration smoothing_spline_type() {
  return declare(Category::curve, "smoothing_spline",
                 "Cubic spline that passes near points, as smooth as a stiffness or a corridor lets it be.")
      .example("points: [[0, 0], [1, 1.2], [2, 0.9], [3, 1.1], [4, 0]], corridor: 0.2")
      .field("points", points().count(3), "points that the curve passes by; those of a closed one are not repeated")
      .field("knots", knots(), kPointKnots, "chord_length")
      .field("closed", boolean(),
             "periodic curve, smooth over its seam; an open one has no second derivative at ends without a tangent",
             "false")
      .optional("stiffness", number().non_negative(),
                "weight of the integral of the squared second derivative beside the sum of squared distances")
      .optional("weights", numbers(), "weight of each squared distance; all 1 when left out; with stiffness")
      .optional("corridor", numbers(),
                "how far each coordinate may be from that of its point: one length, or one for each point. The "
                "smoothest such curve")
      .optional("start_tangent", vector(), "derivative by t at the start of an open curve")
      .optional("end_tangent", vector(), "derivative by t at its end")
      .shows({"control_polygon", "knots"})
      .built_by([](const Fields& f) {
        const std::vector<Vec3>& points = f.points("points");
        const bool closed = f.boolean("closed");
        const std::vector<double> parameters = point_parameters(f.knots("knots"), points, closed);
        if (f.has("stiffness") == f.has("corridor"))
          throw FieldError(f.has("corridor") ? "corridor" : "points",
                           f.has("corridor") ? "stiffness and corridor do not go together" : "how smooth is not said",
                           "either stiffness or corridor");
        if (f.has("corridor") && f.has("weights"))
          throw FieldError("weights", "a corridor has no weights", "a length of corridor for each point");
        EndTangents ends;
        if (f.has("start_tangent")) ends.start = f.vec3("start_tangent");
        if (f.has("end_tangent")) ends.end = f.vec3("end_tangent");
        if (f.has("stiffness"))
          return smoothing_spline(points, parameters, closed, f.number("stiffness"),
                                  f.has("weights") ? f.numbers("weights") : std::vector<double>(), ends);
        std::vector<double> half_widths = f.numbers("corridor");
        if (half_widths.size() == 1) half_widths.assign(points.size(), half_widths[0]);
        return corridor_spline(points, parameters, closed, half_widths, ends);
      });
}

}  // namespace lekalo::geometry
