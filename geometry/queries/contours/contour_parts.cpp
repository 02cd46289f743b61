#include "geometry/queries/contours/contour_parts.h"

#include <algorithm>

#include "geometry/curves/operations/curve_part.h"
#include "geometry/curves/operations/curve_sign_changes.h"
#include "geometry/queries/contours/contour_approximation.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

static Contour part_of(const Contour& whole, const Interval& t) {
  Contour part = whole;
  if (t == whole.curve->domain()) return part;
  part.closed = false;
  part.curve = std::make_shared<CurvePart>(whole.curve, t);
  for (Curve2Ptr& image : part.images) image = std::make_shared<CurvePart>(image, t);
  std::erase_if(part.cusps, [&](double cusp) { return !t.contains(cusp); });
  return part;
}

void add_kept(const Contour& whole, const Curve& where, const std::vector<ImplicitSide>& sides,
              std::vector<Contour>& kept) {
  if (sides.empty()) return kept.push_back(whole);
  each_kept(where, false, sides, [&](const Interval& t) { kept.push_back(part_of(whole, t)); });
}

void add_inside(const Contour& whole, const Curve& where, const Rectangle& domain, std::vector<Contour>& kept) {
  std::vector<double> cuts;
  for (const int axis : {0, 1})
    for (const double side : {axis == 0 ? domain.u.lo : domain.v.lo, axis == 0 ? domain.u.hi : domain.v.hi}) {
      const std::vector<double> found = sign_changes(
          where, false, [&](const Box3& box) { return Interval(box.lo[axis], box.hi[axis]) - side; },
          [&](const Vec3& p) { return p[axis] - side; });
      cuts.insert(cuts.end(), found.begin(), found.end());
    }
  std::sort(cuts.begin(), cuts.end());
  const auto keeps = [&](double t) { return domain.contains(where.point(t).x, where.point(t).y); };
  each_kept(where.domain(), false, cuts, keeps, [&](const Interval& t) { kept.push_back(part_of(whole, t)); });
}

// Whether two lines are one, as those in which two parts meet are found twice.
static bool are_one(const Contour& a, const Contour& b, double tolerance) {
  const Interval s = a.curve->domain(), t = b.curve->domain();
  for (const bool turned : {false, true}) {
    bool same = true;
    for (const double share : {0.0, 0.31, 1.0})
      same = same && glm::length(a.curve->point(s.lo + share * s.width()) -
                                 b.curve->point(t.lo + (turned ? 1 - share : share) * t.width())) <= tolerance;
    if (same) return true;
  }
  return false;
}

Contours of_parts(const SurfacePtr& surface, size_t image, const std::function<Contours(const SurfacePtr&)>& search) {
  const std::vector<SmoothPart> parts = smooth_parts(surface);
  if (parts.size() == 1) {
    Contours whole = search(surface);
    whole.complete = whole.complete && parts_between_steps(surface).known;
    return whole;
  }
  Contours all;
  const double tolerance = kSamePoint * bounds(*surface).diameter();
  for (const SmoothPart& part : parts) {
    Contours found = search(part.surface);
    all.coincident = all.coincident || found.coincident;
    all.complete = all.complete && found.complete;
    for (ContourPoint& point : found.points)
      if (is_in(part, point.parameters[2 * image], point.parameters[2 * image + 1]))
        all.points.push_back(std::move(point));
    std::vector<Contour> kept;
    for (const Contour& contour : found.branches) {
      const CurvePtr simple = contour_approximation(contour.curve, *part.surface, contour.images[image]);
      add_kept(contour, *simple, part.sides, kept);
    }
    const auto before = static_cast<std::ptrdiff_t>(all.branches.size());
    for (Contour& one : kept)
      if (std::none_of(all.branches.begin(), all.branches.begin() + before,
                       [&](const Contour& other) { return are_one(one, other, tolerance); }))
        all.branches.push_back(std::move(one));
  }
  return all;
}

}  // namespace lekalo::geometry
