// Profiles of passes (Zavyalov et al. 1985, V.3):
//
//   r_k(x) = (1 - q) r_0(x) + q r(x),   q = k/n, or given pass by pass,   k = 1 ... n
//
// r_0 the blank, r the part, both graphs over x. The parameter is that of the part's profile. The blank is met where
// its x is that of the part: x_0(s) = x(t), whose Taylor polynomial s(t) follows coefficient by coefficient, because
// the highest of them enters linearly. A tool with an elliptic edge of half axes p along x and q across touches the
// profile with its center at
//
//   c = r_k + (p^2 n_x, q^2 n_y) / sqrt(p^2 n_x^2 + q^2 n_y^2)
//
// n the unit normal away from the axis.
#include "geometry/machining/turning_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/composition.h"
#include "geometry/describe.h"
#include "geometry/machining/tool_path.h"

namespace lekalo::geometry {

namespace {

constexpr int kTried = 1024;  // places where slopes and depths are looked at
constexpr double kDegree = kPi / 180;

// A curve whose x grows, or falls, all along it.
class GraphOverX {
 public:
  GraphOverX(CurvePtr curve, const char* field) : curve_(std::move(curve)) {
    const Interval t = curve_->domain();
    if (!(t.width() < kInfinity)) throw FieldError(field, "the profile is unbounded", "give it a domain");
    direction_ = curve_->point(t.hi).x > curve_->point(t.lo).x ? 1 : -1;
    double before = curve_->point(t.lo).x;
    for (int k = 1; k <= kTried; ++k) {
      const Vec3 at = curve_->point(t.clamp(t.lo + t.width() * k / kTried));
      if (!(direction_ * (at.x - before) > 0))
        throw FieldError(
            field, fmt::format("the profile is no graph over x: it stands still or turns back at x = {:.6g}", at.x),
            "split it where it is upright or runs back");
      before = at.x;
    }
  }
  const Curve& curve() const { return *curve_; }
  Interval range() const {
    const double a = curve_->point(curve_->domain().lo).x, b = curve_->point(curve_->domain().hi).x;
    return {std::min(a, b), std::max(a, b)};
  }

  // s(x); outside of the range the nearer end.
  double parameter(double x) const { return parameter_at_x(*curve_, x); }
  // Somewhat wider than what x in the interval needs: points are rounded.
  Interval parameter(const Interval& x) const {
    const double slack = 1e-13 * range().width();
    const double a = parameter(direction_ > 0 ? x.lo - slack : x.hi + slack),
                 b = parameter(direction_ > 0 ? x.hi + slack : x.lo - slack);
    return {curve_->domain().clamp(next_down(a)), curve_->domain().clamp(next_up(b))};
  }
  template <class S, int N>
  Jet<S, N> parameter(const Jet<S, N>& x) const {
    Jet<S, N> s(parameter(x.value()));
    const S speed = curve_at(*curve_, s.value(), 1).x;
    for (int k = 1; k <= N; ++k) s.c[k] = (x.c[k] - curve_at(*curve_, s).x.c[k]) / speed;
    return s;
  }

 private:
  CurvePtr curve_;
  double direction_ = 1;
};

struct Between {
  CurvePtr part;
  std::shared_ptr<const GraphOverX> blank;
  double share;  // of the part

  template <class T>
  Triple<T> operator()(const T& t) const {
    const Triple<T> r = curve_at(*part, t);
    if (share == 1) return r;
    const T y = curve_at(blank->curve(), blank->parameter(r.x)).y;
    return {r.x, T(1 - share) * y + T(share) * r.y, r.z};
  }
};

struct OnEllipse {
  CurvePtr of;
  double p, q;
  double side;  // of the normal that points away from the axis

  template <class T>
  Triple<T> operator()(const T& t) const {
    using std::sqrt;
    const Triple<T> r = curve_at(*of, t), along = curve_at(*of, t, 1);
    const T x = T(-side * p) * along.y, y = T(side * q) * along.x;
    const T size = sqrt(x * x + y * y);
    return {r.x + T(p) * x / size, r.y + T(q) * y / size, r.z};
  }
};

CurvePtr between(const CurvePtr& part, const std::shared_ptr<const GraphOverX>& blank, const GraphOverX& over,
                 double share) {
  CurveProperties properties = properties_of(*part);
  for (const CurvePiece& piece : blank->curve().pieces()) {
    const double t = over.parameter(blank->curve().point(piece.domain.lo).x);
    if (properties.domain.contains(t)) properties.breaks.push_back(t);
  }
  std::sort(properties.breaks.begin(), properties.breaks.end());
  properties.breaks.erase(std::unique(properties.breaks.begin(), properties.breaks.end()), properties.breaks.end());
  properties.max_order = std::min(properties.max_order, blank->curve().max_order());
  properties.enclosure_order = std::min(properties.enclosure_order, blank->curve().enclosure_order());
  properties.period = 0;
  return std::make_shared<ComposedCurve<Between>>(Between{part, blank, share}, properties);
}

// The largest r_0 - r.
double largest_depth(const Curve& part, const GraphOverX& blank) {
  double depth = 0;
  const Interval domain = part.domain();
  for (int k = 0; k <= kTried; ++k) {
    const Vec3 r = part.point(domain.clamp(domain.lo + domain.width() * k / kTried));
    const double left = blank.curve().point(blank.parameter(r.x)).y - r.y;
    const double rounding = 1e-12 * (1 + std::abs(r.y));
    if (left < -rounding)
      throw FieldError("blank", fmt::format("at x = {:.6g} the blank lies {:.3g} below the part", r.x, -left),
                       "a blank holds the part everywhere");
    if (r.y < -rounding) throw FieldError("of", fmt::format("at x = {:.6g} the radius is negative", r.x));
    depth = std::max(depth, left);
  }
  return depth;
}

// Of the pass: which part of the way from the blank to the part is then behind.
double share_of(const Fields& f, int pass, int passes) {
  if (pass == 0 || !f.has("shares")) return static_cast<double>(pass) / passes;
  return f.numbers("shares")[static_cast<size_t>(pass - 1)];
}

int count_of_shares(const std::vector<double>& shares) {
  double before = 0;
  for (const double share : shares) {
    if (!(share > before)) throw FieldError("shares", "each pass goes farther than the one before", "[0.5, 0.9, 1]");
    before = share;
  }
  if (before != 1) throw FieldError("shares", fmt::format("the last pass ends at {:g}", before), "at 1: the part");
  return static_cast<int>(shares.size());
}

int passes_of(const Fields& f, double depth) {
  const int given = (f.has("passes") ? 1 : 0) + (f.has("depth") ? 1 : 0) + (f.has("shares") ? 1 : 0);
  if (given != 1)
    throw FieldError(f.has("depth")    ? "depth"
                     : f.has("shares") ? "shares"
                                       : "passes",
                     "the passes are given by their number, the depth of cut, or their shares", "give one of these");
  if (f.has("shares")) return count_of_shares(f.numbers("shares"));
  if (f.has("passes")) return f.integer("passes");
  const double count = std::ceil(depth / f.number("depth") - 1e-9);
  if (count > 1000) throw FieldError("depth", fmt::format("{:g} passes are needed", count), "take a larger depth");
  return std::max(1, static_cast<int>(count));
}

void find_steepest(TurningPlan& plan, bool forward) {
  const Curve& profile = *plan.profile;
  const Interval domain = profile.domain();
  plan.steepest = -kPi;
  for (int k = 0; k <= kTried; ++k) {
    const double t = domain.clamp(domain.lo + domain.width() * k / kTried);
    const CurveJet at = profile.evaluate(t, 1);
    const double falls = (forward ? -1 : 1) * at.d[1].y * (at.d[1].x < 0 ? -1 : 1);
    const double slope = std::atan2(falls, std::abs(at.d[1].x));
    if (slope > plan.steepest) plan.steepest = slope, plan.steepest_at = at.d[0].x;
  }
}

void check_tool(const TurningPlan& plan, const Fields& f) {
  if (!f.has("tool_angle") || plan.steepest < f.number("tool_angle")) return;
  throw FieldError("tool_angle",
                   fmt::format("at x = {:.4g} the profile falls by {:.4g} degrees, the tool has only {:.4g}",
                               plan.steepest_at, plan.steepest / kDegree, f.number("tool_angle") / kDegree),
                   "take a more pointed tool, or turn that part with feed in the other direction");
}

TurningPlan plan_of_pass(const Fields& f, const CurvePtr& part) {
  const auto over = std::make_shared<const GraphOverX>(part, "of");
  const auto blank = std::make_shared<const GraphOverX>(f.curve("blank"), "blank");
  const Interval mine = over->range(), other = blank->range();
  if (mine.lo < other.lo - 1e-9 * mine.width() || mine.hi > other.hi + 1e-9 * mine.width())
    throw FieldError("blank",
                     fmt::format("the blank reaches from x = {:.6g} to {:.6g}, the part from {:.6g} to {:.6g}",
                                 other.lo, other.hi, mine.lo, mine.hi),
                     "a blank as long as the part, or longer");
  TurningPlan plan;
  plan.passes = passes_of(f, largest_depth(*part, *blank));
  plan.pass = f.has("pass") ? f.integer("pass") : plan.passes;
  if (plan.pass > plan.passes)
    throw FieldError("pass", fmt::format("there is no pass {}", plan.pass), fmt::format("the last is {}", plan.passes));
  const auto after = [&](int k) { return between(part, blank, *over, share_of(f, k, plan.passes)); };
  plan.before = after(std::max(plan.pass - 1, 0));
  plan.profile = after(plan.pass);
  return plan;
}

void check_centers(const Curve& centers, const Curve& profile) {
  check_jumps(profile, properties_of(profile).breaks, [&](double t) { return centers.point(t); });
  if (const auto t = where_it_runs_back(centers, [&](double s) { return profile.evaluate(s, 1).d[1]; }))
    throw FieldError("edge", fmt::format("at x = {:.4g} the profile is hollower than the edge", profile.point(*t).x),
                     "take a smaller tool");
}

CurvePtr path_of(const TurningPlan& plan, const Fields& f) {
  if (!f.has("edge")) return plan.profile;
  const std::vector<double>& edge = f.numbers("edge");
  const Interval domain = plan.profile->domain();
  const double side = plan.profile->point(domain.hi).x > plan.profile->point(domain.lo).x ? 1 : -1;
  const CurvePtr centers = std::make_shared<ComposedCurve<OnEllipse>>(OnEllipse{plan.profile, edge[0], edge[1], side},
                                                                      properties_of(*plan.profile, 1));
  check_centers(*centers, *plan.profile);
  return centers;
}

}  // namespace

TypeDeclaration turning_pass_type() {
  return declare(
             Category::curve, "turning_pass",
             "Profile that a pass of turning leaves between a blank and a part, about the axis x, or the path of the "
             "tool that cuts it (Zavyalov et al. 1985, V.3).")
      .example(
          "of: { type: segment, from: [0, 1], to: [4, 2] }, blank: { type: segment, from: [0, 3], to: [4, 3] }, "
          "passes: 4, pass: 2")
      .field("of", reference({Category::curve}), "profile of the part: radius y over x")
      .field("blank", reference({Category::curve}), "profile of the blank, nowhere below it")
      .optional("passes", integer().between(1, 1000), "how many")
      .optional("depth", length().positive(), "or the largest radial depth of cut of one")
      .optional("shares", numbers().count(1, 1000).above(0).at_most(1),
                "or, of each pass, the part of the way from the blank to the part that is then behind, the last 1")
      .optional("pass", integer().at_least(0), "which, from 1; 0 is the blank; the last without it")
      .field("feed_direction", choice({"right", "left"}), "along x or against it", "right")
      .optional("tool_angle", angle().between(0, kPi / 2),
                "phi, at the tool's point between its edge and the axis: the profile falls along the feed by less")
      .optional(
          "edge", numbers().count(2, 2).above(0),
          "half axes of a tool with an elliptic edge, along x and across: the path is that of the ellipse's center")
      .optional("feed", length().positive(), "largest distance of neighbouring places of the tool")
      .optional("allowance", length().positive(), "what is taken off along the normal at these")
      .shows({"feed_points"})
      .built_by([](const Fields& f) -> std::any {
        if (f.has("allowance") && !f.has("feed"))
          throw FieldError("allowance", "the depths are told at places of the tool", "give 'feed' too");
        TurningPlan plan = plan_of_pass(f, f.curve("of"));
        const bool forward = f.text("feed_direction") == "right";
        find_steepest(plan, forward);
        check_tool(plan, f);
        if (f.has("feed"))
          plan.feed_points =
              feed_points(*plan.profile, f.number("feed"), f.has("allowance") ? f.number("allowance") : 0.0, forward);
        CurvePtr path = path_of(plan, f);
        return CurvePtr(std::make_shared<PlannedPath<TurningPlan>>(std::move(path), std::move(plan)));
      });
}

}  // namespace lekalo::geometry
