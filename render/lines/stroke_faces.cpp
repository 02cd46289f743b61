// Parameter lines and creases of surfaces, and of bodies' faces as far as these go.
#include <algorithm>
#include <cmath>

#include "geometry/curves/segment.h"
#include "geometry/curves/surface_curve.h"
#include "geometry/queries/creases.h"
#include "geometry/queries/curve_intersections.h"
#include "geometry/queries/trim.h"
#include "render/lines/stroke_collector.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Parts of a line that are shorter, of all of it, are none.
constexpr double kLeastPart = 1e-9;

// A whole number of periods that brings x into the range; 0 where none does.
double shift_into(const Interval& range, double x, double period) {
  if (!(period > 0)) return 0;
  const double shift = period * std::ceil((range.lo - x) / period - kLeastPart);
  return x + shift <= range.hi + kLeastPart * period ? shift : 0;
}

}  // namespace

void StrokeCollector::add_crease(const SurfacePtr& surface, const Crease& crease, const Interval& along,
                                 const Style& style, const HiddenLines& hidden) {
  // So far beside a crease its sides are asked for derivatives, of the domain: bounds on it hold those of both.
  constexpr double kAside = 1e-13;
  const Interval range = crease.held == HeldParameter::u ? surface->domain().u : surface->domain().v;
  const double aside = kAside * range.width();
  lies_on_line(surface, crease.held, crease.at + aside, along);
  lies_on_line(surface, crease.held, (crease.seam ? range.hi : crease.at) - aside, along);
  stroke(std::make_shared<ParameterLine>(surface, crease.held, crease.at, along), style, hidden);
}

void StrokeCollector::each_line_of_face(const FaceRegion& face, HeldParameter held, double at,
                                        const std::function<void(double at, const Interval& along)>& visit) {
  const bool u = held == HeldParameter::u;
  const Rectangle domain = face.surface->domain();
  const Periods periods = face.surface->periods();
  const Interval &range = u ? domain.u : domain.v, &whole = u ? domain.v : domain.u;
  const Interval along = u ? face.region->v_range() : face.region->u_range();
  const double period = u ? periods.v : periods.u;
  const auto place = [&](double t) { return u ? Vec3(at, t, 0) : Vec3(t, at, 0); };
  const Segment line(place(along.lo), place(along.hi));
  std::vector<double> cuts{along.lo, along.hi};
  for (const Curve2Ptr& border : face.borders)
    for (const CurveMeeting& meeting : intersect(line, *border).points)
      cuts.push_back(along.lo + meeting.s * along.width());
  // Loops may go over the seam, where the surface's own lines end.
  if (period > 0)
    for (double seam = whole.lo + period * std::ceil((along.lo - whole.lo) / period); seam < along.hi; seam += period)
      cuts.push_back(seam);
  std::sort(cuts.begin(), cuts.end());
  const double own_at = range.clamp(at + shift_into(range, at, u ? periods.u : periods.v));
  for (size_t k = 0; k + 1 < cuts.size(); ++k) {
    const Interval t{cuts[k], cuts[k + 1]};
    const Vec3 middle = place(t.middle());
    if (t.width() <= kLeastPart * along.width() || !face.region->contains(middle.x, middle.y)) continue;
    const double shift = shift_into(whole, t.middle(), period);
    visit(own_at, {whole.clamp(t.lo + shift), whole.clamp(t.hi + shift)});
  }
}

std::vector<StrokeCollector::FaceRegion> StrokeCollector::trimmed_faces(const Body& body) {
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

void StrokeCollector::add_parameter_lines(const Body& body, const Lines& lines, const Style& style) {
  for (const FaceRegion& face : trimmed_faces(body))
    for (const HeldParameter held : {HeldParameter::u, HeldParameter::v}) {
      const bool u = held == HeldParameter::u;
      ParameterValues asked = u ? lines.at_u : lines.at_v;
      if (!face.region) {
        add_parameter_lines(face.surface, held, asked, style, lines.hidden);
        continue;
      }
      const Interval range = u ? face.region->u_range() : face.region->v_range();
      const double period = u ? face.surface->periods().u : face.surface->periods().v;
      for (double& value : asked.values) value += shift_into(range, value, period);
      for (const double at : values_in(asked, range, false))
        each_line_of_face(face, held, at, [&](double own_at, const Interval& along) {
          lies_on_line(face.surface, held, own_at, along);
          stroke(std::make_shared<ParameterLine>(face.surface, held, own_at, along), style, lines.hidden);
        });
    }
}

void StrokeCollector::add_creases(const SurfacePtr& surface, const Style& style, const HiddenLines& hidden) {
  for (const Crease& crease : creases(*surface)) add_crease(surface, crease, crease.along, style, hidden);
  const std::vector<SmoothPart>& parts = smooth_parts_of(surface);
  const FreeCreases found = free_creases(parts);
  if (!found.complete) is_incomplete();
  for (const FreeCrease& crease : found.lines) {
    const SurfacePtr& on = parts[static_cast<size_t>(crease.parts[0])].surface;
    if (drawing_)
      for (const int part : crease.parts) hosts_.push_back({parts[static_cast<size_t>(part)].surface, crease.image});
    stroke(std::make_shared<SurfaceCurve>(on, crease.image), style, hidden);
  }
}

void StrokeCollector::add_creases(const Body& body, const Style& style, const HiddenLines& hidden) {
  for (const FaceRegion& face : trimmed_faces(body)) {
    if (!face.region) {
      add_creases(face.surface, style, hidden);
      continue;
    }
    for (const Crease& crease : creases(*face.surface)) {
      const bool u = crease.held == HeldParameter::u;
      const Interval range = u ? face.region->u_range() : face.region->v_range();
      const double at =
          crease.at + shift_into(range, crease.at, u ? face.surface->periods().u : face.surface->periods().v);
      each_line_of_face(face, crease.held, at, [&](double, const Interval& along) {
        const Interval both = intersect(along, crease.along);
        if (both.width() > kLeastPart * along.width()) add_crease(face.surface, crease, both, style, hidden);
      });
    }
  }
}

}  // namespace lekalo::render
