#include "geometry/curves/operations/parameter_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

ParameterLine::ParameterLine(SurfacePtr surface, IsoDirection held, double at, std::optional<Interval> range)
    : surface_(std::move(surface)), held_(held), at_(at) {
  const Rectangle domain = surface_->domain();
  domain_ = holds_u() ? domain.v : domain.u;
  if (range) {
    if (!domain_.contains(*range)) throw std::invalid_argument("the range lies outside of the surface's domain");
    domain_ = *range;
  }
  if (!(domain_.width() < kInfinity)) throw std::invalid_argument("a parameter line of an unbounded surface");
  if (!(holds_u() ? domain.u : domain.v).contains(at))
    throw std::invalid_argument("the parameter lies outside of the surface's domain");
}

double ParameterLine::period() const { return holds_u() ? surface_->periods().v : surface_->periods().u; }

CurveJet ParameterLine::evaluate(double t, int order) const {
  if (order > kMaxSurfaceOrder) throw std::invalid_argument("derivatives beyond the fourth of a parameter line");
  const SurfaceJet at = holds_u() ? surface_->evaluate(at_, t, order) : surface_->evaluate(t, at_, order);
  CurveJet jet;
  jet.order = order;
  for (int k = 0; k <= order; ++k) jet.d[k] = holds_u() ? at.d(0, k) : at.d(k, 0);
  return jet;
}

CurveEnclosure ParameterLine::enclose(const Interval& t, int order) const {
  const SurfaceEnclosure over = surface_->enclose(holds_u() ? Rectangle{at_, t} : Rectangle{t, at_}, order);
  CurveEnclosure boxes;
  for (int k = 0; k <= order; ++k) boxes.d[k] = holds_u() ? over.d(0, k) : over.d(k, 0);
  return boxes;
}

// Smooth where the surface is: between the borders of its pieces along the line.
std::vector<CurvePiece> ParameterLine::pieces() const {
  std::vector<double> ends{domain_.lo, domain_.hi};
  for (const SurfacePiece& piece : surface_->pieces()) {
    const Interval& across = holds_u() ? piece.domain.u : piece.domain.v;
    const Interval& along = holds_u() ? piece.domain.v : piece.domain.u;
    if (!across.contains(at_)) continue;
    ends.push_back(domain_.clamp(along.lo));
    ends.push_back(domain_.clamp(along.hi));
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<CurvePiece> pieces;
  for (size_t i = 0; i + 1 < ends.size(); ++i) {
    CurvePiece piece;
    piece.domain = {ends[i], ends[i + 1]};
    piece.map = {ParameterMap::Kind::affine, ends[i], ends[i + 1]};
    pieces.push_back(piece);
  }
  return pieces;
}

// The surface's points across the line, summed where it lies.
std::optional<NurbsCurveForm> ParameterLine::form() const {
  const auto of = surface_->as_nurbs();
  if (!of) return std::nullopt;
  const int degree = holds_u() ? of->degree_u : of->degree_v;
  const std::vector<double>& knots = holds_u() ? of->knots_u : of->knots_v;
  double at = at_;
  for (const ParameterMap& map : holds_u() ? of->maps_u : of->maps_v)
    if (at_ > map.lo && at_ < map.hi) at = map.rational(at_);
  const int span = find_span(degree, knots, at);
  const SpanBasis basis = span_basis(degree, knots, span, at, 0);
  NurbsCurveForm line{holds_u() ? of->degree_v : of->degree_u,
                      holds_u() ? of->knots_v : of->knots_u,
                      {},
                      holds_u() ? of->maps_v : of->maps_u};
  for (int i = 0; i < (holds_u() ? of->count_v() : of->count_u()); ++i) {
    Vec4 sum(0);
    for (int m = 0; m <= degree; ++m) {
      const int across = span - degree + m;
      sum += basis.values[0][m] * of->points[holds_u() ? across * of->count_v() + i : i * of->count_v() + across];
    }
    line.points.push_back(sum);
  }
  return line;
}

TypeDeclaration parameter_line_type() {
  return declare(Category::curve, "parameter_line",
                 "Line of a surface along which u or v is held. Its parameter is the other one.")
      .example("of: { type: sphere_surface, radius: 2 }, u: 0.5")
      .field("of", reference({Category::surface}), "the surface")
      .optional("u", number(), "where u is held; the line's parameter is v")
      .optional("v", number(), "where v is held; the line's parameter is u")
      .optional("range", range(), "of the line's parameter; the surface's domain if it is left out")
      .built_by([](const Fields& f) {
        if (f.has("u") == f.has("v"))
          throw FieldError(f.has("u") ? "v" : "of", "a parameter line holds one of u and v", "give either 'u' or 'v'");
        const IsoDirection held = f.has("u") ? IsoDirection::u : IsoDirection::v;
        const char* field = f.has("u") ? "u" : "v";
        const SurfacePtr surface = f.surface("of");
        const Rectangle domain = surface->domain();
        const Interval &across = f.has("u") ? domain.u : domain.v, &along = f.has("u") ? domain.v : domain.u;
        if (!across.contains(f.number(field)))
          throw FieldError(field, fmt::format("the surface has {} in [{:.6g}, {:.6g}]", field, across.lo, across.hi));
        if (!f.has("range")) {
          if (!(along.width() < kInfinity))
            throw FieldError("of", "the surface is unbounded along this line", "give the line a range");
          return ParameterLine(surface, held, f.number(field));
        }
        if (!along.contains(f.range("range")))
          throw FieldError("range", fmt::format("the surface's domain is [{:.6g}, {:.6g}]", along.lo, along.hi));
        return ParameterLine(surface, held, f.number(field), f.range("range"));
      });
}

}  // namespace lekalo::geometry
