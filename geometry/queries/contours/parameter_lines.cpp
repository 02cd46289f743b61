#include "geometry/queries/contours/parameter_lines.h"

#include <algorithm>
#include <cmath>

#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/queries/intersections/curve_intersections.h"

namespace lekalo::geometry {

namespace {

// Parts of a line that are shorter, of all of it, are none.
constexpr double kMinPart = 1e-9;

Vec3 place(IsoDirection held, double at, double t) { return held == IsoDirection::u ? Vec3(at, t, 0) : Vec3(t, at, 0); }

// What of a region's range is seen once: beside a slanted seam regions are wider than a period.
Interval one_period(const Interval& range, double period) {
  return {range.lo, period > 0 ? std::min(range.hi, range.lo + period) : range.hi};
}

}  // namespace

std::vector<double> values_in(const ParameterValues& asked, const Interval& range, bool periodic) {
  std::vector<double> values;
  if (asked.count == 1 && !periodic) return {range.middle()};
  for (int i = 0; i < asked.count; ++i)
    values.push_back(range.clamp(range.lo + range.width() * i / (periodic ? asked.count : asked.count - 1)));
  for (const double value : asked.values)
    if (const double at = range.clamp(value); std::abs(at - value) <= kMinPart * range.width()) values.push_back(at);
  return values;
}

bool is_closed_in(const Surface& surface, IsoDirection held) {
  const Rectangle domain = surface.domain();
  const bool u = held == IsoDirection::u;
  if (const double period = u ? surface.periods().u : surface.periods().v; period > 0)
    return std::abs((u ? domain.u : domain.v).width() - period) <= 1e-9 * period;
  const Interval &range = u ? domain.u : domain.v, &along = u ? domain.v : domain.u;
  const auto at = [&](double held_at, double x) {
    const double t = along.clamp(along.lo + x * along.width());
    return u ? surface.point(held_at, t) : surface.point(t, held_at);
  };
  const double same = 1e-9 * bounds(surface).diameter();
  bool meets = true, meets_turned = true;
  for (const double x : {0.0, 0.25, 0.55, 0.8, 1.0}) {
    const Vec3 first = at(range.lo, x);
    meets = meets && glm::length(first - at(range.hi, x)) <= same;
    meets_turned = meets_turned && glm::length(first - at(range.hi, 1 - x)) <= same;
  }
  return meets || meets_turned;
}

Curve2Ptr NetLine::image() const {
  NurbsCurveForm form;
  form.degree = 1;
  form.knots = {along.lo, along.lo, along.hi, along.hi};
  form.points = {Vec4(place(held, at, along.lo), 1), Vec4(place(held, at, along.hi), 1)};
  return std::make_shared<NurbsCurve>(form);
}

NetLine whole_line(const SurfacePtr& surface, IsoDirection held, double at) {
  return {surface, held, at, held == IsoDirection::u ? surface->domain().v : surface->domain().u};
}

std::vector<NetLine> parameter_lines(const SurfacePtr& surface, const ParameterNet& net) {
  std::vector<NetLine> lines;
  if (!surface->bounded()) return lines;
  const Rectangle domain = surface->domain();
  const DegenerateEdges edges = surface->degenerate_edges();
  for (const IsoDirection held : {IsoDirection::u, IsoDirection::v}) {
    const bool u = held == IsoDirection::u;
    const Interval& range = u ? domain.u : domain.v;
    ParameterValues asked = u ? net.u : net.v;
    for (double& value : asked.values)
      value += shift_into(range, value, u ? surface->periods().u : surface->periods().v);
    for (const double at : values_in(asked, range, asked.count > 1 && is_closed_in(*surface, held))) {
      const bool is_point =
          (at == range.lo && (u ? edges.u_min : edges.v_min)) || (at == range.hi && (u ? edges.u_max : edges.v_max));
      if (!is_point) lines.push_back(whole_line(surface, held, at));
    }
  }
  return lines;
}

std::vector<NetLine> parameter_lines(const Body& body, const ParameterNet& net) {
  std::vector<NetLine> lines;
  const auto add = [&](const NetLine& line) { lines.push_back(line); };
  for (const FaceRegion& face : face_regions(body)) {
    if (!face.region) {
      for (const NetLine& line : parameter_lines(face.surface, net)) add(line);
      continue;
    }
    for (const IsoDirection held : {IsoDirection::u, IsoDirection::v}) {
      const bool u = held == IsoDirection::u;
      ParameterValues asked = u ? net.u : net.v;
      const double period = u ? face.surface->periods().u : face.surface->periods().v;
      const Interval range = one_period(u ? face.region->u_range() : face.region->v_range(), period);
      for (double& value : asked.values) value += shift_into(range, value, period);
      for (const double at : values_in(asked, range, false)) each_line_of_face(face, held, at, add);
    }
  }
  return lines;
}

std::vector<FaceRegion> face_regions(const Body& body) {
  std::vector<FaceRegion> faces;
  for (size_t index = 0; index < body.faces.size(); ++index) {
    const Face& face = body.faces[index];
    FaceRegion region{face.surface, trim_of(body, static_cast<int>(index)), {}};
    for (const int loop : face.loops)
      for (const int coedge : body.loops[loop].coedges) region.borders.push_back(body.coedges[coedge].image);
    faces.push_back(std::move(region));
  }
  return faces;
}

void each_line_of_face(const FaceRegion& face, IsoDirection held, double at,
                       const std::function<void(const NetLine& line)>& visit) {
  const bool u = held == IsoDirection::u;
  const Rectangle domain = face.surface->domain();
  const Periods periods = face.surface->periods();
  const Interval &range = u ? domain.u : domain.v, &whole = u ? domain.v : domain.u;
  const double period = u ? periods.v : periods.u, held_period = u ? periods.u : periods.v;
  // The line is drawn along one period, and cut there by whatever cuts any of its copies.
  const Interval reach = u ? face.region->v_range() : face.region->u_range(),
                 room = u ? face.region->u_range() : face.region->v_range();
  const Interval along = one_period(reach, period);
  std::vector<double> copies{at};
  const auto is_in_room = [&](double x) { return x < room.hi - kMinPart * room.width(); };
  if (held_period > 0)
    for (double x = at + shift_into(room, at, held_period) + held_period; is_in_room(x); x += held_period)
      copies.push_back(x);
  std::vector<double> cuts{along.lo, along.hi};
  const auto cut_at = [&](double s) {
    const double cut = reach.lo + s * reach.width();
    cuts.push_back(cut > along.hi ? cut - period * std::ceil((cut - along.hi) / period) : cut);
  };
  for (const double copy : copies) {
    const Segment line(place(held, copy, reach.lo), place(held, copy, reach.hi));
    for (const Curve2Ptr& border : face.borders) {
      const CurveIntersections intersections = intersect(line, *border);
      for (const CurveIntersection& intersection : intersections.points) cut_at(intersection.s);
      // Where a border runs along the line.
      for (const CommonPart& part : intersections.common) cut_at(part.s.lo), cut_at(part.s.hi);
    }
  }
  // Loops may go over the seam, where the surface's own lines end.
  if (period > 0)
    for (double seam = whole.lo + period * std::ceil((along.lo - whole.lo) / period); seam < along.hi; seam += period)
      cuts.push_back(seam);
  std::sort(cuts.begin(), cuts.end());
  const double own_at = range.clamp(at + shift_into(range, at, held_period));
  for (size_t k = 0; k + 1 < cuts.size(); ++k) {
    const Interval t{cuts[k], cuts[k + 1]};
    const Vec3 middle = place(held, at, t.middle());
    if (t.width() <= kMinPart * along.width() || !face.region->contains(middle.x, middle.y)) continue;
    const double shift = shift_into(whole, t.middle(), period);
    visit({face.surface, held, own_at, {whole.clamp(t.lo + shift), whole.clamp(t.hi + shift)}});
  }
}

double shift_into(const Interval& range, double x, double period) {
  if (!(period > 0)) return 0;
  const double shift = period * std::ceil((range.lo - x) / period - kMinPart);
  return x + shift <= range.hi + kMinPart * period ? shift : 0;
}

}  // namespace lekalo::geometry
