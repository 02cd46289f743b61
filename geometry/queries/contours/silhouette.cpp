#include "geometry/queries/contours/silhouette.h"

#include <cmath>
#include <vector>

#include "geometry/queries/contours/analytic/closed_contours.h"
#include "geometry/queries/contours/contour_parts.h"
#include "geometry/queries/contours/contours_of_function.h"
#include "geometry/queries/contours/picture_cusps.h"
#include "geometry/surfaces/triangles/bezier_triangle.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Vanishes on the silhouette.
SurfaceFunction outline(const ViewOf& view) {
  return {true,
          [view](const auto& s, const auto& s_u, const auto& s_v) { return dot(sight(view, s), cross(s_u, s_v)); }};
}

}  // namespace

// Whether the line of sight runs in the surface everywhere in a part of its domain: a cylinder along its axis, a cone
// from its tip, a facet. All that is seen of it are its borders.
static bool is_edge_on(const Surface& surface, const Rectangle& part, const ViewOf& view) {
  constexpr int kSteps = 6;
  constexpr double kFlat = 1e-12;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double u = part.u.lo + part.u.width() * (i + 0.5) / kSteps,
                   v = part.v.lo + part.v.width() * (j + 0.5) / kSteps;
      const Vec3 sight = view.central ? surface.point(u, v) - view.direction_or_eye : view.direction_or_eye;
      if (std::abs(glm::dot(surface.normal(u, v), sight)) > kFlat * glm::length(sight)) return false;
    }
  return true;
}

// Whether a Bezier triangle turns one side to the viewer everywhere. The tangent plane holds the eye E (or the
// direction of a parallel view, of weight 0) where det(R_a, R_b, R_c, E) = 0, R being the homogeneous point: a
// polynomial whose Bernstein coefficients are sums of determinants of control points. Of one sign, and not by rounding,
// they leave no outline.
static bool shows_one_side(const TriangularNet& net, const ViewOf& view) {
  constexpr double kSure = 1e-12;
  constexpr int kMaxDegreeTried = 6;
  const int m = net.degree - 1;
  if (net.degree > kMaxDegreeTried) return false;
  const Vec4 eye(view.direction_or_eye, view.central ? 1 : 0);
  double factorial[kMaxDegreeTried] = {1};
  for (int k = 1; k < kMaxDegreeTried; ++k) factorial[k] = k * factorial[k - 1];
  const auto ways = [&](int i, int j, int k) { return 1 / (factorial[i] * factorial[j] * factorial[k]); };
  const auto count = static_cast<size_t>(TriangularNet::count(3 * m));
  std::vector<double> sums(count, 0.0), sizes(count, 0.0);
  each_index(m, [&](int i, int j, int k) {
    each_index(m, [&](int i2, int j2, int k2) {
      each_index(m, [&](int i3, int j3, int k3) {
        const double term = ways(i, j, k) * ways(i2, j2, k2) * ways(i3, j3, k3) *
                            glm::determinant(glm::dmat4(net.at(i + 1, j), net.at(i2, j2 + 1), net.at(i3, j3), eye));
        const auto at = static_cast<size_t>(TriangularNet::index_in(3 * m, i + i2 + i3, j + j2 + j3));
        sums[at] += term, sizes[at] += std::abs(term);
      });
    });
  });
  bool all_front = true, all_back = true;
  for (size_t k = 0; k < count; ++k) {
    all_front = all_front && sums[k] > kSure * sizes[k];
    all_back = all_back && sums[k] < -kSure * sizes[k];
  }
  return all_front || all_back;
}

// Whether all control points of polynomial patches lie in a plane in which the patches do not fold: the Bernstein
// coefficients of the area element have one sign, or are rounding. Where it vanishes at a side, to any order, there is
// no outline either (a wall below a curve that touches the ground).
static bool is_unfolded_plane(const Surface& surface) {
  constexpr double kRounding = 1e-12;
  const std::vector<SurfacePiece> pieces = surface.pieces();
  std::vector<Vec3> all;
  for (const SurfacePiece& piece : pieces) {
    if (!piece.is_rational()) return false;
    for (const Vec4& p : piece.points) {
      if (p.w != 1) return false;
      all.emplace_back(p);
    }
  }
  // Across the point farthest from the first, and the one farthest from their line.
  Vec3 along(0), normal(0);
  for (const Vec3& p : all)
    if (glm::length(p - all[0]) > glm::length(along)) along = p - all[0];
  for (const Vec3& p : all)
    if (const Vec3 n = glm::cross(along, p - all[0]); glm::length(n) > glm::length(normal)) normal = n;
  if (!(glm::length(normal) > kRounding * glm::dot(along, along))) return false;
  normal = glm::normalize(normal);
  for (const Vec3& p : all)
    if (std::abs(glm::dot(normal, p - all[0])) > kRounding * glm::length(along)) return false;
  bool up = false, down = false;
  for (const SurfacePiece& piece : pieces) {
    const int p = piece.degree_u, q = piece.degree_v;
    const auto at = [&](int i, int j) { return Vec3(piece.points[static_cast<size_t>(i * (q + 1) + j)]); };
    const auto choose = [](int n, int k) {
      double c = 1;
      for (int m = 1; m <= k; ++m) c = c * (n - k + m) / m;
      return c;
    };
    std::vector<double> sums(static_cast<size_t>(2 * p * 2 * q), 0.0), sizes = sums;
    for (int i = 0; i < p; ++i)
      for (int j = 0; j <= q; ++j)
        for (int k = 0; k <= p; ++k)
          for (int l = 0; l < q; ++l) {
            const double term = choose(p - 1, i) * choose(q, j) * choose(p, k) * choose(q - 1, l) *
                                glm::dot(normal, glm::cross(at(i + 1, j) - at(i, j), at(k, l + 1) - at(k, l)));
            const auto index = static_cast<size_t>((i + k) * 2 * q + j + l);
            sums[index] += term, sizes[index] += std::abs(term);
          }
    for (size_t k = 0; k < sums.size(); ++k) {
      up = up || sums[k] > kRounding * sizes[k];
      down = down || sums[k] < -kRounding * sizes[k];
    }
  }
  return up != down;
}

static Contours smooth_silhouette(const SurfacePtr& surface, const ViewOf& view) {
  if (const auto net = triangular_net(*surface); net && shows_one_side(*net, view)) return {};
  if (is_unfolded_plane(*surface)) return {};
  if (is_edge_on(*surface, surface->domain(), view)) return {};
  if (auto exact = closed_silhouette(surface, view, kSamePoint * bounds(*surface).diameter())) return *exact;
  Contours found =
      contours_of(surface, outline(view), [&](const Rectangle& piece) { return is_edge_on(*surface, piece, view); });
  for (Contour& contour : found.branches) contour.cusps = picture_cusps(*surface, contour, view);
  return found;
}

Contours silhouette(const SurfacePtr& surface, const ViewOf& given) {
  demand_bounded(*surface);
  const ViewOf view = checked(given);
  return of_parts(surface, 0, [&](const SurfacePtr& part) { return smooth_silhouette(part, view); });
}

}  // namespace lekalo::geometry
