#include "geometry/queries/contours/contour_touching.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/queries/closest/closest_point.h"

namespace lekalo::geometry {

template <int N>
SystemValue<double, N, N + 1> TouchingEquations<N>::evaluate(const ParameterPoint<N>& place) const {
  return continued<N, N + 1>(contour().domain(), place,
                             [this](const ParameterPoint<N>& inside) { return evaluate_inside(inside); });
}
template class TouchingEquations<2>;
template class TouchingEquations<4>;

namespace {

// One way along each parameter in turn: values and first derivatives of what `along` makes of it.
template <class S, int N, int M, class Along>
SystemValue<S, N, M> by_each_parameter(const std::array<S, N>& place, const Along& along) {
  SystemValue<S, N, M> result;
  for (int i = 0; i < N; ++i) {
    std::array<Jet<S, 1>, N> x;
    for (int j = 0; j < N; ++j) x[j] = Jet<S, 1>(place[j]);
    x[i].c[1] = S(1);
    const std::array<Jet<S, 1>, M> f = along(x);
    for (int k = 0; k < M; ++k) result.value[k] = f[k].c[0], result.derivative[k][i] = f[k].c[1];
  }
  return result;
}

// The point of a surface next to the target; none if the target lies beyond its edges.
std::optional<Vec3> foot_point_inside(const Surface& surface, const Vec3& target) {
  const SurfaceFootPoints found = project(target, surface);
  if (found.foot_points.empty() || found.foot_points.front().kind == FootPointKind::border) return std::nullopt;
  return found.foot_points.front().point;
}

class SurfacesTouching final : public TouchingEquations<4> {
 public:
  SurfacesTouching(std::shared_ptr<const ContourEquations<4>> intersection, SurfacePtr r, const Rectangle& piece_r,
                   SurfacePtr s, const Rectangle& piece_s)
      : TouchingEquations<4>(std::move(intersection)),
        r_(std::move(r)),
        s_(std::move(s)),
        piece_r_(piece_r),
        piece_s_(piece_s) {
    // n / (its size) is across s_a times the side of a: lengths as the other equations.
    double most = 0;
    for (int i = 0; i <= 2; ++i)
      for (int j = 0; j <= 2; ++j) {
        const SurfaceJet at = evaluate_within(*r_, piece_r, piece_r.u.lo + 0.5 * i * piece_r.u.width(),
                                              piece_r.v.lo + 0.5 * j * piece_r.v.width(), 1);
        most = std::max(most, glm::length(glm::cross(at.du(), at.dv())));
      }
    per_normal_ = most > 0 ? 1 / most : 1;
  }

  SystemValue<Interval, 4, 5> enclose(const ParameterBox<4>& box) const override {
    const SurfaceEnclosure r = r_->enclose({box[0], box[1]}, 2), s = s_->enclose({box[2], box[3]}, 2);
    return by_each_parameter<Interval, 4, 5>(box,
                                             [&](const auto& x) { return equations<Interval, 1>(r, s, x).equations; });
  }
  ContourSeries<double, kMaxContourOrder, 4, 5> series(
      const std::array<Jet<double, kMaxContourOrder>, 4>& x) const override {
    return equations<double, kMaxContourOrder>(evaluate_within(*r_, piece_r_, x[0].c[0], x[1].c[0], kMaxSurfaceOrder),
                                               evaluate_within(*s_, piece_s_, x[2].c[0], x[3].c[0], kMaxSurfaceOrder),
                                               x);
  }
  ContourSeries<Interval, 2, 4, 5> series(const std::array<Jet<Interval, 2>, 4>& x) const override {
    return equations<Interval, 2>(enclosure_to_third(*r_, piece_r_, {x[0].c[0], x[1].c[0]}),
                                  enclosure_to_third(*s_, piece_s_, {x[2].c[0], x[3].c[0]}), x);
  }
  bool coincide_at(const Vec3& target, double tolerance) const override {
    const std::optional<Vec3> on_r = foot_point_inside(*r_, target);
    if (!on_r) return false;
    const SurfaceFootPoints on_s = project(*on_r, *s_);
    return !on_s.foot_points.empty() && on_s.foot_points.front().distance <= tolerance;
  }

 protected:
  SystemValue<double, 4, 5> evaluate_inside(const ParameterPoint<4>& at) const override {
    const SurfaceJet r = evaluate_within(*r_, piece_r_, at[0], at[1], 2);
    const SurfaceJet s = evaluate_within(*s_, piece_s_, at[2], at[3], 2);
    return by_each_parameter<double, 4, 5>(at, [&](const auto& x) { return equations<double, 1>(r, s, x).equations; });
  }

 private:
  template <class S, int K, class Derivatives>
  ContourSeries<S, K, 4, 5> equations(const Derivatives& r, const Derivatives& s,
                                      const std::array<Jet<S, K>, 4>& x) const {
    ContourSeries<S, K, 4, 5> result;
    result.point = along_surface(r, x[0], x[1]);
    const Triple<Jet<S, K>> apart = result.point - along_surface(s, x[2], x[3]);
    const Triple<Jet<S, K>> n = cross(along_surface(r, x[0], x[1], 1, 0), along_surface(r, x[0], x[1], 0, 1));
    const double by_a = per_normal_ * piece_s_.u.width(), by_b = per_normal_ * piece_s_.v.width();
    result.equations = {apart.x, apart.y, apart.z, S(by_a) * dot(n, along_surface(s, x[2], x[3], 1, 0)),
                        S(by_b) * dot(n, along_surface(s, x[2], x[3], 0, 1))};
    return result;
  }

  const SurfacePtr r_, s_;
  const Rectangle piece_r_, piece_s_;
  double per_normal_ = 1;
};

class PlaneTouching final : public TouchingEquations<2> {
 public:
  PlaneTouching(std::shared_ptr<const ContourEquations<2>> section, SurfacePtr surface, const Rectangle& piece,
                const Vec3& normal)
      : TouchingEquations<2>(std::move(section)), surface_(std::move(surface)), piece_(piece), normal_(normal) {}

  SystemValue<Interval, 2, 3> enclose(const ParameterBox<2>& box) const override {
    const SystemValue<Interval, 2, 1> height = contour().enclose(box);
    const SurfaceEnclosure s = surface_->enclose({box[0], box[1]}, 2);
    SystemValue<Interval, 2, 3> result =
        by_each_parameter<Interval, 2, 3>(box, [&](const auto& x) { return with_slopes<Interval, 1>({}, s, x); });
    result.value[0] = height.value[0], result.derivative[0] = height.derivative[0];
    return result;
  }
  ContourSeries<double, kMaxContourOrder, 2, 3> series(
      const std::array<Jet<double, kMaxContourOrder>, 2>& x) const override {
    const auto height = contour().series(x);
    const SurfaceJet s = evaluate_within(*surface_, piece_, x[0].c[0], x[1].c[0], kMaxSurfaceOrder);
    return {with_slopes<double, kMaxContourOrder>(height.equations[0], s, x), height.point};
  }
  ContourSeries<Interval, 2, 2, 3> series(const std::array<Jet<Interval, 2>, 2>& x) const override {
    const auto height = contour().series(x);
    return {
        with_slopes<Interval, 2>(height.equations[0], enclosure_to_third(*surface_, piece_, {x[0].c[0], x[1].c[0]}), x),
        height.point};
  }
  bool coincide_at(const Vec3& target, double tolerance) const override {
    const std::optional<Vec3> foot_point = foot_point_inside(*surface_, target);
    if (!foot_point) return false;
    const ParameterPoint<2> middle{piece_.u.middle(), piece_.v.middle()};
    const double height =
        contour().evaluate(middle).value[0] + glm::dot(normal_, *foot_point - contour().point(middle));
    return std::abs(height) <= tolerance;
  }

 protected:
  SystemValue<double, 2, 3> evaluate_inside(const ParameterPoint<2>& at) const override {
    const SystemValue<double, 2, 1> height = contour().evaluate(at);
    const SurfaceJet s = evaluate_within(*surface_, piece_, at[0], at[1], 2);
    SystemValue<double, 2, 3> result =
        by_each_parameter<double, 2, 3>(at, [&](const auto& x) { return with_slopes<double, 1>({}, s, x); });
    result.value[0] = height.value[0], result.derivative[0] = height.derivative[0];
    return result;
  }

 private:
  template <class S, int K, class Derivatives>
  std::array<Jet<S, K>, 3> with_slopes(const Jet<S, K>& height, const Derivatives& s,
                                       const std::array<Jet<S, K>, 2>& x) const {
    const Triple<double> n{normal_.x, normal_.y, normal_.z};
    return {height, S(piece_.u.width()) * dot(n, along_surface(s, x[0], x[1], 1, 0)),
            S(piece_.v.width()) * dot(n, along_surface(s, x[0], x[1], 0, 1))};
  }

  const SurfacePtr surface_;
  const Rectangle piece_;
  const Vec3 normal_;
};

// The first N - 1 equations, the border's, and the sum of both slopes, for one equation's place: it vanishes with them.
template <int N>
class BorderEquations final : public TouchingEquations<N> {
 public:
  BorderEquations(std::shared_ptr<const TouchingEquations<N>> touching, int parameter, bool at_upper_end)
      : TouchingEquations<N>(touching->shared_contour()), touching_(std::move(touching)), parameter_(parameter) {
    const ParameterBox<N> domain = this->contour().domain();
    at_ = at_upper_end ? domain[parameter].hi : domain[parameter].lo;
    std::array<KnownEnclosures, 2> known;
    length_ = this->contour().extents(domain, known)[parameter] / domain[parameter].width();
  }

  SystemValue<Interval, N, N + 1> enclose(const ParameterBox<N>& box) const override {
    return with_border(touching_->enclose(box), box[parameter_]);
  }
  ContourSeries<double, kMaxContourOrder, N, N + 1> series(
      const std::array<Jet<double, kMaxContourOrder>, N>& x) const override {
    return with_border(touching_->series(x), x[parameter_]);
  }
  ContourSeries<Interval, 2, N, N + 1> series(const std::array<Jet<Interval, 2>, N>& x) const override {
    return with_border(touching_->series(x), x[parameter_]);
  }
  bool coincide_at(const Vec3& target, double tolerance) const override {
    return touching_->coincide_at(target, tolerance);
  }

 protected:
  SystemValue<double, N, N + 1> evaluate_inside(const ParameterPoint<N>& at) const override {
    return with_border(touching_->evaluate(at), at[parameter_]);
  }

 private:
  template <class S>
  SystemValue<S, N, N + 1> with_border(SystemValue<S, N, N + 1> f, const S& x) const {
    f.value[N] += f.value[N - 1];
    for (int i = 0; i < N; ++i) f.derivative[N][i] += f.derivative[N - 1][i];
    f.value[N - 1] = S(length_) * (x - S(at_));
    f.derivative[N - 1].fill(S(0));
    f.derivative[N - 1][parameter_] = S(length_);
    return f;
  }
  template <class S, int K>
  ContourSeries<S, K, N, N + 1> with_border(ContourSeries<S, K, N, N + 1> f, const Jet<S, K>& x) const {
    f.equations[N] = f.equations[N] + f.equations[N - 1];
    f.equations[N - 1] = S(length_) * (x - S(at_));
    return f;
  }

  const std::shared_ptr<const TouchingEquations<N>> touching_;
  const int parameter_;
  double at_ = 0, length_ = 1;
};

template <int N>
class StrongestEquations final : public ContourEquations<N> {
 public:
  static constexpr int kAll = N + 1;
  using Weights = std::array<std::array<double, kAll>, N - 1>;

  StrongestEquations(std::shared_ptr<const TouchingEquations<N>> touching, const Weights& weights)
      : touching_(std::move(touching)), weights_(weights) {}

  ParameterBox<N> domain() const override { return contour().domain(); }
  SystemValue<Interval, N, N - 1> enclose(const ParameterBox<N>& box, std::array<KnownEnclosures, 2>*) const override {
    return combined(touching_->enclose(box));
  }
  std::array<double, N> extents(const ParameterBox<N>& box, std::array<KnownEnclosures, 2>& known) const override {
    return contour().extents(box, known);
  }
  bool is_pole(int parameter, bool at_upper_end) const override { return contour().is_pole(parameter, at_upper_end); }
  Vec3 point(const ParameterPoint<N>& place) const override { return contour().point(place); }
  Vec3 motion(const ParameterPoint<N>& place, const ParameterPoint<N>& by) const override {
    return contour().motion(place, by);
  }
  double distance(const ParameterPoint<N>& place) const override { return contour().distance(place); }
  double rounding() const override { return contour().rounding(); }
  ContourSeries<double, kMaxContourOrder, N> series(
      const std::array<Jet<double, kMaxContourOrder>, N>& x) const override {
    return combined(touching_->series(x));
  }
  ContourSeries<Interval, 2, N> series(const std::array<Jet<Interval, 2>, N>& x) const override {
    return combined(touching_->series(x));
  }
  int highest_order() const override { return kMaxContourOrder - 1; }

 protected:
  SystemValue<double, N, N - 1> evaluate_inside(const ParameterPoint<N>& place) const override {
    return combined(touching_->evaluate(place));
  }

 private:
  const ContourEquations<N>& contour() const { return touching_->contour(); }

  template <class S>
  SystemValue<S, N, N - 1> combined(const SystemValue<S, N, kAll>& all) const {
    SystemValue<S, N, N - 1> result;
    for (int k = 0; k < N - 1; ++k) {
      result.value[k] = S(0), result.derivative[k].fill(S(0));
      for (int m = 0; m < kAll; ++m) {
        result.value[k] += S(weights_[k][m]) * all.value[m];
        for (int i = 0; i < N; ++i) result.derivative[k][i] += S(weights_[k][m]) * all.derivative[m][i];
      }
    }
    return result;
  }
  template <class S, int K>
  ContourSeries<S, K, N> combined(const ContourSeries<S, K, N, kAll>& all) const {
    ContourSeries<S, K, N> result;
    result.point = all.point;
    for (int k = 0; k < N - 1; ++k) {
      result.equations[k] = Jet<S, K>(S(0));
      for (int m = 0; m < kAll; ++m) result.equations[k] = result.equations[k] + S(weights_[k][m]) * all.equations[m];
    }
    return result;
  }

  const std::shared_ptr<const TouchingEquations<N>> touching_;
  const Weights weights_;
};

}  // namespace

std::unique_ptr<TouchingEquations<4>> surfaces_touching(std::shared_ptr<const ContourEquations<4>> intersection,
                                                        SurfacePtr r, const Rectangle& piece_r, SurfacePtr s,
                                                        const Rectangle& piece_s) {
  return std::make_unique<SurfacesTouching>(std::move(intersection), std::move(r), piece_r, std::move(s), piece_s);
}
std::unique_ptr<TouchingEquations<2>> plane_touching(std::shared_ptr<const ContourEquations<2>> section,
                                                     SurfacePtr surface, const Rectangle& piece, const Vec3& normal) {
  return std::make_unique<PlaneTouching>(std::move(section), std::move(surface), piece, normal);
}

template <int N>
std::unique_ptr<TouchingEquations<N>> border_of(std::shared_ptr<const TouchingEquations<N>> touching, int parameter,
                                                bool at_upper_end) {
  return std::make_unique<BorderEquations<N>>(std::move(touching), parameter, at_upper_end);
}
template std::unique_ptr<TouchingEquations<2>> border_of<2>(std::shared_ptr<const TouchingEquations<2>>, int, bool);
template std::unique_ptr<TouchingEquations<4>> border_of<4>(std::shared_ptr<const TouchingEquations<4>>, int, bool);

// Combinations by the eigenvectors of J J^T with the largest eigenvalues.
template <int N>
std::shared_ptr<const ContourEquations<N>> strongest_at(std::shared_ptr<const TouchingEquations<N>> touching,
                                                        const ParameterPoint<N>& place) {
  constexpr int kAll = N + 1;
  const auto there = touching->evaluate(place);
  const ParameterBox<N> domain = touching->contour().domain();
  Eigen::MatrixXd j(kAll, N);
  for (int k = 0; k < kAll; ++k)
    for (int i = 0; i < N; ++i) j(k, i) = there.derivative[k][i] * domain[i].width();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(j * j.transpose());
  typename StrongestEquations<N>::Weights weights;
  for (int k = 0; k < N - 1; ++k)
    for (int m = 0; m < kAll; ++m) weights[k][m] = solver.eigenvectors()(m, kAll - 1 - k);
  return std::make_shared<StrongestEquations<N>>(std::move(touching), weights);
}
template std::shared_ptr<const ContourEquations<2>> strongest_at<2>(std::shared_ptr<const TouchingEquations<2>>,
                                                                    const ParameterPoint<2>&);
template std::shared_ptr<const ContourEquations<4>> strongest_at<4>(std::shared_ptr<const TouchingEquations<4>>,
                                                                    const ParameterPoint<4>&);

}  // namespace lekalo::geometry
