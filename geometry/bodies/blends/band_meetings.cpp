#include "geometry/bodies/blends/band_meetings.h"

#include <Eigen/Dense>
#include <cmath>

namespace lekalo::geometry {

namespace {

constexpr int kMaxIterations = 30;
constexpr double kSolved = 1e-12;  // of the size
constexpr double kSatisfied = 1e-10;

Eigen::Vector3d column(const Vec3& v) { return {v.x, v.y, v.z}; }

// Newton's (or Gauss-Newton's) iteration of `residual`, which writes the matrix too; true where it ends at a zero.
template <int N, class Residual>
bool solved(Eigen::Matrix<double, N, 1>& x, double size, const Residual& residual) {
  bool once_more = true;
  for (int i = 0; i < kMaxIterations; ++i) {
    Eigen::Matrix<double, 3, N> matrix;
    Eigen::Vector3d value;
    residual(x, matrix, value);
    const Eigen::Matrix<double, N, 1> step = matrix.colPivHouseholderQr().solve(value);
    if (!step.allFinite()) return false;
    x -= step;
    const double moved = (matrix * step).norm();
    if (moved <= kSolved * size) {
      if (!once_more) return value.norm() <= kSatisfied * size;
      once_more = false;
    }
  }
  return false;
}

double size_of(const BlendBand& band) {
  const Interval s = band.range();
  return glm::length(band.at(s.lo, 0).point - band.at(s.hi, 1).point) +
         glm::length(band.at(s.middle(), 0).point - band.at(s.middle(), 1).point) +
         glm::length(band.at(s.middle(), 0).point);
}

}  // namespace

std::optional<BandOnCurve> border_on_curve(const BlendBand& band, double z, const Curve& curve, double s, double t) {
  Eigen::Vector2d x(s, t);
  Vec3 point(0);
  const bool found = solved<2>(x, size_of(band), [&](const auto& at, auto& matrix, auto& value) {
    const BlendBand::Local p = band.at(at(0), z);
    const CurveJet c = curve.evaluate(at(1), 1);
    point = p.point;
    matrix.col(0) = column(p.ds), matrix.col(1) = column(-c.d[1]);
    value = column(p.point - c.d[0]);
  });
  if (!found) return std::nullopt;
  return BandOnCurve{x(0), z, x(1), point};
}

std::optional<BandOnCurve> band_on_curve(const BlendBand& band, const Curve& curve, const BandOnCurve& near) {
  Eigen::Vector3d x(near.s, near.z, near.t);
  Vec3 point(0);
  const bool found = solved<3>(x, size_of(band), [&](const auto& at, auto& matrix, auto& value) {
    const BlendBand::Local p = band.at(at(0), at(1));
    const CurveJet c = curve.evaluate(at(2), 1);
    point = p.point;
    matrix.col(0) = column(p.ds), matrix.col(1) = column(p.dz), matrix.col(2) = column(-c.d[1]);
    value = column(p.point - c.d[0]);
  });
  if (!found) return std::nullopt;
  return BandOnCurve{x(0), x(1), x(2), point};
}

std::optional<BandOnSurface> line_on_surface(const BlendBand& band, double z, const Surface& surface,
                                             const BandOnSurface& near) {
  Eigen::Vector3d x(near.s, near.place.x, near.place.y);
  const bool found = solved<3>(x, size_of(band), [&](const auto& at, auto& matrix, auto& value) {
    const BlendBand::Local p = band.at(at(0), z);
    const SurfaceJet c = surface.evaluate(at(1), at(2), 1);
    matrix.col(0) = column(p.ds), matrix.col(1) = column(-c.du()), matrix.col(2) = column(-c.dv());
    value = column(p.point - c.point());
  });
  if (!found) return std::nullopt;
  return BandOnSurface{x(0), Vec2(x(1), x(2))};
}

std::optional<BandOnSurface> section_on_surface(const BlendBand& band, double s, const Surface& surface,
                                                const BandOnSurface& near) {
  Eigen::Vector3d x(near.s, near.place.x, near.place.y);
  const bool found = solved<3>(x, size_of(band), [&](const auto& at, auto& matrix, auto& value) {
    const BlendBand::Local p = band.at(s, at(0));
    const SurfaceJet c = surface.evaluate(at(1), at(2), 1);
    matrix.col(0) = column(p.dz), matrix.col(1) = column(-c.du()), matrix.col(2) = column(-c.dv());
    value = column(p.point - c.point());
  });
  if (!found) return std::nullopt;
  return BandOnSurface{x(0), Vec2(x(1), x(2))};
}

double first_approach(const Curve& curve, bool from_end, const Vec3& p, const Vec3& d) {
  constexpr int kSteps = 128;
  const Interval domain = curve.domain();
  const Vec3 along = glm::normalize(d);
  const auto at = [&](int k) {
    const double share = static_cast<double>(k) / kSteps;
    return from_end ? domain.hi - share * domain.width() : domain.lo + share * domain.width();
  };
  const auto distance = [&](int k) {
    const Vec3 off = curve.point(at(k)) - p;
    return glm::length(off - glm::dot(off, along) * along);
  };
  double last = distance(0);
  for (int k = 1; k <= kSteps; ++k) {
    const double here = distance(k);
    if (here >= last) return at(k - 1);
    last = here;
  }
  return at(kSteps);
}

}  // namespace lekalo::geometry
