#include "geometry/machining/rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/analytic/segment.h"
#include "geometry/queries/contours/plane_section.h"

namespace lekalo::geometry {

namespace {

constexpr int kPlaces = 64;   // along a row
constexpr int kGrid = 32;     // of a surface, for how far planes reach
constexpr int kSettling = 8;  // of the distance to a row whose strip is narrower
constexpr int kMaxRows = 10000;

template <class See>
void along(const SurfaceContact& contact, const See& see) {
  const Interval range = contact.line.image->domain();
  for (int i = 0; i <= kPlaces; ++i) {
    const double t = range.clamp(range.lo + range.width() * i / kPlaces);
    see(t, contact_bend(contact, t));
  }
}

Interval reach_along(const Surface& surface, const Vec3& origin, const Vec3& normal) {
  const Rectangle d = surface.domain();
  Interval reach(kInfinity, -kInfinity);
  for (int i = 0; i <= kGrid; ++i)
    for (int j = 0; j <= kGrid; ++j) {
      const Vec3 p = surface.point(d.u.lo + d.u.width() * i / kGrid, d.v.lo + d.v.width() * j / kGrid);
      reach = hull(reach, Interval(glm::dot(p - origin, normal)));
    }
  return reach;
}

void check_count(double count, const char* field) {
  if (!(count <= kMaxRows))
    throw FieldError(field, fmt::format("that makes {:.3g} rows, more than {}", count, kMaxRows), "a larger one");
}

// At both ends, or in the middles of as many parts.
std::vector<double> even_places(const RowFamily& family, int count) {
  const Interval range = family.range();
  std::vector<double> places;
  const bool ends = family.has_rows_at_ends() && !family.is_closed() && count > 1;
  for (int k = 0; k < count; ++k)
    places.push_back(range.lo + range.width() * (ends                 ? static_cast<double>(k) / (count - 1)
                                                 : family.is_closed() ? static_cast<double>(k) / count
                                                                      : (k + 0.5) / count));
  return places;
}

double step_at(const RowFamily& family, double place, double height) {
  double step = kInfinity;
  for (const PathRow& row : family.at(place)) step = std::min(step, family.step(row, height));
  if (!(step > 0))
    throw FieldError("scallop", fmt::format("the cutter leaves no strip beside the row at {:.6g}", place),
                     "a cutter with a round corner, one that does not cut into the part, or 'spacing'");
  return step;
}

// Each as far from the one before as the narrower of both strips.
std::vector<double> places_by_height(const RowFamily& family, double height) {
  const Interval range = family.range();
  std::vector<double> places;
  double at = range.lo;
  if (!family.has_rows_at_ends()) {
    // The first plane cuts near the border, where the surface only begins.
    const double inside = range.lo + 1e-3 * range.width();
    at = std::min(inside + 0.5 * step_at(family, inside, height), range.middle());
  }
  while (true) {
    places.push_back(at);
    check_count(static_cast<double>(places.size()), "scallop");
    double step = step_at(family, at, height);
    for (int k = 0; k < kSettling; ++k) {
      const double next = step_at(family, std::min(at + step, next_down(range.hi)), height);
      if (next >= step) break;
      step = next;
    }
    if (family.has_rows_at_ends() ? at + step >= range.hi : at + 0.5 * step >= range.hi) break;
    at += step;
    if (!family.has_rows_at_ends() && at >= range.hi) break;
  }
  if (!family.has_rows_at_ends() || family.is_closed()) return places;
  // The row before the last, where it is very near to that, goes to the middle between its neighbours.
  const size_t n = places.size();
  if (n > 1 && range.hi - places[n - 1] < 0.5 * (places[n - 1] - places[n - 2]))
    places[n - 1] = 0.5 * (places[n - 2] + range.hi);
  places.push_back(range.hi);
  return places;
}

}  // namespace

RowFamily RowFamily::of_parameter(const SurfaceContact& base, bool along_u, const Rectangle& part) {
  RowFamily family(base);
  family.part_ = part;
  family.along_u_ = along_u;
  family.range_ = along_u ? part.v : part.u;
  const Periods periods = base.line.of->periods();
  const double period = along_u ? periods.v : periods.u;
  family.is_closed_ = period > 0 && std::abs(period - family.range_.width()) <= 1e-12 * period;
  return family;
}

RowFamily RowFamily::of_planes(const SurfaceContact& base, const Vec3& origin, const Vec3& normal) {
  RowFamily family(base);
  family.normal_ = normal;
  family.origin_ = origin;
  family.range_ = reach_along(*base.line.of, origin, normal);
  return family;
}

std::vector<PathRow> RowFamily::at(double place) const {
  PathRow row{base_, place};
  if (!normal_) {
    const Vec3 from = along_u_ ? Vec3(part_.u.lo, place, 0) : Vec3(place, part_.v.lo, 0);
    const Vec3 to = along_u_ ? Vec3(part_.u.hi, place, 0) : Vec3(place, part_.v.hi, 0);
    row.contact.line.image = std::make_shared<Segment>(from, to);
    return {row};
  }
  std::vector<PathRow> rows;
  for (const Contour& branch : plane_section(base_.line.of, origin_ + place * *normal_, *normal_).branches) {
    if (branch.kind != ContourKind::crossing) continue;
    row.contact.line.image = branch.images.front();
    rows.push_back(row);
  }
  return rows;
}

double RowFamily::rate(const PathRow& row, double t, const ContactBend& bend) const {
  if (!normal_) return std::abs(along_u_ ? bend.across.y : bend.across.x);
  const CutterPlace<double> place = row.contact.at(t);
  return std::abs(dot(cross(place.normal, place.feed), triple(*normal_)));
}

double RowFamily::step(const PathRow& row, double height) const {
  double least = kInfinity;
  along(row.contact, [&](double t, const ContactBend& bend) {
    const double change = rate(row, t, bend);
    if (change > 0) least = std::min(least, bend.width(height) * change);
  });
  return least;
}

double RowFamily::scallop(const PathRow& row, double distance) const {
  double greatest = 0;
  along(row.contact, [&](double t, const ContactBend& bend) {
    const double change = rate(row, t, bend);
    if (change > 0) greatest = std::max(greatest, bend.height(distance / change));
  });
  return greatest;
}

std::vector<double> row_places(const RowFamily& family, const RowSpacing& spacing) {
  if (spacing.height) return places_by_height(family, *spacing.height);
  if (spacing.count) return even_places(family, *spacing.count);
  const double parts = std::ceil(family.range().width() / *spacing.distance * (1 - 1e-12));
  check_count(parts, "spacing");
  const bool both_ends = family.has_rows_at_ends() && !family.is_closed();
  return even_places(family, std::max(1, static_cast<int>(parts)) + (both_ends ? 1 : 0));
}

}  // namespace lekalo::geometry
