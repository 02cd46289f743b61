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

namespace {

// An unevaluated sum of two doubles, about 106 bits (Dekker 1971).
struct DoubleDouble {
  double hi = 0, lo = 0;
};

DoubleDouble exact_sum(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}
DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble hi = exact_sum(a.hi, b.hi), lo = exact_sum(a.lo, b.lo);
  const DoubleDouble sum = exact_sum(hi.hi, hi.lo + lo.hi);
  return exact_sum(sum.hi, sum.lo + lo.lo);
}
DoubleDouble operator-(const DoubleDouble& a) { return {-a.hi, -a.lo}; }
DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const double product = a.hi * b.hi;
  return exact_sum(product, std::fma(a.hi, b.hi, -product) + (a.hi * b.lo + a.lo * b.hi));
}

double in_circle_determinant(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Vec2* corners[3] = {&a, &b, &c};
  DoubleDouble x[3], y[3], square[3];
  for (int k = 0; k < 3; ++k) {
    x[k] = exact_sum(corners[k]->x, -d.x);
    y[k] = exact_sum(corners[k]->y, -d.y);
    square[k] = x[k] * x[k] + y[k] * y[k];
  }
  DoubleDouble sum;
  for (int k = 0; k < 3; ++k) {
    const int m = (k + 1) % 3, n = (k + 2) % 3;
    sum = sum + square[k] * (x[m] * y[n] + -(x[n] * y[m]));
  }
  return sum.hi;
}

}  // namespace

bool surely_in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Vec2 p = a - d, q = b - d, r = c - d;
  const double pq = p.x * q.y, qp = q.x * p.y;
  const double qr = q.x * r.y, rq = r.x * q.y;
  const double rp = r.x * p.y, pr = p.x * r.y;
  const double pp = glm::dot(p, p), qq = glm::dot(q, q), rr = glm::dot(r, r);
  const double determinant = pp * (qr - rq) + qq * (rp - pr) + rr * (pq - qp);
  const double permanent =
      pp * (std::abs(qr) + std::abs(rq)) + qq * (std::abs(rp) + std::abs(pr)) + rr * (std::abs(pq) + std::abs(qp));
  const double bound = (10 + 96 * kHalfUlp) * kHalfUlp * permanent;
  if (std::abs(determinant) > bound) return determinant > 0;
  // Twice the bits; its own error is well below 2^-96 of the permanent.
  return in_circle_determinant(a, b, c, d) > 0x1p-96 * permanent;
}

}  // namespace lekalo::geometry
