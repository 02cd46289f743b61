#include "geometry/queries/differential/plane_lines.h"

#include <Eigen/SVD>
#include <algorithm>
#include <vector>

namespace lekalo::geometry {

namespace {

// Of the largest difference: what differences may have across their plane.
constexpr double kInPlane = 1e-12;
constexpr int kPlaces = 12;  // of a piece in each direction

// The unit vector that all are perpendicular to; its largest coordinate is positive.
std::optional<Vec3> perpendicular(const std::vector<Vec3>& vectors) {
  Eigen::MatrixX3d rows(static_cast<Eigen::Index>(std::max<size_t>(vectors.size(), 3)), 3);
  rows.setZero();
  for (size_t i = 0; i < vectors.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) << vectors[i].x, vectors[i].y, vectors[i].z;
  const Eigen::JacobiSVD<Eigen::MatrixX3d, Eigen::ColPivHouseholderQRPreconditioner> svd(
      rows, Eigen::ComputeFullV | Eigen::ComputeThinU);
  if (!(svd.singularValues()(2) <= kInPlane * svd.singularValues()(0))) return std::nullopt;
  const Eigen::Vector3d n = svd.matrixV().col(2);
  Eigen::Index most = 0;
  n.cwiseAbs().maxCoeff(&most);
  const double sign = n(most) < 0 ? -1 : 1;
  return sign * Vec3(n.x(), n.y(), n.z());
}

// Vectors that span what the derivatives by u, by v and the differences of points span.
struct Spans {
  std::vector<Vec3> u, v, all;
};

// A polynomial's derivative has the differences of its control points for coefficients.
bool add_control_points(const SurfacePiece& piece, const Vec3& origin, Spans& spans) {
  if (!piece.is_rational()) return false;
  for (const Vec4& p : piece.points)
    if (p.w != 1) return false;
  const int columns = piece.degree_v + 1;
  const auto at = [&](int i, int j) { return Vec3(piece.points[i * columns + j]); };
  for (int i = 0; i <= piece.degree_u; ++i)
    for (int j = 0; j <= piece.degree_v; ++j) {
      spans.all.push_back(at(i, j) - origin);
      if (i > 0) spans.u.push_back(at(i, j) - at(i - 1, j));
      if (j > 0) spans.v.push_back(at(i, j) - at(i, j - 1));
    }
  return true;
}

void add_places(const Surface& surface, const Rectangle& part, const Vec3& origin, Spans& spans) {
  for (int i = 0; i < kPlaces; ++i)
    for (int j = 0; j < kPlaces; ++j) {
      const double u = part.u.lo + part.u.width() * (i + 0.5) / kPlaces,
                   v = part.v.lo + part.v.width() * (j + 0.5) / kPlaces;
      const SurfaceJet jet = surface.evaluate(u, v, 1);
      spans.all.push_back(jet.point() - origin);
      spans.u.push_back(jet.du());
      spans.v.push_back(jet.dv());
    }
}

}  // namespace

PlaneLines plane_lines(const Surface& surface) {
  const Rectangle domain = surface.domain();
  const Vec3 origin = surface.point(domain.u.middle(), domain.v.middle());
  Spans spans;
  for (const SurfacePiece& piece : surface.pieces())
    if (!add_control_points(piece, origin, spans)) add_places(surface, piece.domain, origin, spans);
  return {perpendicular(spans.all), perpendicular(spans.u), perpendicular(spans.v)};
}

}  // namespace lekalo::geometry
