#include "geometry/queries/contours/contour_equations.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/queries/contours/contour_touching.h"

namespace lekalo::geometry {

template <int N>
SystemValue<double, N, N - 1> ContourEquations<N>::evaluate(const ParameterPoint<N>& place) const {
  return continued<N, N - 1>(domain(), place,
                             [this](const ParameterPoint<N>& inside) { return evaluate_inside(inside); });
}
template <int N>
SystemValue<double, N, N - 1> ContourEquations<N>::evaluate_middle(const ParameterBox<N>& box,
                                                                   std::array<KnownEnclosures, 2>&) const {
  ParameterPoint<N> middle;
  for (int i = 0; i < N; ++i) middle[i] = box[i].middle();
  return evaluate_inside(middle);
}
template <int N>
std::unique_ptr<TouchingEquations<N>> ContourEquations<N>::touching(std::shared_ptr<const ContourEquations<N>>) const {
  return nullptr;
}
template <int N>
ContourPlace<N> ContourEquations<N>::at_inside(const ParameterPoint<N>& place) const {
  ContourPlace<N> result{evaluate(place), point(place), {}};
  for (int i = 0; i < N; ++i) {
    ParameterPoint<N> by{};
    by[i] = 1;
    result.motion[i] = motion(place, by);
  }
  return result;
}
template <int N>
ContourPlace<N> ContourEquations<N>::at(const ParameterPoint<N>& place) const {
  const ParameterBox<N> all = domain();
  for (int i = 0; i < N; ++i)
    if (!all[i].contains(place[i])) return ContourEquations<N>::at_inside(place);
  return at_inside(place);
}
template class ContourEquations<2>;
template class ContourEquations<4>;

SurfaceEnclosure enclosure_to_third(const Surface& surface, const Rectangle& piece, const Rectangle& box) {
  if (surface.enclosure_order() >= 3) return surface.enclose(box, 3);
  SurfaceEnclosure boxes = surface.enclose(box, 2);
  std::array<Box3, 4> seen;
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; j <= 2; ++j) {
      const SurfaceJet s =
          evaluate_within(surface, piece, box.u.lo + 0.5 * i * box.u.width(), box.v.lo + 0.5 * j * box.v.width(), 3);
      for (int k = 0; k <= 3; ++k) seen[k].include(s.d(3 - k, k));
    }
  for (int k = 0; k <= 3; ++k) boxes.values[SurfaceJet::index(3 - k, k)] = seen[k].inflated(0.5 * seen[k].diameter());
  return boxes;
}

size_t KnownEnclosures::Hash::operator()(const Key& key) const {
  std::uint64_t sum = 0;
  for (const double x : key) sum = (sum ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15u, sum ^= sum >> 29;
  return sum;
}

KnownEnclosures::Entry& KnownEnclosures::entry(const Rectangle& box) {
  const Key key{box.u.lo, box.u.hi, box.v.lo, box.v.hi};
  if (!last_ || last_->first != key) last_ = &*known_.try_emplace(key).first;
  return last_->second;
}

const KnownEnclosures::First& KnownEnclosures::of(const Surface& surface, const Rectangle& box) {
  Entry& known = entry(box);
  if (!known.knows_first) {
    const SurfaceEnclosure s = surface.enclose(box, 1);
    known.first = {s.d(0, 0), s.d(1, 0), s.d(0, 1)};
    known.knows_first = true;
  }
  return known.first;
}

const KnownEnclosures::FirstOfMiddle& KnownEnclosures::of_middle(const Surface& surface, const Rectangle& piece,
                                                                 const Rectangle& box) {
  Entry& known = entry(box);
  if (!known.knows_middle) {
    const SurfaceJet s = evaluate_within(surface, piece, box.u.middle(), box.v.middle(), 1);
    known.middle = {s.point(), s.du(), s.dv()};
    known.knows_middle = true;
  }
  return known.middle;
}

namespace {

double largest_length(const Box3& box) { return glm::length(glm::max(glm::abs(box.lo), glm::abs(box.hi))); }

std::array<double, 2> extents_of(const Surface& surface, const Rectangle& box, KnownEnclosures& known) {
  const KnownEnclosures::First& s = known.of(surface, box);
  return {largest_length(s.du) * box.u.width(), largest_length(s.dv) * box.v.width()};
}

// The parameter of a surface, 0 or 1.
bool is_pole_of(const Surface& surface, const Rectangle& piece, int parameter, bool upper) {
  const DegenerateEdges edges = surface.degenerate_edges();
  const Rectangle all = surface.domain();
  if (parameter == 0) return upper ? edges.u_max && piece.u.hi == all.u.hi : edges.u_min && piece.u.lo == all.u.lo;
  return upper ? edges.v_max && piece.v.hi == all.v.hi : edges.v_min && piece.v.lo == all.v.lo;
}

// Of the piece's side: so near to a pole its Taylor polynomial is used.
constexpr double kNearPole = 1e-4;

template <class T>
struct Tangents {
  Triple<T> s, s_u, s_v;
};

// A function of the tangents vanishes at a pole, where one of them does. Where the surface encloses its derivatives to
// the fourth order that tangent is divided by the distance from the pole in the parameter: then the function is regular
// there, and says where contours go through the pole.
class FunctionEquations final : public ContourEquations<2> {
 public:
  FunctionEquations(SurfacePtr surface, const Rectangle& piece, SurfaceFunction function)
      : surface_(std::move(surface)), piece_(piece), function_(std::move(function)) {
    if (function_.needs_tangents && surface_->enclosure_order() >= kMaxSurfaceOrder)
      for (int i = 0; i < 2; ++i)
        for (const bool upper : {false, true})
          if (is_pole(i, upper)) poles_.push_back({i == 0, upper, upper ? domain()[i].hi : domain()[i].lo});
    // Rounding of the terms, from their size over the piece.
    double most = 0;
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; j <= 4; ++j) {
        const ParameterPoint<2> at{piece.u.lo + piece.u.width() * i / 4, piece.v.lo + piece.v.width() * j / 4};
        const auto there = evaluate_inside(at);
        most = std::max(most, std::abs(there.value[0]) + std::abs(there.derivative[0][0]) * piece.u.width() +
                                  std::abs(there.derivative[0][1]) * piece.v.width());
      }
    rounding_ = 1e-15 * most;
  }

  ParameterBox<2> domain() const override { return {piece_.u, piece_.v}; }

  SystemValue<Interval, 2, 1> enclose(const ParameterBox<2>& box, std::array<KnownEnclosures, 2>*) const override {
    const SurfaceEnclosure boxes = surface_->enclose({box[0], box[1]}, 1 + tangents());
    SystemValue<Interval, 2, 1> result;
    AtPoles<SurfaceEnclosure> known;
    for (int i = 0; i < 2; ++i) {
      const Jet<Interval, 1> f = apply(function_.slope_ranges, boxes, towards<Interval>(box[0], i == 0),
                                       towards<Interval>(box[1], i == 1), known);
      result.value[0] = f.c[0];
      result.derivative[0][i] = f.c[1];
    }
    return result;
  }
  std::array<double, 2> extents(const ParameterBox<2>& box, std::array<KnownEnclosures, 2>& known) const override {
    std::array<double, 2> extents = extents_of(*surface_, {box[0], box[1]}, known[0]);
    // At a pole where the function is regular the parameter along the edge counts as elsewhere.
    if (!poles_.empty()) {
      const std::array<double, 2> whole = extents_of(*surface_, piece_, known[0]);
      for (const Pole& pole : poles_) {
        const int along = pole.of_u ? 1 : 0;
        extents[along] = whole[along] * box[along].width() / domain()[along].width();
      }
    }
    return extents;
  }
  bool is_pole(int parameter, bool upper) const override { return is_pole_of(*surface_, piece_, parameter, upper); }
  Vec3 point(const ParameterPoint<2>& at) const override {
    return evaluate_within(*surface_, piece_, at[0], at[1], 0).point();
  }
  Vec3 motion(const ParameterPoint<2>& at, const ParameterPoint<2>& by) const override {
    const SurfaceJet s = evaluate_within(*surface_, piece_, at[0], at[1], 1);
    return by[0] * s.du() + by[1] * s.dv();
  }
  double distance(const ParameterPoint<2>& at) const override {
    const auto f = evaluate(at);
    if (!function_.needs_tangents) return std::abs(f.value[0]);
    for (int i = 0; i < 2; ++i)
      for (const bool upper : {false, true})
        if (is_pole(i, upper) && at[i] == (upper ? domain()[i].hi : domain()[i].lo)) return distance_at_pole(at);
    const SurfaceJet s = evaluate_within(*surface_, piece_, at[0], at[1], 1);
    // Along the gradient in the parameters, or nothing where that vanishes.
    const double square = sqr(f.derivative[0][0]) + sqr(f.derivative[0][1]);
    if (!(square > 0)) return 0;
    const double by = f.value[0] / square;
    return glm::length(by * f.derivative[0][0] * s.du() + by * f.derivative[0][1] * s.dv());
  }
  double rounding() const override { return rounding_; }

  ContourSeries<double, kMaxContourOrder, 2> series(
      const std::array<Jet<double, kMaxContourOrder>, 2>& x) const override {
    const SurfaceJet jet = evaluate_within(*surface_, piece_, x[0].c[0], x[1].c[0], kMaxSurfaceOrder);
    AtPoles<SurfaceJet> known;
    return {{apply(function_.series, jet, x[0], x[1], known)}, along_surface(jet, x[0], x[1])};
  }
  ContourSeries<Interval, 2, 2> series(const std::array<Jet<Interval, 2>, 2>& x) const override {
    const Rectangle box{x[0].c[0], x[1].c[0]};
    const SurfaceEnclosure boxes =
        function_.needs_tangents ? enclosure_to_third(*surface_, piece_, box) : surface_->enclose(box, 2);
    AtPoles<SurfaceEnclosure> known;
    return {{apply(function_.series_ranges, boxes, x[0], x[1], known)}, along_surface(boxes, x[0], x[1])};
  }
  int highest_order() const override { return kMaxContourOrder - tangents(); }
  std::unique_ptr<TouchingEquations<2>> touching(std::shared_ptr<const ContourEquations<2>> self) const override {
    return function_.plane ? plane_touching(std::move(self), surface_, piece_, *function_.plane) : nullptr;
  }

 protected:
  SystemValue<double, 2, 1> evaluate_inside(const ParameterPoint<2>& at) const override {
    return value_of(evaluate_within(*surface_, piece_, at[0], at[1], 1 + tangents()), at);
  }
  ContourPlace<2> at_inside(const ParameterPoint<2>& at) const override {
    const SurfaceJet jet = evaluate_within(*surface_, piece_, at[0], at[1], 1 + tangents());
    return {value_of(jet, at), jet.point(), {jet.du(), jet.dv()}};
  }

 private:
  SystemValue<double, 2, 1> value_of(const SurfaceJet& jet, const ParameterPoint<2>& at) const {
    SystemValue<double, 2, 1> result;
    AtPoles<SurfaceJet> known;
    for (int i = 0; i < 2; ++i) {
      const Jet<double, 1> f =
          apply(function_.slopes, jet, towards<double>(at[0], i == 0), towards<double>(at[1], i == 1), known);
      result.value[0] = f.c[0];
      result.derivative[0][i] = f.c[1];
    }
    return result;
  }

  // Edges that are one point; of_u: u is constant along it.
  struct Pole {
    bool of_u, upper;
    double at;
  };

  // The derivatives of the tangents that vanish at each pole, divided by the distance from it: at one place, for all
  // directions that are asked for.
  template <class Derivatives>
  using AtPoles = std::array<std::optional<Derivatives>, 4>;

  int tangents() const { return function_.needs_tangents ? 1 : 0; }

  // The function by the limit of the normal there.
  double distance_at_pole(const ParameterPoint<2>& at) const {
    const Vec3 p = point(at);
    const Frame frame = frame_about(p, surface_->normal_sign() * surface_->normal(at[0], at[1]));
    const auto constant = [](const Vec3& v) {
      return Triple<Jet<double, 1>>{Jet<double, 1>(v.x), Jet<double, 1>(v.y), Jet<double, 1>(v.z)};
    };
    return std::abs(function_.slopes(constant(p), constant(frame.x), constant(frame.y)).c[0]);
  }

  template <class S>
  static Jet<S, 1> towards(const S& value, bool moves) {
    Jet<S, 1> x(value);
    x.c[1] = S(moves ? 1.0 : 0.0);
    return x;
  }

  template <class S, int K, class Derivatives>
  Jet<S, K> apply(const SurfaceFunction::Of<Jet<S, K>>& f, const Derivatives& d, const Jet<S, K>& u, const Jet<S, K>& v,
                  AtPoles<Derivatives>& known) const {
    Tangents<Jet<S, K>> at;
    at.s = along_surface(d, u, v);
    if (function_.needs_tangents) at.s_u = along_surface(d, u, v, 1, 0), at.s_v = along_surface(d, u, v, 0, 1);
    for (size_t k = 0; k < poles_.size(); ++k) {
      const Pole& pole = poles_[k];
      const auto quotient = [&] {
        if (!known[k]) known[k] = quotient_at<K>(pole, u.c[0], v.c[0]);
        return along_surface(*known[k], u, v);
      };
      // Along the edge the other parameter moves nothing.
      Triple<Jet<S, K>>& vanishing = pole.of_u ? at.s_v : at.s_u;
      Jet<S, K> height = pole.of_u ? u - S(pole.at) : v - S(pole.at);
      if (is_near(pole, height.c[0]))
        vanishing = quotient();
      else
        vanishing = narrowed(vanishing / height, quotient);
      if (pole.upper) vanishing = -vanishing;
    }
    return f(at.s, at.s_u, at.s_v);
  }

  bool is_near(const Pole& pole, double height) const { return std::abs(height) < kNearPole * width(pole); }
  static bool is_near(const Pole&, const Interval& height) { return mignitude(height) < 0.5 * magnitude(height); }
  // A quotient of ranges is wide in its derivatives: by the square of the distance from the pole.
  template <int K, class Quotient>
  static Triple<Jet<Interval, K>> narrowed(Triple<Jet<Interval, K>> quotient, const Quotient& at_pole) {
    const Triple<Jet<Interval, K>> other = at_pole();
    for (int k = 0; k <= K; ++k) {
      quotient.x.c[k] = intersect(quotient.x.c[k], other.x.c[k]);
      quotient.y.c[k] = intersect(quotient.y.c[k], other.y.c[k]);
      quotient.z.c[k] = intersect(quotient.z.c[k], other.z.c[k]);
    }
    return quotient;
  }
  template <int K, class Quotient>
  static Triple<Jet<double, K>> narrowed(const Triple<Jet<double, K>>& quotient, const Quotient&) {
    return quotient;
  }
  double width(const Pole& pole) const { return pole.of_u ? piece_.u.width() : piece_.v.width(); }

  // q = s_u / (v - v0) = integral over x in [0, 1] of s_uv(u, v0 + x (v - v0)), for an edge v = v0 that is a pole:
  //   q_(u^i v^j) = integral of x^j s_(u^(i+1) v^(j+1)), which lies in the range of that derivative by j + 1.
  template <int K>
  SurfaceEnclosure quotient_at(const Pole& pole, const Interval& u, const Interval& v) const {
    Rectangle box{u, v};
    (pole.of_u ? box.u : box.v) = hull(pole.of_u ? box.u : box.v, Interval(pole.at));
    const SurfaceEnclosure s = surface_->enclose(box, K + 2);
    SurfaceEnclosure q;
    for (int i = 0; i <= K; ++i)
      for (int j = 0; i + j <= K; ++j) {
        const Box3& of = s.d(i + 1, j + 1);
        const double by = 1.0 / ((pole.of_u ? i : j) + 1);
        q.values[SurfaceJet::index(i, j)] = {by * of.lo, by * of.hi};
      }
    return q;
  }
  // The same from the Taylor polynomial at the edge; near enough to it that what is left out is rounding.
  template <int K>
  SurfaceJet quotient_at(const Pole& pole, double u, double v) const {
    const SurfaceJet s =
        evaluate_within(*surface_, piece_, pole.of_u ? pole.at : u, pole.of_u ? v : pole.at, kMaxSurfaceOrder);
    const double height = pole.of_u ? u - pole.at : v - pole.at;
    SurfaceJet q(kMaxSurfaceOrder);
    for (int i = 0; i + 1 < kMaxSurfaceOrder; ++i)
      for (int j = 0; i + j + 2 <= kMaxSurfaceOrder; ++j) {
        const int across = pole.of_u ? i : j;  // of the parameter that leads away from the pole
        double factor = 1, power = 1;
        for (int k = 0; i + j + 2 + k <= kMaxSurfaceOrder; ++k) {
          if (k > 0) factor /= k, power *= height;
          q.d(i, j) += factor * power / (across + k + 1) * (pole.of_u ? s.d(i + 1 + k, j + 1) : s.d(i + 1, j + 1 + k));
        }
      }
    return q;
  }

  const SurfacePtr surface_;
  const Rectangle piece_;
  const SurfaceFunction function_;
  std::vector<Pole> poles_;
  double rounding_ = 0;
};

class IntersectionEquations final : public ContourEquations<4> {
 public:
  IntersectionEquations(SurfacePtr r, const Rectangle& piece_r, SurfacePtr s, const Rectangle& piece_s)
      : r_(std::move(r)), s_(std::move(s)), piece_r_(piece_r), piece_s_(piece_s) {
    Box3 all = r_->enclose(piece_r, 0).d(0, 0);
    all.include(s_->enclose(piece_s, 0).d(0, 0));
    rounding_ = 2e-15 * std::max(glm::length(glm::max(glm::abs(all.lo), glm::abs(all.hi))), all.diameter());
  }

  ParameterBox<4> domain() const override { return {piece_r_.u, piece_r_.v, piece_s_.u, piece_s_.v}; }

  SystemValue<Interval, 4, 3> enclose(const ParameterBox<4>& box,
                                      std::array<KnownEnclosures, 2>* known) const override {
    std::array<KnownEnclosures, 2> own;
    std::array<KnownEnclosures, 2>& enclosures = known ? *known : own;
    const KnownEnclosures::First &r = enclosures[0].of(*r_, {box[0], box[1]}),
                                 &s = enclosures[1].of(*s_, {box[2], box[3]});
    SystemValue<Interval, 4, 3> result;
    for (int k = 0; k < 3; ++k) {
      result.value[k] = along(r.point, k) - along(s.point, k);
      result.derivative[k] = {along(r.du, k), along(r.dv, k), -along(s.du, k), -along(s.dv, k)};
    }
    return result;
  }
  SystemValue<double, 4, 3> evaluate_middle(const ParameterBox<4>& box,
                                            std::array<KnownEnclosures, 2>& known) const override {
    return apart(known[0].of_middle(*r_, piece_r_, {box[0], box[1]}),
                 known[1].of_middle(*s_, piece_s_, {box[2], box[3]}));
  }
  std::array<double, 4> extents(const ParameterBox<4>& box, std::array<KnownEnclosures, 2>& known) const override {
    const std::array<double, 2> r = extents_of(*r_, {box[0], box[1]}, known[0]),
                                s = extents_of(*s_, {box[2], box[3]}, known[1]);
    return {r[0], r[1], s[0], s[1]};
  }
  bool is_pole(int parameter, bool upper) const override {
    return parameter < 2 ? is_pole_of(*r_, piece_r_, parameter, upper)
                         : is_pole_of(*s_, piece_s_, parameter - 2, upper);
  }
  Vec3 point(const ParameterPoint<4>& at) const override {
    return evaluate_within(*r_, piece_r_, at[0], at[1], 0).point();
  }
  Vec3 motion(const ParameterPoint<4>& at, const ParameterPoint<4>& by) const override {
    const SurfaceJet r = evaluate_within(*r_, piece_r_, at[0], at[1], 1);
    return by[0] * r.du() + by[1] * r.dv();
  }
  double distance(const ParameterPoint<4>& at) const override {
    return glm::length(evaluate_within(*r_, piece_r_, at[0], at[1], 0).point() -
                       evaluate_within(*s_, piece_s_, at[2], at[3], 0).point());
  }
  double rounding() const override { return rounding_; }

  ContourSeries<double, kMaxContourOrder, 4> series(
      const std::array<Jet<double, kMaxContourOrder>, 4>& x) const override {
    return difference<double, kMaxContourOrder>(evaluate_within(*r_, piece_r_, x[0].c[0], x[1].c[0], kMaxContourOrder),
                                                evaluate_within(*s_, piece_s_, x[2].c[0], x[3].c[0], kMaxContourOrder),
                                                x);
  }
  ContourSeries<Interval, 2, 4> series(const std::array<Jet<Interval, 2>, 4>& x) const override {
    return difference<Interval, 2>(r_->enclose({x[0].c[0], x[1].c[0]}, 2), s_->enclose({x[2].c[0], x[3].c[0]}, 2), x);
  }
  int highest_order() const override { return kMaxContourOrder; }
  std::unique_ptr<TouchingEquations<4>> touching(std::shared_ptr<const ContourEquations<4>> self) const override {
    // A surface coincides with itself everywhere.
    return r_ == s_ ? nullptr : surfaces_touching(std::move(self), r_, piece_r_, s_, piece_s_);
  }

 protected:
  SystemValue<double, 4, 3> evaluate_inside(const ParameterPoint<4>& at) const override {
    const SurfaceJet r = evaluate_within(*r_, piece_r_, at[0], at[1], 1);
    const SurfaceJet s = evaluate_within(*s_, piece_s_, at[2], at[3], 1);
    return apart({r.point(), r.du(), r.dv()}, {s.point(), s.du(), s.dv()});
  }
  ContourPlace<4> at_inside(const ParameterPoint<4>& at) const override {
    const SurfaceJet r = evaluate_within(*r_, piece_r_, at[0], at[1], 1);
    const SurfaceJet s = evaluate_within(*s_, piece_s_, at[2], at[3], 1);
    return {
        apart({r.point(), r.du(), r.dv()}, {s.point(), s.du(), s.dv()}), r.point(), {r.du(), r.dv(), Vec3(0), Vec3(0)}};
  }

 private:
  using First = KnownEnclosures::FirstOfMiddle;
  static SystemValue<double, 4, 3> apart(const First& r, const First& s) {
    SystemValue<double, 4, 3> result;
    for (int k = 0; k < 3; ++k) {
      result.value[k] = r.point[k] - s.point[k];
      result.derivative[k] = {r.du[k], r.dv[k], -s.du[k], -s.dv[k]};
    }
    return result;
  }

  template <class S, int K, class Derivatives>
  static ContourSeries<S, K, 4> difference(const Derivatives& r, const Derivatives& s,
                                           const std::array<Jet<S, K>, 4>& x) {
    ContourSeries<S, K, 4> result;
    result.point = along_surface(r, x[0], x[1]);
    const Triple<Jet<S, K>> apart = result.point - along_surface(s, x[2], x[3]);
    result.equations = {apart.x, apart.y, apart.z};
    return result;
  }

  const SurfacePtr r_, s_;
  const Rectangle piece_r_, piece_s_;
  double rounding_ = 0;
};

}  // namespace

std::unique_ptr<ContourEquations<2>> function_equations(SurfacePtr surface, const Rectangle& piece,
                                                        SurfaceFunction function) {
  return std::make_unique<FunctionEquations>(std::move(surface), piece, std::move(function));
}

std::unique_ptr<ContourEquations<4>> intersection_equations(SurfacePtr r, const Rectangle& piece_r, SurfacePtr s,
                                                            const Rectangle& piece_s) {
  return std::make_unique<IntersectionEquations>(std::move(r), piece_r, std::move(s), piece_s);
}

}  // namespace lekalo::geometry
