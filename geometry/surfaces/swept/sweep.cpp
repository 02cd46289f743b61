// Surfaces that a section sweeps along a path with a moving frame (Golovanov 2016, 3.3.7; Grezdov, Filippenko 2010, 3):
//
//   r(u, v) = g(v) + X n + Y b + Z t,   (X, Y, Z) = R_t(twist) R_n(pitch) R_b(yaw) (k_x x, k_y y, z)
//
// v in 0..1 is the fraction of the path's length, (x, y, z) a point of the section, n, b = t x n, t the frame, R_a the
// turn about the axis a by a law of v (the paper's screw or torsion, somersault and pirouette). Sections
// at several v are blended by Hermite's cubics. The path has its arc length for parameter, so that laws are of v alone.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/operations/moving_frame.h"
#include "geometry/curves/splines/polynomial_approximation.h"
#include "geometry/describe.h"
#include "geometry/expression/scalar_law.h"
#include "geometry/surfaces/nets/curve_family.h"
#include "geometry/surfaces/swept/moved_sections.h"
#include "geometry/surfaces/swept/sweep.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

// How a section turns and grows in its frame, by formulas of v.
struct SectionLaws {
  ScalarLaw twist{0}, scale_x{1}, scale_y{1}, pitch{0}, yaw{0};
};

// Where the frame and the laws carry the k-th unit vector of a section's coordinates. With a rail h the section's x
// reaches from the path to it, d = h - g, and all of it grows by |d|: n = d/|d|, b along g' x n, and n x b for t.
struct SectionAxis {
  CurvePtr path, across, rail;  // g, n, and h in place of n
  SectionLaws laws;
  int k;

  template <class T>
  Triple<T> operator()(const T& v) const {
    Triple<T> q{T(k == 0 ? 1 : 0), T(k == 1 ? 1 : 0), T(k == 2 ? 1 : 0)};
    q.x = laws.scale_x(v) * q.x;
    q.y = laws.scale_y(v) * q.y;
    turn(laws.yaw, v, q.z, q.x);
    turn(laws.pitch, v, q.y, q.z);
    turn(laws.twist, v, q.x, q.y);
    const Triple<T> along = curve_at(*path, v, 1);
    if (rail) {
      const Triple<T> d = curve_at(*rail, v) - curve_at(*path, v), side = cross(along, d);
      const T reach = length(d);
      const Triple<T> b = (reach / length(side)) * side;
      return q.x * d + q.y * b + q.z * ((1.0 / reach) * cross(d, b));
    }
    const Triple<T> n = curve_at(*across, v);
    const Triple<T> t = (1.0 / length(along)) * along;
    return q.x * n + q.y * cross(t, n) + q.z * t;
  }

 private:
  // From the direction of a towards that of b.
  template <class T>
  static void turn(const ScalarLaw& law, const T& v, T& a, T& b) {
    using std::cos;
    using std::sin;
    if (law.is_zero()) return;
    const T angle = law(v), c = cos(angle), s = sin(angle), before = a;
    a = c * before - s * b;
    b = s * before + c * b;
  }
};

// Polynomials where those agree with the axes to this share, as the direction across does: they are asked for often.
constexpr double kSameAxis = 1e-13;

std::array<CurvePtr, 3> section_axes(const SectionAxis& axis, const Interval& range) {
  CurveProperties properties = properties_of(*axis.path, 1);
  add_operand(properties, axis.rail ? *axis.rail : *axis.across);
  cut_to(properties, range);
  properties.period = 0;
  std::array<CurvePtr, 3> axes;
  for (int k = 0; k < 3; ++k) {
    SectionAxis of_unit = axis;
    of_unit.k = k;
    axes[k] = as_polynomials(std::make_shared<ComposedCurve<SectionAxis>>(of_unit, properties), kSameAxis);
  }
  return axes;
}

// The direction from the path to another curve, less what of it lies along the path.
struct Towards {
  CurvePtr path, other;
  template <class T>
  Triple<T> operator()(const T& v) const {
    const Triple<T> along = curve_at(*path, v, 1), d = curve_at(*other, v) - curve_at(*path, v);
    const Triple<T> across = d - (dot(d, along) / dot(along, along)) * along;
    return (1.0 / length(across)) * across;
  }
};

// The curve must stand beside the path: places looked at, and the least sine of the angle between its direction and the
// path's.
constexpr int kPlacesBeside = 256;
constexpr double kMinSine = 1e-6;

void check_beside(const Curve& path, const Curve& other, const char* field) {
  const double size = bounds(path).diameter();
  const Interval range = path.domain();
  for (int i = 0; i <= kPlacesBeside; ++i) {
    const double v = range.lo + range.width() * i / kPlacesBeside;
    const CurveJet at = path.evaluate(v, 1);
    const Vec3 d = other.point(v) - at.d[0];
    if (!(glm::length(d) > kMinSine * size))
      throw FieldError(field, fmt::format("the curve meets the path at s = {:.6g}", (v - range.lo) / range.width()),
                       "it runs beside the path");
    if (!(glm::length(glm::cross(d, at.d[1])) > kMinSine * glm::length(d) * glm::length(at.d[1])))
      throw FieldError(
          field,
          fmt::format("at s = {:.6g} the curve lies in the direction of the path", (v - range.lo) / range.width()),
          "it runs beside the path");
  }
}

// A section in the coordinates of the frame where it stands.
CurvePtr in_frame(const CurvePtr& curve, const Frame& frame) {
  const Mat3 linear = glm::transpose(Mat3(frame.x, frame.y, frame.z));
  return transformed(curve, {linear, -(linear * frame.origin)});
}

Frame frame_at(const Curve& path, const Curve& across, double v) {
  const CurveJet at = path.evaluate(v, 1);
  const Vec3 t = glm::normalize(at.d[1]), n = across.point(v);
  return {at.d[0], n, glm::cross(t, n), t};
}

struct Placed {
  std::vector<CurvePtr> curves;
  std::vector<double> at;
};

Placed read_sections(const Fields& f) {
  if (f.has("section") == f.has("sections"))
    throw FieldError(f.has("section") ? "sections" : "section", "a sweep has one section, or several at their places",
                     "give 'section: NAME', or 'sections: [{ s: 0, section: NAME }, ..]'");
  Placed result;
  if (f.has("section")) {
    result.curves = {f.curve("section")};
    result.at = {0};
    return result;
  }
  for (const Fields& one : f.groups("sections")) {
    result.curves.push_back(one.curve("section"));
    result.at.push_back(one.number("s"));
    if (result.at.size() > 1 && !(result.at.back() > result.at[result.at.size() - 2]))
      throw FieldError("sections", fmt::format("section {} does not lie behind the one before", result.at.size() - 1),
                       "give them in the order of s");
  }
  return result;
}

std::vector<CurvePtr> functions_between(const std::vector<double>& at) {
  if (at.size() == 1) return {one_function({0, 1})};
  if (at.front() != 0 || at.back() != 1)
    throw FieldError("sections", fmt::format("the sections reach from s = {:.6g} to {:.6g}", at.front(), at.back()),
                     "the first stands at s: 0, the last at s: 1");
  return hermite_functions(at, false);
}

FrameLaw read_frame(const Fields& f) {
  FrameLaw law;
  if (f.holds<Fields>("frame")) {
    if (f.group("frame").has("fixed") == f.group("frame").has("given"))
      throw FieldError("frame", "a frame follows a direction or a curve",
                       "give { fixed: direction }, or { given: curve }");
    law.kind = FrameKind::fixed;
    if (f.group("frame").has("fixed")) law.fixed = f.group("frame").vec3("fixed");
  } else {
    law.kind = f.text("frame") == "frenet" ? FrameKind::normal : FrameKind::rotation_minimizing;
  }
  if (f.has("start")) {
    if (law.kind != FrameKind::rotation_minimizing)
      throw FieldError("start", "only a frame that turns no more than it must begins in a given direction");
    law.start = f.vec3("start");
  }
  return law;
}

// The path's parameter or its frame is not smooth: said of the fields of a sweep in place of those of a curve's ribbon.
[[noreturn]] void refuse_path(const FieldError& error, const FrameLaw& law, const char* field) {
  if (error.field == "across")
    throw FieldError("frame", error.what(),
                     law.kind == FrameKind::normal ? "frame: rotation_minimizing suits any smooth curve" : error.hint);
  if (error.field == "of")
    throw FieldError(field, error.what(), "sweep along smooth parts of it, or round its corners (rounded_corners)");
  throw error;
}

// The frame's normal along the path. `other`: of a curve that it looks at, over the path's parameter.
CurvePtr frame_along(const CurvePtr& path, const CurvePtr& other, const FrameLaw& law, const char* field) {
  if (other) {
    check_beside(*path, *other, "frame");
    CurveProperties properties = properties_of(*path, 1);
    add_operand(properties, *other);
    return as_polynomials(std::make_shared<ComposedCurve<Towards>>(Towards{path, other}, properties), kSameAxis);
  }
  try {
    return direction_across(*path, law);
  } catch (const FieldError& error) {
    refuse_path(error, law, field);
  }
}

// The curve that the frame's normal looks at; null: none.
CurvePtr given_curve(const Fields& f) {
  const bool is_given = f.holds<Fields>("frame") && f.group("frame").has("given");
  return is_given ? f.group("frame").curve("given") : nullptr;
}

std::vector<double> read_places(const Fields& f, size_t count, const Curve& guide) {
  const std::vector<double>& at = f.numbers("at_v");
  if (at.size() != count) throw FieldError("at_v", fmt::format("{} values for {} curves", at.size(), count));
  for (size_t i = 0; i < count; ++i) {
    if (i > 0 && !(at[i] > at[i - 1]))
      throw FieldError("at_v", fmt::format("value {} is not greater than the one before", i), "they increase");
    if (!guide.domain().contains(at[i]))
      throw FieldError("at_v", fmt::format("value {} lies outside of the guide's {:.6g} to {:.6g}", i,
                                           guide.domain().lo, guide.domain().hi));
  }
  return at;
}

// Over the range of v, closed with the period if it goes on where it ends as it begins.
SurfacePtr swept(const CurvePtr& path, const std::array<CurvePtr, 3>& axes, const Family& sections,
                 const Interval& range, double period) {
  BooleanSum sum;
  sum.along_v = moved_sections(path, axes, sections);
  const Rectangle domain{sections.curves.front()->domain(), range};
  const double period_u = common_period(sections.curves);
  auto surface = std::make_shared<BlendedSurface>(blended_surface(std::move(sum), domain, {period_u, 0}));
  if (period > 0 && is_closed_along(*surface, Along::v)) surface->close(Along::v, period);
  return surface;
}

// Through curves that stand in space along a guide (Golovanov 2016, 3.4.9): each is carried along the guide by its
// frame,
//
//   r_i(u, v) = g(v) + A(v) A^T(v_i) (c_i(u) - g(v_i)),   r = a_0(w) r_i + a_1(w) r_(i+1)
//
// with a_0 = 1 - 3 w^2 + 2 w^3, a_1 = 1 - a_0 between v_i and v_(i+1). (The printed g(v) in place of g(v_i) would miss
// the curves.) Sections in the frame's own coordinates do not ask where they come from: the blend is of these.
SurfacePtr loft_along(const Fields& f, const std::vector<CurvePtr>& curves) {
  const CurvePtr guide = f.curve("along");
  const std::vector<double> at = read_places(f, curves.size(), *guide);
  CurvePtr other = given_curve(f);
  if (other && other->domain() != guide->domain()) other = with_domain(other, guide->domain());
  const CurvePtr across = frame_along(guide, other, read_frame(f), "along");
  Family sections{{}, step_functions(at)};
  for (size_t i = 0; i < curves.size(); ++i)
    sections.curves.push_back(in_frame(curves[i], frame_at(*guide, *across, at[i])));
  const Interval range(at.front(), at.back());
  return swept(guide, section_axes({guide, across, nullptr, {}, 0}, range), sections, range, 0);
}

SectionLaws read_laws(const Fields& f) {
  const auto law = [&](const char* field) { return ScalarLaw(f.get<Expression>(field)); };
  const auto& scale = f.get<std::vector<Expression>>("scale");
  return {law("twist"), ScalarLaw(scale.front()), ScalarLaw(scale.back()), law("pitch"), law("yaw")};
}

FieldType frame_kind() {
  return group(
             {{"fixed", direction(), "the normal is as near as possible to this direction", false, {}},
              {"given",
               reference({Category::curve}),
               "or the normal looks at the point of this curve at the same fraction of its length (of a guide, of its "
               "parameter)",
               false,
               {}}})
      .or_word({"rotation_minimizing", "frenet"});
}

std::any sweep(const Fields& f) {
  const SectionMotion motion(f);
  Placed placed = read_sections(f);
  if (f.boolean("placed"))
    for (CurvePtr& curve : placed.curves)
      curve = transformed(in_frame(curve, motion.frame(0)), Affine::scaling(Vec3(1 / motion.reach(0))));
  const std::vector<CurvePtr> curves = placed.curves.size() == 1 ? placed.curves : one_domain(placed.curves, f);
  return std::any(motion.surface(curves, placed.at));
}

}  // namespace

SurfacePtr guided_loft(const Fields& f, const std::vector<CurvePtr>& curves) { return loft_along(f, curves); }

FieldType guide_frame() { return frame_kind(); }

SectionMotion::SectionMotion(const Fields& f) {
  const FrameLaw law = read_frame(f);
  CurvePtr other = given_curve(f);
  try {
    path_ = by_length_fraction(f.curve("path"));
  } catch (const FieldError& error) {
    refuse_path(error, law, "path");
  }
  if (f.has("rail")) {
    if (f.given("frame") || f.has("start"))
      throw FieldError("rail", "the rail turns the section", "leave out 'frame' and 'start'");
    rail_ = by_length_fraction(f.curve("rail"));
    check_beside(*path_, *rail_, "rail");
  } else {
    if (other) other = by_length_fraction(other);
    across_ = frame_along(path_, other, law, "path");
  }
  axes_ = section_axes({path_, across_, rail_, read_laws(f), 0}, {0, 1});
}

Frame SectionMotion::frame(double v) const {
  if (!rail_) return frame_at(*path_, *across_, v);
  const CurveJet at = path_->evaluate(v, 1);
  const Vec3 n = glm::normalize(rail_->point(v) - at.d[0]), b = glm::normalize(glm::cross(at.d[1], n));
  return {at.d[0], n, b, glm::cross(n, b)};
}

double SectionMotion::reach(double v) const { return rail_ ? glm::length(rail_->point(v) - path_->point(v)) : 1; }

Affine SectionMotion::placement(double v) const {
  return {Mat3(axes_[0]->point(v), axes_[1]->point(v), axes_[2]->point(v)), path_->point(v)};
}

SurfacePtr SectionMotion::surface(const std::vector<CurvePtr>& sections, const std::vector<double>& at) const {
  return swept(path_, axes_, {sections, functions_between(at)}, {0, 1}, path_->is_closed() ? 1 : 0);
}

TypeDeclaration guided_loft_type() {
  return declare(Category::surface, "guided_loft",
                 "Surface through curves that stand along a guide: the guide's frame carries each to its neighbours, "
                 "and between two they are blended smoothly. u is the curves' parameter, v the guide's.")
      .example(
          "of: [{ type: circle, radius: 0.5, center: [2, 0, 0], normal: y }, { type: circle, radius: 1, center: "
          "[0, 2, 0], normal: -x }], along: { type: circle, radius: 2 }, at_v: [0, 90 deg], frame: { fixed: z }")
      .field("of", references({Category::curve}), "the curves in their order, where they stand")
      .field("along", reference({Category::curve}), "the guide; smooth")
      .field("at_v", numbers(), "the guide's parameter at each curve, increasing")
      .field("frame", frame_kind(),
             "how the guide's frame turns: no more than it must, as the guide's normal and binormal, or { fixed: "
             "direction }, or { given: curve }",
             "rotation_minimizing")
      .field("match", choice({"parameter", "arc_length"}), "which points of the curves belong together", "parameter")
      .built_by([](const Fields& f) { return std::any(guided_loft(f, read_family(f, "of"))); });
}

void declare_motion(TypeDeclaration& type) {
  type.field("frame", frame_kind(),
             "how it turns: about the path no more than it must (and closing with a closed path), as the path's normal "
             "and "
             "binormal, or { fixed: direction }, or { given: curve }",
             "rotation_minimizing")
      .optional("start", direction(), "of rotation_minimizing: the direction of the normal where the path begins")
      .field("twist", angle_formula({"s"}), "further turn about the path, as a formula of s", "0")
      .field("pitch", angle_formula({"s"}), "turn of the section about the frame's normal, before the twist", "0")
      .field("yaw", angle_formula({"s"}), "turn of the section about the frame's binormal, before the pitch", "0")
      .field("scale", formulas({"s"}, 1, 2),
             "of the section, as a formula of s, or one along its x and one along its y", "1");
}

TypeDeclaration sweep_surface_type() {
  TypeDeclaration type =
      declare(Category::surface, "sweep_surface",
              "What a section, or several, sweep along a path. The section lies in the plane x, y: its x goes to the "
              "frame's normal, its y to the binormal. u is the section's parameter, v in 0..1 the fraction s of the "
              "path's length; laws are formulas of s.")
          .example(
              "path: { type: bezier_curve, points: [[0, 0, 0], [0, 0, 3], [3, 0, 3]] }, section: { type: circle, "
              "radius: "
              "0.5 }")
          .field("path", reference({Category::curve}), "the curve along which; smooth")
          .optional("section", reference({Category::curve}), "the curve that is moved")
          .optional(
              "sections",
              groups({{"s", number().between(0, 1), "fraction of the path's length, 0..1", true, {}},
                      {"section", reference({Category::curve}), "the curve there", true, {}}}),
              "several in place of one, the first at s: 0, the last at s: 1; between them the shape changes smoothly");
  declare_motion(type);
  type.optional(
      "rail", reference({Category::curve}),
      "a second rail beside the path, by the fraction of its length: the section's x runs to it in place of a "
      "frame's normal, and the section grows with the distance: (0, 0) stays on the path, (1, 0) on the rail");
  type.field("match", choice({"parameter", "arc_length"}), "which points of several sections belong together",
             "parameter")
      .field("placed", boolean(), "the section stands in space as it is at the path's beginning", "false")
      .built_by(sweep);
  return type;
}

}  // namespace lekalo::geometry
