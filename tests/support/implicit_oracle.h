// Sheets of implicit surfaces on lines, by polynomials in long double: a formula of x, y, z is evaluated over
// polynomials of the line's parameter, whose roots lie between those of their derivatives (sight_oracle.h).
#pragma once

#include "support/sight_oracle.h"

namespace lekalo::oracle::sight {

struct LinePolynomial {
  std::vector<Real> c;  // c[0] + c[1] t + ...

  LinePolynomial(double constant) : c{constant} {}
  explicit LinePolynomial(std::vector<Real> coefficients) : c(std::move(coefficients)) {}
  friend LinePolynomial operator+(const LinePolynomial& a, const LinePolynomial& b) {
    LinePolynomial r(std::vector<Real>(std::max(a.c.size(), b.c.size()), 0));
    for (size_t k = 0; k < a.c.size(); ++k) r.c[k] += a.c[k];
    for (size_t k = 0; k < b.c.size(); ++k) r.c[k] += b.c[k];
    return r;
  }
  friend LinePolynomial operator-(const LinePolynomial& a, const LinePolynomial& b) {
    return a + LinePolynomial(-1.0) * b;
  }
  friend LinePolynomial operator*(const LinePolynomial& a, const LinePolynomial& b) {
    LinePolynomial r(std::vector<Real>(a.c.size() + b.c.size() - 1, 0));
    for (size_t i = 0; i < a.c.size(); ++i)
      for (size_t k = 0; k < b.c.size(); ++k) r.c[i + k] += a.c[i] * b.c[k];
    return r;
  }
};

// F < 0 inside of a box or the ball in it; or F = 0 alone. F() is a function of three numbers of one type.
template <class F>
class ImplicitSheets final : public Solid {
 public:
  ImplicitSheets(const Vec3& lo, const Vec3& hi, bool is_ball, bool closed)
      : lo_{lo.x, lo.y, lo.z}, hi_{hi.x, hi.y, hi.z}, is_ball_(is_ball), closed_(closed) {}

  void crossings(const Real3& start, const Real3& d, Real contact, std::vector<Real>& t) const override {
    const Real3 c{(lo_[0] + hi_[0]) / 2, (lo_[1] + hi_[1]) / 2, (lo_[2] + hi_[2]) / 2};
    const Real near = dot({c.x - start.x, c.y - start.y, c.z - start.z}, d) / dot(d, d);
    const Real3 o{start.x + near * d.x, start.y + near * d.y, start.z + near * d.z};
    const Real size = std::sqrt((hi_[0] - lo_[0]) * (hi_[0] - lo_[0]) + (hi_[1] - lo_[1]) * (hi_[1] - lo_[1]) +
                                (hi_[2] - lo_[2]) * (hi_[2] - lo_[2])),
               reach = size / std::sqrt(dot(d, d));
    const LinePolynomial f = F()(LinePolynomial({o.x, d.x}), LinePolynomial({o.y, d.y}), LinePolynomial({o.z, d.z}));
    std::vector<Real> own;
    for (const Real root : roots(f.c, -reach, reach))
      if (closed_ || in_region({o.x + root * d.x, o.y + root * d.y, o.z + root * d.z})) own.push_back(root + near);
    const auto touches = [&](Real at) { return std::abs(at - 1) < contact; };
    if (std::count_if(own.begin(), own.end(), touches) > 1) std::erase_if(own, touches);
    // Where the surface hardly bends along the way the crossings of one contact are farther apart; then they are told
    // by how deep the way lies between them.
    const Real far = contact * std::sqrt(dot(d, d)),
               deep = far * far / size * slope({start.x + d.x, start.y + d.y, start.z + d.z});
    for (size_t k = 0; contact > 0 && k + 1 < own.size(); ++k) {
      if (own[k] > 1 + contact || own[k + 1] < 1 - contact) continue;
      const Real middle = (own[k] + own[k + 1]) / 2 - near;
      Real height = 0;
      for (size_t i = f.c.size(); i-- > 0;) height = height * middle + f.c[i];
      if (std::abs(height) > deep) continue;
      own.erase(own.begin() + static_cast<std::ptrdiff_t>(k), own.begin() + static_cast<std::ptrdiff_t>(k + 2));
      break;
    }
    if (closed_) {
      std::vector<Real> border;
      if (is_ball_) {
        const Real3 off{o.x - c.x, o.y - c.y, o.z - c.z};
        const Real r = (hi_[0] - lo_[0]) / 2;
        border = roots({dot(off, off) - r * r, 2 * dot(off, d), dot(d, d)}, -reach, reach);
      } else {
        const Real from[] = {o.x, o.y, o.z}, way[] = {d.x, d.y, d.z};
        for (int k = 0; k < 3; ++k)
          if (way[k] != 0) border.push_back((lo_[k] - from[k]) / way[k]), border.push_back((hi_[k] - from[k]) / way[k]);
      }
      for (Real& at : border) at += near;
      if (is_ball_ && std::count_if(border.begin(), border.end(), touches) > 1) std::erase_if(border, touches);
      own.insert(own.end(), border.begin(), border.end());
    }
    t.insert(t.end(), own.begin(), own.end());
  }
  bool contains(const Real3& p) const override { return value(p) < 0 && (!closed_ || in_region(p)); }

 private:
  static Real value(const Real3& p) {
    const auto constant = [](Real number) { return LinePolynomial(std::vector<Real>{number}); };
    return F()(constant(p.x), constant(p.y), constant(p.z)).c[0];
  }
  // |grad F|.
  static Real slope(const Real3& p) {
    constexpr Real h = 1e-6L;
    const Real3 g{(value({p.x + h, p.y, p.z}) - value({p.x - h, p.y, p.z})) / (2 * h),
                  (value({p.x, p.y + h, p.z}) - value({p.x, p.y - h, p.z})) / (2 * h),
                  (value({p.x, p.y, p.z + h}) - value({p.x, p.y, p.z - h})) / (2 * h)};
    return std::sqrt(dot(g, g));
  }
  bool in_region(const Real3& p) const {
    if (!is_ball_)
      return p.x >= lo_[0] && p.y >= lo_[1] && p.z >= lo_[2] && p.x <= hi_[0] && p.y <= hi_[1] && p.z <= hi_[2];
    const Real r = (hi_[0] - lo_[0]) / 2;
    const Real3 off{p.x - (lo_[0] + hi_[0]) / 2, p.y - (lo_[1] + hi_[1]) / 2, p.z - (lo_[2] + hi_[2]) / 2};
    return dot(off, off) <= r * r;
  }

  Real lo_[3], hi_[3];
  bool is_ball_, closed_;
};

}  // namespace lekalo::oracle::sight
