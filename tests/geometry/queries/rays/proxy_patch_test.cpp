// Proxies of parts of surfaces: what they say of their distance from the surface, against samples.
#include "geometry/queries/rays/proxy_patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "geometry/surfaces/analytic/formula_surface.h"
#include "geometry/surfaces/surface_checks.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::geometry::proxy_patch_test {
namespace {

FormulaSurface surface(const std::array<std::string, 3>& point, const Rectangle& domain) {
  return FormulaSurface(point_formulas(point, {"u", "v"}), domain, {});
}

// Rectangles of a share of the domain; the largest ratios of sampled differences to their bounds.
struct Ratios {
  double off = 0, slope = 0;
};
Ratios ratios(const Surface& one, double share, int count) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  const Rectangle domain = one.domain();
  const auto part = [&](const Interval& range) {
    const double width = share * range.width(), lo = range.lo + unit(random) * (range.width() - width);
    return Interval{lo, lo + width};
  };
  Ratios result;
  for (int i = 0; i < count; ++i) {
    const Rectangle box{part(domain.u), part(domain.v)};
    const ProxyPatch proxy = proxy_of(one, box);
    const double hu = 0.5 * box.u.width(), hv = 0.5 * box.v.width();
    for (int k = 0; k < 64; ++k) {
      const double s = unit(random), t = unit(random);
      const PatchPoint p = evaluate(proxy.view(), s, t);
      const SurfaceJet jet = one.evaluate(box.u.lo + s * box.u.width(), box.v.lo + t * box.v.width(), 1);
      const double off = glm::length(p.point - jet.point()), off_x = glm::length(0.5 * p.ds - hu * jet.du()),
                   off_y = glm::length(0.5 * p.dt - hv * jet.dv());
      result.off = tests::worse(result.off, off / proxy.off);
      result.slope = std::max({result.slope, off_x / proxy.off_x, off_y / proxy.off_y});
    }
  }
  return result;
}

TEST(ProxyPatch, KeepsItsBounds) {
  const std::string radius = "(2 + cos(u/2)*sin(v) - sin(u/2)*sin(2*v))";
  const FormulaSurface klein = surface({radius + "*cos(u)", radius + "*sin(u)", "sin(u/2)*sin(v) + cos(u/2)*sin(2*v)"},
                                       {{0, kTwoPi}, {0, kTwoPi}});
  const FormulaSurface rough =
      surface({"u + 0.1*exp(u*v)", "v*(1 + u^4) - u^2*v^3", "sqrt(1 + u^2*v) + sin(3*u*v)"}, {{0, 1}, {0, 1}});
  const int count = tests::tier_count(2000, 100);
  for (const FormulaSurface* one : {&klein, &rough}) {
    for (const double share : {0.5, 0.1, 0.02, 0.002}) {
      const Ratios found = ratios(*one, share, count);
      EXPECT_LE(found.off, 1) << share;
      EXPECT_LE(found.slope, 1) << share;
      // Nor are they much too wide where enclosures are not.
      if (share == 0.02) {
        EXPECT_GE(found.off, 0.02);
      }
    }
  }
}

// The bounds shrink with the fourth power of the rectangle where fourth derivatives are enclosed.
TEST(ProxyPatch, HasTightBounds) {
  const FormulaSurface one = surface({"cos(u)*(2 + cos(v))", "sin(u)*(2 + cos(v))", "sin(v)"}, {{0, 6}, {0, 6}});
  const auto off = [&](double width) { return proxy_of(one, {{1, 1 + width}, {2, 2 + width}}).off; };
  EXPECT_LE(off(0.1), 1e-5);
  EXPECT_LE(off(0.05), off(0.1) / 14);
}

}  // namespace
}  // namespace lekalo::geometry::proxy_patch_test
