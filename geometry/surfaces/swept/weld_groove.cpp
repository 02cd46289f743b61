// Grooves for welds along a seam (Grezdov, Filippenko 2010: the profile is that of the joint and varies along the
// seam). In the plane across the seam, n the direction in which the weld looks, b = t x n:
//
//   r(u, v) = g(v) + A(u) + tan(alpha(v)/2) B(u)
//
// A runs from the edge of the plate over (-g/2, f), (-g/2, 0), (g/2, 0), (g/2, f) to the other edge at the height T, g
// the gap, f the root face, T the thickness; B opens the edges by T - f. Between two surfaces n is the bisector of
// their normals and alpha = beta - pi + 2 bevel, pi - beta the angle of the normals.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/operations/moving_frame.h"
#include "geometry/curves/splines/polynomial_approximation.h"
#include "geometry/describe.h"
#include "geometry/expression/scalar_law.h"
#include "geometry/surfaces/swept/moved_sections.h"

namespace lekalo::geometry {

namespace {

// Directions across the seam at its points: n, or of two surfaces N x t.
struct Across {
  CurvePtr seam, first, second;
  bool is_between;
};

// b (k = 0) or n (1).
struct SeamAxis {
  Across across;
  int k;

  template <class T>
  Triple<T> operator()(const T& v) const {
    const Triple<T> along = curve_at(*across.seam, v, 1), t = (1.0 / length(along)) * along;
    const Triple<T> n = normal(v, t);
    return k == 0 ? cross(t, n) : n;
  }

 private:
  template <class T>
  Triple<T> normal(const T& v, const Triple<T>& t) const {
    if (!across.is_between) return curve_at(*across.first, v);
    const Triple<T> sum = curve_at(*across.first, v) + curve_at(*across.second, v);
    return cross(t, (1.0 / length(sum)) * sum);
  }
};

// tan(alpha/2)
struct Opening {
  ScalarLaw angle;  // alpha, or the bevel
  Across across;

  template <class T>
  Triple<T> operator()(const T& v) const {
    using std::cos;
    using std::sin;
    if (!across.is_between) {
      const T half = 0.5 * angle(v);
      return {sin(half) / cos(half), T(0), T(0)};
    }
    const T bevel = angle(v), tangent = sin(bevel) / cos(bevel);
    const Triple<T> a = curve_at(*across.first, v), b = curve_at(*across.second, v);
    const T turned = length(a - b) / length(a + b);  // of half the angle of the normals
    return {(tangent - turned) / (1.0 + tangent * turned), T(0), T(0)};
  }
};

// Polynomials that agree with a curve to this, of its size, stand for it: a seam is solved anew at every point.
constexpr double kSame = 1e-13;

Across read_across(const Fields& f) {
  Across across{as_polynomials(by_length_fraction(f.curve("seam")), kSame), nullptr, nullptr, f.has("between")};
  if (f.has("between") == f.has("normal") || f.has("between") != f.has("bevel") || f.has("normal") != f.has("angle"))
    throw FieldError("seam", "a groove has a normal and an angle, or a bevel between two surfaces",
                     "give 'normal' and 'angle', or 'between: [a, b]' and 'bevel'");
  FrameLaw law;
  if (f.has("normal")) {
    law.kind = FrameKind::fixed;
    law.fixed = f.vec3("normal");
    across.first = direction_across(*across.seam, law);
    return across;
  }
  const auto& surfaces = f.references("between");
  if (surfaces.size() != 2)
    throw FieldError("between", fmt::format("a seam joins two surfaces, not {}", surfaces.size()));
  law.kind = FrameKind::on_surface;
  for (size_t i = 0; i < 2; ++i) {
    law.on = std::any_cast<SurfacePtr>(surfaces[i]);
    try {
      (i == 0 ? across.first : across.second) = direction_across(*across.seam, law);
    } catch (const FieldError& error) {
      throw FieldError("between", fmt::format("surface {}: {}", i, error.what()), error.hint);
    }
  }
  return across;
}

CurvePtr outline(const std::vector<Vec3>& points) {
  NurbsCurveForm form{1, {0}, {}, {}};
  for (size_t i = 0; i < points.size(); ++i) {
    form.knots.push_back(static_cast<double>(i));
    form.points.emplace_back(points[i], 1);
  }
  form.knots.push_back(form.knots.back());
  return std::make_shared<NurbsCurve>(std::move(form));
}

std::any weld_groove(const Fields& f) {
  const double gap = 0.5 * f.number("gap"), face = f.number("root_face"), thick = f.number("thickness");
  if (!(face < thick)) throw FieldError("root_face", "the root face is not lower than the plate is thick");
  const Across across = read_across(f);
  CurveProperties properties = properties_of(*across.seam, 1);
  add_operand(properties, *across.first);
  if (across.second) add_operand(properties, *across.second);
  properties.period = 0;
  std::array<CurvePtr, 3> axes;
  for (int k = 0; k < 2; ++k)
    axes[k] = as_polynomials(std::make_shared<ComposedCurve<SeamAxis>>(SeamAxis{across, k}, properties), kSame);
  axes[2] = across.seam;  // both outlines are plane: it is not asked for
  const CurvePtr opening = std::make_shared<ComposedCurve<Opening>>(
      Opening{ScalarLaw(f.get<Expression>(across.is_between ? "bevel" : "angle")), across}, properties);
  constexpr int kPlaces = 64;
  for (int i = 0; i <= kPlaces; ++i)
    if (const double v = static_cast<double>(i) / kPlaces; !(opening->point(v).x >= 0))
      throw FieldError(across.is_between ? "bevel" : "angle",
                       fmt::format("the groove closes at s = {:.6g}: its angle is negative", v), "make it larger");
  const double open = thick - face;
  const CurvePtr closed =
      outline({{-gap, thick, 0}, {-gap, face, 0}, {-gap, 0, 0}, {gap, 0, 0}, {gap, face, 0}, {gap, thick, 0}});
  const CurvePtr opened = outline({{-open, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {open, 0, 0}});
  BooleanSum sum;
  sum.along_v = moved_sections(across.seam, axes, {{closed, opened}, {one_function({0, 1}), opening}});
  const Rectangle domain{closed->domain(), {0, 1}};
  auto surface = std::make_shared<BlendedSurface>(blended_surface(std::move(sum), domain));
  if (f.curve("seam")->is_closed() && is_closed_along(*surface, Along::v)) surface->close(Along::v, 1);
  return std::any(SurfacePtr(surface));
}

}  // namespace

TypeDeclaration weld_groove_type() {
  return declare(
             Category::surface, "weld_groove",
             "V-groove for a weld along a seam: root gap, root face and bevels, in the plane across the seam. u runs "
             "over the outline, v in 0..1 is the fraction s of the seam's length.")
      .example(
          "seam: { type: circle, radius: 3 }, normal: z, thickness: 0.6, gap: 0.1, root_face: 0.1, angle: 60 + "
          "20*sin(2*pi*s)")
      .field("seam", reference({Category::curve}), "the curve of the root; smooth")
      .optional("normal", direction(), "where the weld looks, as near as possible")
      .optional("angle", angle_formula({"s"}), "with a normal: between the edges, as a formula of s")
      .optional("between", references({Category::surface}),
                "two surfaces on which the seam lies: the weld looks along the bisector of their normals")
      .optional(
          "bevel", angle_formula({"s"}),
          "between two surfaces: of each edge, as a formula of s; the groove's angle is twice that less the angle "
          "of the normals")
      .field("thickness", length().positive(), "of the plate: height of the groove")
      .field("gap", length().positive(), "between the edges at the root")
      .field("root_face", length().positive(), "height of the upright part of the edges")
      .built_by(weld_groove);
}

}  // namespace lekalo::geometry
