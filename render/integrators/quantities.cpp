#include "render/integrators/quantities.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/expression/expression.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/closest/nearest_on_surface.h"
#include "geometry/queries/differential/stretch.h"
#include "geometry/spatial/nearest_points.h"
#include "render/model/attributes.h"
#include "render/model/objects.h"
#include "render/model/section_faces.h"

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr double kDegrees = 180 / kPi;

using Value = std::optional<double>;

// Ranges reach over all values but these at either end, and have so many digits.
constexpr double kLeftOut = 0.02;
constexpr int kDigits = 2;
constexpr int kPlaces = 40;  // of a surface, a side

// Rounded away from zero or towards it, to few digits.
double rounded(double x, bool up) {
  if (x == 0) return 0;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(x))) - (kDigits - 1));
  const double part = x / unit;
  const double nearest = std::nearbyint(part);
  if (std::abs(part - nearest) < 1e-9 * std::abs(part)) return nearest * unit;
  return (up ? std::ceil(part) : std::floor(part)) * unit;
}

double angle_between(const Vec3& a, const Vec3& b) {
  return kDegrees * std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// The line of sight mirrored in the surface: d - 2 (d . m) m.
Vec3 mirrored_sight(const SurfacePoint& at) { return at.incoming - 2 * glm::dot(at.incoming, at.normal) * at.normal; }
// The normal on the viewer's side.
Vec3 seen_normal(const SurfacePoint& at) {
  return glm::dot(at.incoming, at.geometric_normal) < 0 ? at.normal : -at.normal;
}

Quantity of_curvature(const char* name, bool has_sign, double (*value)(const SurfaceCurvature&)) {
  Quantity q;
  q.name = name;
  q.has_sign = has_sign;
  q.needs_curvature = true;
  q.value = [value](const AnalysedPlace& at) -> Value {
    return at.curvature.regular ? Value(value(at.curvature)) : std::nullopt;
  };
  return q;
}

// Stripes of lamps at an infinite distance about an axis: the angle between it and the mirrored line of sight.
Quantity zebra(const Vec3& axis, int stripes) {
  Quantity q;
  q.value = [axis](const AnalysedPlace& at) -> Value { return angle_between(mirrored_sight(at.point), axis); };
  q.stripe = 180.0 / stripes;
  return q;
}

// The angle between the normal on the viewer's side and the direction; its lines of equal value are isophotes.
Quantity isophotes(const Vec3& light, int stripes) {
  Quantity q;
  q.value = [light](const AnalysedPlace& at) -> Value { return angle_between(seen_normal(at.point), light); };
  q.stripe = 180.0 / stripes;
  return q;
}

// Parallel lamps in a plane, the first of them given: the distance from it, across the lamps, at which the mirrored
// line of sight meets their plane. Lamps and the gaps between them are equally wide.
Quantity reflection_lines(const Axis& lamp, const Vec3& plane_normal, double spacing) {
  const Vec3 across = glm::cross(plane_normal, lamp.along);
  if (!(glm::length(across) > 1e-9))
    throw FieldError("ceiling", "the lamps would stand upright on their plane",
                     "the normal of the plane of the lamps is across them");
  const Vec3 unit_across = glm::normalize(across), normal = glm::normalize(glm::cross(lamp.along, unit_across));
  Quantity q;
  q.value = [=](const AnalysedPlace& at) -> Value {
    const Vec3 way = mirrored_sight(at.point), from = lamp.through - at.point.position;
    const double t = glm::dot(from, normal) / glm::dot(way, normal);
    if (!(t > 0 && t < kInfinity)) return std::nullopt;  // it does not meet the plane
    return glm::dot(t * way - from, unit_across) + 0.25 * spacing;
  };
  q.stripe = 0.5 * spacing;
  return q;
}

// Between the tangent plane and the direction in which a mould is pulled off: positive where the mould lets go.
Quantity draft(const Vec3& pull) {
  Quantity q;
  q.has_sign = true;
  q.value = [pull](const AnalysedPlace& at) -> Value { return 90 - angle_between(at.point.normal, pull); };
  return q;
}

// Squares of the parameter plane, so many over the domain: 0 or 1.
Quantity parameter_checker(int count_u, int count_v) {
  Quantity q;
  q.needs_parameters = true;
  q.stripe = 1;
  q.value = [=](const AnalysedPlace& at) -> Value {
    if (!at.surface) return std::nullopt;
    const Rectangle domain = at.surface->domain();
    const auto cell = [](double x, const Interval& range, int count) {
      return range.width() < kInfinity ? std::floor(count * (x - range.lo) / range.width()) : std::floor(x);
    };
    const double sum = cell(at.point.u, domain.u, count_u) + cell(at.point.v, domain.v, count_v);
    return std::fmod(sum, 2) == 0 ? 0 : 1;
  };
  return q;
}

// From the nearest point of another surface, positive on the side that its normal looks to.
Quantity distance_to(const SurfacePtr& other) {
  const auto nearest_on = [&] {
    try {
      return NearestOnSurface(other);
    } catch (const std::invalid_argument& error) {
      throw FieldError("to", error.what());
    }
  }();
  Quantity q;
  q.has_sign = true;
  q.value = [nearest_on, other](const AnalysedPlace& at) -> Value {
    const std::optional<SurfaceFootPoint> nearest = nearest_on(at.point.position);
    if (!nearest) return std::nullopt;
    const bool behind = glm::dot(at.point.position - nearest->point, other->normal(nearest->u, nearest->v)) < 0;
    return behind ? -nearest->distance : nearest->distance;
  };
  return q;
}

// From the nearest point of a curve.
Quantity distance_to(const CurvePtr& other) {
  if (!(other->domain().width() < kInfinity)) throw FieldError("to", "the curve has no ends: give it a domain");
  Quantity q;
  q.value = [projector = CurveProjector(other)](const AnalysedPlace& at) -> Value {
    const CurveFootPoints found = projector.foot_points(at.point.position);
    return found.foot_points.empty() ? std::nullopt : Value(found.foot_points.front().distance);
  };
  return q;
}

// Of laying the surface on another one of the same parameters: that one of the principal strains that is larger.
Quantity strain_to(const SurfacePtr& other) {
  Quantity q;
  q.has_sign = true;
  q.needs_parameters = true;
  q.value = [other](const AnalysedPlace& at) -> Value {
    if (!at.surface || !other->domain().contains(at.point.u, at.point.v)) return std::nullopt;
    const auto [a, b] = principal_stretches(*at.surface, *other, at.point.u, at.point.v);
    const double strain_a = Stretch{a}.strain(), strain_b = Stretch{b}.strain();
    return std::abs(strain_a) > std::abs(strain_b) ? strain_a : strain_b;
  };
  return q;
}

// How high the nearest of given points lies over the tangent plane, on the side of the normal.
Quantity deviation_of(const std::vector<Vec3>& points) {
  const auto tree = std::make_shared<const NearestPoints>(points);
  Quantity q;
  q.has_sign = true;
  q.value = [tree](const AnalysedPlace& at) -> Value {
    return glm::dot(tree->nearest(at.point.position) - at.point.position, at.point.normal);
  };
  return q;
}

const std::vector<std::string> kVariables = {"x", "y", "z", "u", "v", "K", "H", "k1", "k2"};

Quantity of_formula(const Expression& formula) {
  const auto has = [&](std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(), [&](const char* name) {
      return std::find(formula.names().begin(), formula.names().end(), name) != formula.names().end();
    });
  };
  Quantity q;
  q.name = "formula";
  q.needs_curvature = has({"K", "H", "k1", "k2"});
  q.needs_parameters = has({"u", "v"});
  q.value = [formula, curved = q.needs_curvature, parametric = q.needs_parameters](const AnalysedPlace& at) -> Value {
    const SurfaceCurvature& c = at.curvature;
    if ((curved && !c.regular) || (parametric && !at.surface)) return std::nullopt;
    const Vec3& p = at.point.position;
    const std::array<double, 9> values{
        p.x, p.y, p.z, at.point.u, at.point.v, c.gaussian, c.mean, c.principal[0], c.principal[1]};
    return formula.evaluate<double>(values);
  };
  return q;
}

// What is said of the face that is seen, or what it inherits.
Quantity of_attribute(const Fields& f) {
  const std::string& name = f.text("attribute");
  const auto table = f.get<std::shared_ptr<const AttributeTable>>("attribute.table");
  const std::vector<std::string> names = table->names();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw FieldError("attribute", fmt::format("nothing in the scene has the attribute '{}'", name),
                     names.empty() ? "say it in the section 'attributes'"
                                   : "there are " + fmt::format("{}", fmt::join(names, ", ")));
  Quantity q;
  q.value = [table, name](const AnalysedPlace& at) -> Value {
    if (!at.object) return std::nullopt;
    const void* thing = identity(before_section(*at.object));
    const auto found = table->of({thing, ElementId::Kind::face, face_before_section(*at.object, at.point.face)}, name);
    return found ? Value(found->value) : std::nullopt;
  };
  return q;
}

Quantity named_quantity(const std::string& name, const Fields& f) {
  if (name == "gaussian_curvature") return of_curvature("", true, [](const SurfaceCurvature& c) { return c.gaussian; });
  if (name == "mean_curvature") return of_curvature("", true, [](const SurfaceCurvature& c) { return c.mean; });
  if (name == "k1") return of_curvature("", true, [](const SurfaceCurvature& c) { return c.principal[0]; });
  if (name == "k2") return of_curvature("", true, [](const SurfaceCurvature& c) { return c.principal[1]; });
  if (name == "largest_curvature")
    return of_curvature("", false, [](const SurfaceCurvature& c) {
      return std::max(std::abs(c.principal[0]), std::abs(c.principal[1]));
    });
  if (name == "normals") {
    Quantity q;
    q.is_direction = true;
    return q;
  }
  if (name == "zebra") return zebra(f.vec3("direction"), f.integer("stripes"));
  if (name == "isophotes") return isophotes(f.vec3("direction"), f.integer("stripes"));
  if (name == "reflection_lines") return reflection_lines(f.axis("lamp"), f.vec3("ceiling"), f.number("spacing"));
  if (name == "distance") {
    if (!f.has("to")) throw FieldError("quantity", "a distance needs the surface 'to' which it is measured");
    return f.holds<CurvePtr>("to") ? distance_to(f.curve("to")) : distance_to(f.surface("to"));
  }
  if (name == "strain") {
    if (!f.has("to") || f.holds<CurvePtr>("to"))
      throw FieldError("quantity", "a strain needs the surface 'to' which this one is laid on",
                       "one of the same parameters, as a development and its surface");
    return strain_to(f.surface("to"));
  }
  if (name == "deviation") {
    if (!f.has("points")) throw FieldError("quantity", "a deviation needs the measured 'points'");
    return deviation_of(f.points("points"));
  }
  if (name == "draft_angle") return draft(f.vec3("direction"));
  return parameter_checker(f.u<int>("cells"), f.v<int>("cells"));
}

// Which fields speak of which quantity.
const std::vector<std::pair<const char*, std::vector<std::string>>> kOnlyOf = {
    {"direction", {"zebra", "isophotes", "draft_angle"}},
    {"stripes", {"zebra", "isophotes"}},
    {"lamp", {"reflection_lines"}},
    {"ceiling", {"reflection_lines"}},
    {"spacing", {"reflection_lines"}},
    {"cells", {"parameters"}},
    {"to", {"distance", "strain"}},
    {"points", {"deviation"}}};

constexpr const char* kStrainText = "of strain: the surface on which this one is laid";
constexpr const char* kFormulaText =
    "any other quantity: of the place x, y, z, the parameters u, v, the curvatures K, H, k1, k2";

}  // namespace

Interval range_of(std::vector<double> values, bool has_sign) {
  if (values.empty()) return has_sign ? Interval(-1, 1) : Interval(0, 1);
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
  };
  double lo = at(kLeftOut), hi = at(1 - kLeftOut);
  if (has_sign) {
    hi = std::max(std::abs(lo), std::abs(hi));
    lo = -hi;
  }
  const double size = std::max(std::abs(lo), std::abs(hi));
  if (!(hi - lo > 1e-6 * size)) {  // one value wherever
    const double half = size > 1e-12 ? 0.1 * size : 1;
    const double middle = 0.5 * (lo + hi);
    lo = middle - half;
    hi = middle + half;
  }
  return {rounded(lo, false), rounded(hi, true)};
}

void add_quantity_of_place(TypeDeclaration& type) {
  type.field("quantity",
             choice({"gaussian_curvature", "mean_curvature", "k1", "k2", "largest_curvature", "draft_angle", "strain"}),
             "as of the integrator `analysis`", "gaussian_curvature")
      .optional("formula", formula(kVariables), kFormulaText)
      .optional("to", reference({Category::surface}), kStrainText)
      .field("direction", direction(), "of draft_angle: pull of a mould", "z");
}

double value_on(const Quantity& quantity, const Surface& surface, double u, double v) {
  SurfacePoint point;
  point.position = surface.point(u, v);
  point.normal = point.geometric_normal = surface.normal(u, v);
  point.u = u;
  point.v = v;
  AnalysedPlace place{point, &surface, nullptr, {}};
  if (quantity.needs_curvature) place.curvature = curvature(surface, u, v);
  return quantity.value(place).value_or(std::numeric_limits<double>::quiet_NaN());
}

Interval range_on(const Quantity& quantity, const std::vector<SurfacePtr>& surfaces) {
  std::vector<double> values;
  for (const SurfacePtr& surface : surfaces) {
    const Rectangle domain = surface->domain();
    for (int i = 0; i < kPlaces; ++i)
      for (int j = 0; j < kPlaces; ++j) {
        const double value = value_on(quantity, *surface, domain.u.lo + domain.u.width() * (i + 0.5) / kPlaces,
                                      domain.v.lo + domain.v.width() * (j + 0.5) / kPlaces);
        if (std::isfinite(value)) values.push_back(value);
      }
  }
  return range_of(std::move(values), false);
}

void add_quantity_fields(TypeDeclaration& type) {
  type.field(
          "quantity",
          choice({"gaussian_curvature", "mean_curvature", "k1", "k2", "largest_curvature", "normals", "draft_angle",
                  "zebra", "isophotes", "reflection_lines", "parameters", "distance", "strain", "deviation"}),
          "k1 >= k2: principal curvatures, signed by the surface's normal, that of a ball seen from outside is "
          "negative; largest_curvature: the larger of |k1|, |k2|; normals: their coordinates as red, green and "
          "blue; draft_angle: of the "
          "tangent plane with `direction`, in degrees; zebra: stripes about `direction`, mirrored; isophotes: "
          "stripes of equal angle between the "
          "normal and `direction`; reflection_lines: parallel lamps, mirrored; parameters: a checker of u and v; "
          "distance: from the surface or curve `to`, of "
          "a surface positive on the side of its normal; strain: of laying the surface on that of the same parameters "
          "`to`, the larger of the principal ones; deviation: of the nearest of `points`, along the normal",
          "gaussian_curvature")
      .optional("formula", formula(kVariables), kFormulaText)
      .optional(
          "attribute", text(),
          "any other quantity: an attribute of elements (section `attributes`), of each face its own or its body's")
      .field("direction", direction(), "of zebra, isophotes, draft_angle: axis of the stripes, light, pull of a mould",
             "z")
      .field("stripes", integer().between(1, 1000), "of zebra and isophotes, from 0 to 180 degrees", "18")
      .field("lamp", axis(), "of reflection_lines: one of the lamps", "{ through: [0, 0, 10], along: x }")
      .field("ceiling", direction(), "of reflection_lines: normal of the plane in which the lamps lie", "z")
      .field("spacing", length().positive(), "of reflection_lines: from one lamp to the next", "1")
      .field("cells", integer().between(1, 10000).for_each_direction(), "of parameters: squares over the domain", "10")
      .optional("to", reference({Category::curve, Category::surface}),
                "of distance and strain: the other surface, or of distance a curve")
      .optional("points", points().count(1), "of deviation: measured points");
}

Quantity quantity_of(const Fields& f) {
  if (f.has("formula") && f.given("quantity"))
    throw FieldError("formula", "a 'formula' is a quantity of its own: leave out 'quantity'");
  if (f.has("attribute") && (f.has("formula") || f.given("quantity")))
    throw FieldError("attribute", "an 'attribute' is a quantity of its own: leave out 'quantity' and 'formula'");
  const std::string name = f.has("attribute") ? f.text("attribute") : f.has("formula") ? "formula" : f.text("quantity");
  for (const auto& [field, quantities] : kOnlyOf)
    if (f.given(field) && std::find(quantities.begin(), quantities.end(), name) == quantities.end()) {
      std::string list;
      for (const std::string& one : quantities) list += (list.empty() ? "" : ", ") + one;
      throw FieldError(field, fmt::format("'{}' is not for the quantity '{}'", field, name),
                       fmt::format("it is for {}", list));
    }
  Quantity result = f.has("attribute") ? of_attribute(f)
                    : f.has("formula") ? of_formula(f.get<Expression>("formula"))
                                       : named_quantity(name, f);
  result.name = name;
  if (result.is_direction) return result;
  // What is not finite, or no float holds, is not known.
  result.value = [value = std::move(result.value)](const AnalysedPlace& at) -> Value {
    const Value found = value(at);
    return found && std::abs(*found) <= std::numeric_limits<float>::max() ? found : std::nullopt;
  };
  return result;
}

}  // namespace lekalo::render
