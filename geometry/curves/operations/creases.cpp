#include "geometry/curves/operations/creases.h"

#include <algorithm>
#include <cmath>

namespace lekalo::geometry {

namespace {

// How far beside a line the normals of its sides are taken, of the pieces there: they have hardly turned. Not nearer
// than some roundings of the parameter.
constexpr double kBeside = 1e-9, kRoundings = 1e-15;
// Where a piece's border is asked, of its length: a crease may fade towards its ends.
constexpr double kPlaces[] = {0.05, 0.23, 0.5, 0.81, 0.97};
// Opposite edges of a domain are one line where they are this near, of the surface's size.
constexpr double kSameLine = 1e-9;

// A surface asked by a held parameter and the one along the line.
struct Held {
  const Surface& surface;
  IsoDirection held;

  Vec3 point(double at, double t) const {
    return held == IsoDirection::u ? surface.point(at, t) : surface.point(t, at);
  }
  // A unit vector across the line, in the surface, to the side of growing `at`.
  Vec3 across(double at, double t) const {
    const double u = held == IsoDirection::u ? at : t, v = held == IsoDirection::u ? t : at;
    const SurfaceJet s = surface.evaluate(u, v, 1);
    const Vec3 normal = surface.normal_sign() * surface.normal(u, v, s);
    const Vec3 across = held == IsoDirection::u ? glm::cross(s.dv(), normal) : glm::cross(normal, s.du());
    const double length = glm::length(across);
    return length > 0 ? across / length : Vec3(0);
  }
};

std::vector<double> borders(const std::vector<SurfacePiece>& pieces, IsoDirection held) {
  std::vector<double> at;
  for (const SurfacePiece& piece : pieces) {
    const Interval& range = held == IsoDirection::u ? piece.domain.u : piece.domain.v;
    at.push_back(range.lo), at.push_back(range.hi);
  }
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  return at;
}

// How the lines at the ends of the domain are one line of space.
enum class Seam { none, straight, turned };
Seam seam_of(const Held& sides, const Interval& range, const Interval& along, double same) {
  bool meets = true, meets_turned = true;
  for (const double share : {0.0, 0.25, 0.55, 0.8, 1.0}) {
    const double t = along.clamp(along.lo + share * along.width()),
                 turned = along.clamp(along.hi - share * along.width());
    const Vec3 first = sides.point(range.lo, t);
    meets = meets && glm::length(first - sides.point(range.hi, t)) <= same;
    meets_turned = meets_turned && glm::length(first - sides.point(range.hi, turned)) <= same;
  }
  return meets ? Seam::straight : meets_turned ? Seam::turned : Seam::none;
}

}  // namespace

std::vector<Crease> creases(const Surface& surface, double angle) {
  std::vector<Crease> found;
  if (!surface.bounded()) return found;
  const std::vector<SurfacePiece> pieces = surface.pieces();
  const double same = kSameLine * bounds(surface).diameter();
  for (const IsoDirection held : {IsoDirection::u, IsoDirection::v}) {
    const bool u = held == IsoDirection::u;
    const Held sides{surface, held};
    const Interval range = u ? surface.domain().u : surface.domain().v,
                   along = u ? surface.domain().v : surface.domain().u;
    const std::vector<double> lines = borders(pieces, held),
                              stops = borders(pieces, u ? IsoDirection::v : IsoDirection::u);
    const auto beside = [&](double width) { return std::max(kBeside * width, kRoundings * magnitude(range)); };
    const auto add = [&](double before, double behind, double at, Seam seam) {
      bool goes_on = false;
      for (size_t k = 0; k + 1 < stops.size(); ++k) {
        const Interval part{stops[k], stops[k + 1]};
        const bool collapsed = std::all_of(std::begin(kPlaces), std::end(kPlaces), [&](double share) {
          return glm::length(sides.point(at, part.lo + share * part.width()) - sides.point(at, part.lo)) <= same;
        });
        const bool folds = !collapsed && std::any_of(std::begin(kPlaces), std::end(kPlaces), [&](double share) {
          const double t = part.lo + share * part.width();
          const double other = seam == Seam::turned ? along.hi - (t - along.lo) : t;
          return glm::length(sides.across(before, other) - sides.across(behind, t)) > angle;
        });
        if (folds && goes_on)
          found.back().along.hi = part.hi;
        else if (folds)
          found.push_back({held, at, part, seam != Seam::none});
        goes_on = folds;
      }
    };
    for (size_t k = 1; k + 1 < lines.size(); ++k)
      add(lines[k] - beside(lines[k] - lines[k - 1]), lines[k] + beside(lines[k + 1] - lines[k]), lines[k], Seam::none);
    if (const Seam seam = seam_of(sides, range, along, same); seam != Seam::none)
      add(range.hi - beside(range.hi - lines[lines.size() - 2]), range.lo + beside(lines[1] - range.lo), range.lo,
          seam);
  }
  return found;
}

}  // namespace lekalo::geometry
