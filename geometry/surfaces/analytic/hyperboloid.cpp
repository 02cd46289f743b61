// Hyperboloids of one and two sheets (Golovanov 2016, 3.2); |K| = [a b c (x^2/a^4 + y^2/b^4 + z^2/c^4)]^-2.
#include "geometry/surfaces/analytic/hyperboloid.h"

#include "geometry/curves/analytic/conic_forms.h"
#include "geometry/surfaces/analytic/parameter_range.h"

namespace lekalo::geometry {

namespace {
const DomainRules kOneSheetRules{};
const DomainRules kTwoSheetsRules{{Interval::entire(), {0, kInfinity}}, true, false};
}  // namespace

HyperboloidOneSheet::HyperboloidOneSheet(const Frame& frame, const Vec3& semi_axes, const Rectangle& domain)
    : MeridianFormula(frame, semi_axes.x, semi_axes.y, domain), c_(semi_axes.z) {
  if (!(semi_axes.x > 0 && semi_axes.y > 0 && semi_axes.z > 0))
    throw std::invalid_argument("the semi-axes of a hyperboloid must be positive");
  check_domain(domain, kOneSheetRules);
  set_quadric({{1, 1, -1}, 0, -1}, 1.0 / semi_axes);
}

NurbsCurveForm HyperboloidOneSheet::meridian_form() const {
  NurbsCurveForm form = hyperbola_form(domain_.v);
  for (Vec4& p : form.points) p.y *= c_;
  return form;
}

void HyperboloidOneSheet::line_hits(const Line& line, const Interval& t, LineHits& hits) const {
  add_quadric_hits(line, t, hits, [](const Vec3& p) { return std::optional<double>(std::asinh(p.z)); });
}

HyperboloidTwoSheets::HyperboloidTwoSheets(const Frame& frame, const Vec3& semi_axes, const Rectangle& domain)
    : MeridianFormula(frame, semi_axes.x, semi_axes.y, domain), c_(semi_axes.z) {
  if (!(semi_axes.x > 0 && semi_axes.y > 0 && semi_axes.z != 0))
    throw std::invalid_argument("the semi-axes of a hyperboloid must be positive");
  check_domain(domain, kTwoSheetsRules);
  set_quadric({{1, 1, -1}, 0, 1}, 1.0 / semi_axes);
}

NurbsCurveForm HyperboloidTwoSheets::meridian_form() const {
  NurbsCurveForm form = hyperbola_form(domain_.v);
  for (Vec4& p : form.points) p = {p.y, c_ * p.x, 0, p.w};
  return form;
}

void HyperboloidTwoSheets::line_hits(const Line& line, const Interval& t, LineHits& hits) const {
  add_quadric_hits(line, t, hits, [](const Vec3& p) {
    return p.z > 0 ? std::optional<double>(std::asinh(std::hypot(p.x, p.y))) : std::nullopt;
  });
}

TypeDeclaration hyperboloid_one_sheet_type() {
  return declare(Category::surface, "hyperboloid_one_sheet",
                 "Hyperboloid of one sheet about the axis z of its frame, x^2/a^2 + y^2/b^2 - z^2/c^2 = 1; the normal "
                 "points away from the axis. Without heights or a domain it is unbounded.")
      .example("semi_axes: [1, 1, 1], heights: [-1.5, 1.5]")
      .field("frame", frame(), "placement: the center, the axis z, x and y along the semi-axes of the waist", "{}")
      .field("semi_axes", numbers().count(3, 3).positive(), "real semi-axes a, b of the waist, imaginary semi-axis c")
      .optional("heights", range(), "the part between two heights z, which are lengths along the axis")
      .optional("domain", rectangle(), "in place of heights: u the angle in radians, v with z = c sinh v")
      .built_by([](const Fields& f) {
        const Vec3 axes = read_semi_axes(f);
        const Rectangle domain = read_domain(f, HyperboloidOneSheet::kUnbounded, kOneSheetRules);
        return HyperboloidOneSheet(f.frame(), axes,
                                   read_heights(f, domain, [&](double z) { return std::asinh(z / axes.z); }));
      });
}

TypeDeclaration hyperboloid_two_sheets_type() {
  return declare(Category::surface, "hyperboloid_two_sheets",
                 "One sheet of the hyperboloid of two sheets about the axis z of its frame, "
                 "x^2/a^2 + y^2/b^2 - z^2/c^2 = -1. Without heights or a domain it is unbounded.")
      .example("semi_axes: [1, 1, 1], heights: [1, 3]")
      .field("frame", frame(), "placement: the center, the axis z, x and y along the imaginary semi-axes", "{}")
      .field("semi_axes", numbers().count(3, 3).positive(), "imaginary semi-axes a, b, real semi-axis c")
      .field("sheet", choice({"upper", "lower"}),
             "upper: z >= c, the normal on the convex side; lower: z <= -c, the normal on the concave side", "upper")
      .optional("heights", range(), "the part between two distances from the center along the axis, both at least c")
      .optional("domain", rectangle(), "in place of heights: u the angle in radians, v with |z| = c cosh v, v >= 0")
      .built_by([](const Fields& f) {
        Vec3 axes = read_semi_axes(f);
        const Rectangle domain =
            read_heights(f, read_domain(f, HyperboloidTwoSheets::kUnbounded, kTwoSheetsRules), [&](double z) {
              if (!(z >= axes.z)) throw FieldError("heights", "the sheet begins at the height c, above these heights");
              return std::acosh(z / axes.z);
            });
        if (f.text("sheet") == "lower") axes.z = -axes.z;
        return HyperboloidTwoSheets(f.frame(), axes, domain);
      });
}

}  // namespace lekalo::geometry
