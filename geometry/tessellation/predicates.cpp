// Exact sign of the orientation determinant by floating-point expansions, after Shewchuk, "Adaptive precision
// floating-point arithmetic and fast robust geometric predicates", 1997: a sum of doubles that do not overlap stands
// for a number that no single double holds; the largest component gives the sign.
#include "geometry/tessellation/predicates.h"

#include <cmath>

namespace lekalo::geometry {

namespace {

constexpr double kHalfUlp = 0x1p-53;

// Adds b to the expansion e of n components (increasing magnitude, non-overlapping); zero components are kept.
int grow(double* e, int n, double b) {
  double sum = b;
  for (int i = 0; i < n; ++i) {
    const double total = sum + e[i];
    const double virtual_part = total - sum;
    e[i] = (sum - (total - virtual_part)) + (e[i] - virtual_part);
    sum = total;
  }
  e[n] = sum;
  return n + 1;
}

// ax by - ax cy - cx by - ay bx + ay cx + cy bx, whose products are exact as pairs of doubles.
double exact_orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double factors[6][2] = {{a.x, b.y}, {-a.x, c.y}, {-c.x, b.y}, {-a.y, b.x}, {a.y, c.x}, {c.y, b.x}};
  double expansion[12];
  int n = 0;
  for (const auto& f : factors) {
    const double product = f[0] * f[1];
    n = grow(expansion, n, std::fma(f[0], f[1], -product));
    n = grow(expansion, n, product);
  }
  for (int i = n - 1; i >= 0; --i)
    if (expansion[i] != 0) return expansion[i];
  return 0;
}

}  // namespace

double orient2d(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  const double bound = (3 + 16 * kHalfUlp) * kHalfUlp * (std::abs(left) + std::abs(right));
  if (std::abs(determinant) > bound) return determinant;
  return exact_orientation(a, b, c);
}

bool surely_in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Vec2 p = a - d, q = b - d, r = c - d;
  const double pq = p.x * q.y, qp = q.x * p.y;
  const double qr = q.x * r.y, rq = r.x * q.y;
  const double rp = r.x * p.y, pr = p.x * r.y;
  const double pp = glm::dot(p, p), qq = glm::dot(q, q), rr = glm::dot(r, r);
  const double determinant = pp * (qr - rq) + qq * (rp - pr) + rr * (pq - qp);
  const double permanent = pp * (std::abs(qr) + std::abs(rq)) + qq * (std::abs(rp) + std::abs(pr)) +
                           rr * (std::abs(pq) + std::abs(qp));
  return determinant > (10 + 96 * kHalfUlp) * kHalfUlp * permanent;
}

}  // namespace lekalo::geometry
