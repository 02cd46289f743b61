// Functions of closed T-meshes, round and round (declared in t_spline.h).
#include <algorithm>
#include <cmath>

#include "geometry/surfaces/splines/t_spline.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// The parameters as they are in the first period, and how many periods farther.
class Seam {
 public:
  Seam(const std::vector<LocalKnots>& functions, bool along_u, const Interval& domain) : lo_(domain.lo) {
    period_ = domain.width();
    std::vector<double> all{lo_};
    for (const LocalKnots& function : functions)
      for (const double knot : along_u ? function.u : function.v) all.push_back(knot - rounds(knot) * period_);
    std::sort(all.begin(), all.end());
    for (const double knot : all)
      if (knots_.empty() || knot - knots_.back() > kSameKnot * period_) knots_.push_back(knot);
  }
  // The knot so many rounds farther, knots that are one all alike.
  double moved(double knot, int more) const {
    const double round = rounds(knot), base = knot - round * period_;
    auto at = std::lower_bound(knots_.begin(), knots_.end(), base - kSameKnot * period_);
    if (at == knots_.end()) at = std::prev(at);
    return *at + (round + more) * period_;
  }

 private:
  double rounds(double knot) const { return std::floor((knot - lo_) / period_ + kSameKnot); }
  double lo_, period_ = 0;
  std::vector<double> knots_;
};

std::vector<std::vector<double>> over_domain(const Seam& seam, const std::vector<double>& knots,
                                             const Interval& domain) {
  std::vector<std::vector<double>> result;
  const double period = domain.width();
  const int first = static_cast<int>(std::floor((domain.lo - knots.back()) / period)),
            last = static_cast<int>(std::ceil((domain.hi - knots.front()) / period));
  for (int k = first; k <= last; ++k) {
    std::vector<double> moved;
    for (const double knot : knots) moved.push_back(seam.moved(knot, k));
    if (moved.front() < domain.hi && moved.back() > domain.lo) result.push_back(std::move(moved));
  }
  return result;
}

}  // namespace

RepeatedFunctions repeated(const std::vector<LocalKnots>& functions, const Rectangle& domain, const Periods& periods) {
  RepeatedFunctions result;
  const Seam seam_u(functions, true, domain.u), seam_v(functions, false, domain.v);
  for (size_t i = 0; i < functions.size(); ++i) {
    using Many = std::vector<std::vector<double>>;
    const Many all_u = periods.u > 0 ? over_domain(seam_u, functions[i].u, domain.u) : Many{functions[i].u};
    const Many all_v = periods.v > 0 ? over_domain(seam_v, functions[i].v, domain.v) : Many{functions[i].v};
    for (const std::vector<double>& u : all_u)
      for (const std::vector<double>& v : all_v) {
        result.functions.push_back({u, v});
        result.of.push_back(static_cast<int>(i));
      }
  }
  return result;
}

}  // namespace lekalo::geometry
