// On a patch of degree n over [-1, 1]^2 an error e of interpolation in Chebyshev points is that of T_(n+1) but for a
// slowly varying factor: derivatives of order k are at most T_(n+1)^(k)(1) e (Markov; Rivlin 1990, 2.7).
#include "geometry/queries/rays/fitted_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/queries/rays/fitted_pieces.h"
#include "geometry/spatial/box_tree.h"

namespace lekalo::geometry {

namespace {

constexpr int kDegree = 7, kPoints = kDegree + 1;
constexpr int kDerivatives = (kMaxSurfaceOrder + 1) * (kMaxSurfaceOrder + 2) / 2;

using Net = std::array<Vec3, kPoints * kPoints>;  // (i, j) at i * kPoints + j
using Weights = std::array<std::array<double, kPoints>, kMaxSurfaceOrder + 1>;

// The derivatives of Bernstein's polynomials of degree 7 at s up to kOrder, those of order k in row k: the functions of
// degree 7 - k, differences of which they are.
template <int kOrder>
Weights bernstein_derivatives(double s) {
  Weights rows;
  std::array<double, kPoints> b{1};
  const double r = 1 - s;
  const auto keep = [&](int k) {
    std::array<double, kPoints>& row = rows[k];
    row = b;
    for (int m = k; m > 0; --m) {
      const int n = kDegree - m + 1;
      row[n] = n * row[n - 1];
      for (int i = n - 1; i > 0; --i) row[i] = n * (row[i - 1] - row[i]);
      row[0] *= -n;
    }
  };
#pragma GCC unroll 8
  for (int n = 0; n <= kDegree; ++n) {
    if (n > 0) {
      b[n] = s * b[n - 1];
      for (int i = n - 1; i > 0; --i) b[i] = r * b[i] + s * b[i - 1];
      b[0] *= r;
    }
    if (kDegree - n <= kOrder) keep(kDegree - n);
  }
  return rows;
}

// The part of a Bezier polygon over [lo, hi] of [0, 1] (de Casteljau twice), each `step` points apart.
void restrict_to(Vec3* points, int step, double lo, double hi) {
  if (hi < 1)
    for (int n = kDegree; n > 0; --n)
      for (int i = kDegree; i > kDegree - n; --i) {
        Vec3& p = points[i * step];
        p = (1 - hi) * points[(i - 1) * step] + hi * p;
      }
  if (lo > 0) {
    const double s = lo / hi;
    for (int n = kDegree; n > 0; --n)
      for (int i = 0; i < n; ++i) {
        Vec3& p = points[i * step];
        p = (1 - s) * p + s * points[(i + 1) * step];
      }
  }
}

// T_(n+1)^(k)(1) = product over m < k of ((n+1)^2 - m^2) / (2 m + 1).
double largest_derivative(int k) {
  double product = 1;
  for (int m = 0; m < k; ++m) product *= (kPoints * kPoints - m * m) / (2.0 * m + 1);
  return product;
}

struct Patch {
  Rectangle domain;
  Net net;
  double distance = 0;                     // of the surface
  std::array<double, kDerivatives> apart;  // how far its derivatives are from the surface's
  std::array<Box3, kDerivatives> whole;
};

// How far derivatives i times by u and j times by v of patch and surface are apart.
double derivative_distance(const Patch& patch, int i, int j) {
  return patch.distance * largest_derivative(i) * largest_derivative(j) * std::pow(2 / patch.domain.u.width(), i) *
         std::pow(2 / patch.domain.v.width(), j);
}

// Boxes of the derivatives of a net over a rectangle: hulls of their own nets.
void include_ranges(const Patch& patch, const Net& net, const Rectangle& box, int order, Box3* boxes) {
  Net of_u = net;
  double scale_u = 1;
  for (int i = 0; i <= order; ++i) {
    if (i > 0) {
      scale_u *= (kDegree - i + 1) / box.u.width();
      for (int a = 0; a <= kDegree - i; ++a)
        for (int b = 0; b < kPoints; ++b) of_u[a * kPoints + b] = of_u[(a + 1) * kPoints + b] - of_u[a * kPoints + b];
    }
    Net both = of_u;
    double scale = scale_u;
    for (int j = 0; i + j <= order; ++j) {
      if (j > 0) {
        scale *= (kDegree - j + 1) / box.v.width();
        for (int a = 0; a <= kDegree - i; ++a)
          for (int b = 0; b <= kDegree - j; ++b)
            both[a * kPoints + b] = both[a * kPoints + b + 1] - both[a * kPoints + b];
      }
      Box3 hull;
      for (int a = 0; a <= kDegree - i; ++a)
        for (int b = 0; b <= kDegree - j; ++b) hull.include(both[a * kPoints + b]);
      const Vec3 apart(patch.apart[SurfaceJet::index(i, j)]);
      boxes[SurfaceJet::index(i, j)].include(Box3{scale * hull.lo - apart, scale * hull.hi + apart});
    }
  }
}

template <int kOrder>
SurfaceJet jet_of(const Patch& patch, double u, double v) {
  const double h_u = patch.domain.u.width(), h_v = patch.domain.v.width();
  const Weights by_u = bernstein_derivatives<kOrder>((u - patch.domain.u.lo) / h_u),
                by_v = bernstein_derivatives<kOrder>((v - patch.domain.v.lo) / h_v);
  SurfaceJet jet(kOrder);
  // Along v first, for all derivatives by v.
  std::array<std::array<Vec3, kPoints>, kOrder + 1> rows;
  for (int a = 0; a < kPoints; ++a)
    for (int j = 0; j <= kOrder; ++j) {
      Vec3 sum(0);
      for (int b = 0; b < kPoints; ++b) sum += by_v[j][b] * patch.net[a * kPoints + b];
      rows[j][a] = sum;
    }
  double scale_u = 1;
  for (int i = 0; i <= kOrder; ++i, scale_u /= h_u) {
    double scale = scale_u;
    for (int j = 0; i + j <= kOrder; ++j, scale /= h_v) {
      Vec3 sum(0);
      for (int a = 0; a < kPoints; ++a) sum += by_u[i][a] * rows[j][a];
      jet.d(i, j) = scale * sum;
    }
  }
  return jet;
}

SurfaceJet jet_of(const Patch& patch, double u, double v, int order) {
  switch (order) {
    case 0:
      return jet_of<0>(patch, u, v);
    case 1:
      return jet_of<1>(patch, u, v);
    case 2:
      return jet_of<2>(patch, u, v);
    case 3:
      return jet_of<3>(patch, u, v);
    default:
      return jet_of<kMaxSurfaceOrder>(patch, u, v);
  }
}

Net part_of(const Patch& patch, const Rectangle& box) {
  Net net = patch.net;
  const auto share = [](double x, const Interval& of) { return std::clamp((x - of.lo) / of.width(), 0.0, 1.0); };
  for (int b = 0; b < kPoints; ++b)
    restrict_to(net.data() + b, kPoints, share(box.u.lo, patch.domain.u), share(box.u.hi, patch.domain.u));
  for (int a = 0; a < kPoints; ++a)
    restrict_to(net.data() + a * kPoints, 1, share(box.v.lo, patch.domain.v), share(box.v.hi, patch.domain.v));
  return net;
}

// Mean values: of those of order n in a rectangle, from those of order n + 1 in it or more, which are known.
void narrow(const Patch& patch, const Rectangle& box, int order, int known, std::array<Box3, kDerivatives>& ranges) {
  const SurfaceJet middle = jet_of(patch, box.u.middle(), box.v.middle(), order);
  const auto largest = [&](int i, int j) {
    const Box3& range = ranges[SurfaceJet::index(i, j)];
    return glm::max(glm::abs(range.lo), glm::abs(range.hi));
  };
  for (int n = std::min(order, known - 1); n >= 0; --n)
    for (int j = 0; j <= n; ++j) {
      const int i = n - j;
      const Vec3 reach = 0.5 * box.u.width() * largest(i + 1, j) + 0.5 * box.v.width() * largest(i, j + 1) +
                         Vec3(patch.apart[SurfaceJet::index(i, j)]);
      Box3& range = ranges[SurfaceJet::index(i, j)];
      range = {glm::max(range.lo, middle.d(i, j) - reach), glm::min(range.hi, middle.d(i, j) + reach)};
    }
}

Box3 box_of(const Rectangle& r) { return {{r.u.lo, r.v.lo, 0}, {r.u.hi, r.v.hi, 0}}; }

class FittedSurface final : public Surface {
 public:
  FittedSurface(SurfacePtr original, const FittedPieces& fitted) : original_(std::move(original)) {
    std::vector<Box3> boxes;
    for (size_t k = 0; k < fitted.patches.size(); ++k) {
      const SurfacePiece& piece = fitted.patches[k];
      Patch patch;
      patch.domain = piece.domain;
      patch.distance = fitted.distances[k];
      for (int i = 0; i <= kMaxSurfaceOrder; ++i)
        for (int j = 0; i + j <= kMaxSurfaceOrder; ++j)
          patch.apart[SurfaceJet::index(i, j)] = derivative_distance(patch, i, j);
      for (size_t i = 0; i < piece.points.size(); ++i) patch.net[i] = Vec3(piece.points[i]);
      include_ranges(patch, patch.net, patch.domain, kMaxSurfaceOrder, patch.whole.data());
      boxes.push_back(box_of(patch.domain));
      patches_.push_back(patch);
    }
    for (const Rectangle& rest : fitted.rest) boxes.push_back(box_of(rest)), rest_.push_back(rest);
    tree_ = BoxTree(boxes);
    set_reversed(original_->reversed());
  }

  Rectangle domain() const override { return original_->domain(); }
  Periods periods() const override { return original_->periods(); }
  int max_order() const override { return original_->max_order(); }
  int enclosure_order() const override { return original_->enclosure_order(); }
  bool is_composed() const override { return true; }
  std::vector<SurfacePiece> pieces() const override { return original_->pieces(); }
  DegenerateEdges degenerate_edges() const override { return original_->degenerate_edges(); }
  Vec3 normal(double u, double v) const override { return original_->normal(u, v); }
  Vec3 normal(double u, double v, const SurfaceJet& jet) const override { return original_->normal(u, v, jet); }

  SurfaceJet evaluate(double u, double v, int order) const override {
    const Patch* patch = order <= max_order() ? patch_at(u, v) : nullptr;
    if (!patch) return original_->evaluate(u, v, order);
    return jet_of(*patch, u, v, order);
  }

  SurfaceEnclosure enclose(const Rectangle& box, int order) const override {
    const Rectangle all = domain();
    if (order > enclosure_order() || !all.contains(box.u.lo, box.v.lo) || !all.contains(box.u.hi, box.v.hi))
      return original_->enclose(box, order);
    SurfaceEnclosure result;
    tree_.around(box_of(box), [&](int k) {
      const Rectangle& there = domain_of(k);
      const Rectangle part{intersect(box.u, there.u), intersect(box.v, there.v)};
      // A mere touch adds nothing to what is wider.
      if ((part.u.width() == 0 && box.u.width() > 0) || (part.v.width() == 0 && box.v.width() > 0)) return;
      include(k, part, order, result);
    });
    return result;
  }

 private:
  size_t count() const { return patches_.size(); }
  const Rectangle& domain_of(int k) const {
    const auto i = static_cast<size_t>(k);
    return i < count() ? patches_[i].domain : rest_[i - count()];
  }

  // Null outside of the patches.
  const Patch* patch_at(double u, double v) const {
    const Patch* found = nullptr;
    tree_.around({{u, v, 0}, {u, v, 0}}, [&](int k) {
      // At a border the next one, as other surfaces do.
      if (static_cast<size_t>(k) >= count()) return;
      const Patch& patch = patches_[static_cast<size_t>(k)];
      if (!found || patch.domain.u.lo > found->domain.u.lo || patch.domain.v.lo > found->domain.v.lo) found = &patch;
    });
    return found;
  }

  void include(int k, const Rectangle& part, int order, SurfaceEnclosure& result) const {
    const int values = SurfaceJet::index(0, order) + 1;
    if (static_cast<size_t>(k) >= count()) {
      const SurfaceEnclosure there = original_->enclose(part, order);
      for (int i = 0; i < values; ++i) result.values[i].include(there.values[i]);
      return;
    }
    const Patch& patch = patches_[static_cast<size_t>(k)];
    if (part.u == patch.domain.u && part.v == patch.domain.v) {
      for (int i = 0; i < values; ++i) result.values[i].include(patch.whole[i]);
      return;
    }
    const auto widened = [](const Interval& of, const Interval& whole) -> Interval {
      const double least = kMinShare * whole.width();
      if (of.width() >= least) return of;
      const double lo = std::clamp(of.middle() - 0.5 * least, whole.lo, whole.hi - least);
      return {lo, lo + least};
    };
    const Rectangle box{widened(part.u, patch.domain.u), widened(part.v, patch.domain.v)};
    const bool is_small = box.u != part.u || box.v != part.v;
    const int known = std::min(order + (is_small ? 1 : 0), kMaxSurfaceOrder);
    std::array<Box3, kDerivatives> ranges;
    include_ranges(patch, part_of(patch, box), box, known, ranges.data());
    if (is_small) narrow(patch, part, order, known, ranges);
    for (int i = 0; i < values; ++i) result.values[i].include(ranges[i]);
  }

  // Differences of points nearer to each other would be rounding: below this share of a patch in each parameter the
  // derivatives are taken over more, and what is lower is narrowed by mean values.
  static constexpr double kMinShare = 1.0 / 16;

  SurfacePtr original_;
  std::vector<Patch> patches_;
  std::vector<Rectangle> rest_;
  BoxTree tree_;
};

}  // namespace

SurfacePtr fitted_copy(const SurfacePtr& surface) {
  if (!surface->is_composed() || !surface->bounded()) return surface;
  for (const SurfacePiece& piece : surface->pieces())
    if (piece.is_rational()) return surface;
  return std::make_shared<FittedSurface>(surface, *fitted_pieces(surface));
}

}  // namespace lekalo::geometry
