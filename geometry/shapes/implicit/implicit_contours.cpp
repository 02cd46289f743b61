#include "geometry/shapes/implicit/implicit_contours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/operations/creases.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/curves/operations/curve_sign_changes.h"
#include "geometry/curves/splines/polynomial_approximation.h"
#include "geometry/queries/contours/silhouette_crossings.h"
#include "geometry/queries/implicit_curves/implicit_arcs.h"
#include "geometry/shapes/tube/ball_outlines.h"
#include "geometry/shapes/tube/balls.h"

namespace lekalo::geometry {

namespace {

constexpr double kAgreeAside = 1e-4;
// Around a ball curves are searched in a box larger by this part of its diameter: the ball only touches its own box.
constexpr double kAroundBall = 1.0 / 64;
constexpr double kMinPart = 1e-9;  // of a curve's domain
// So far beside a crease, of the region's diameter, the branch on its other side is looked for; and where its value is
// as far from zero the surface jumps.
constexpr double kBeside = 1e-6, kNoJump = 1e-9;

bool is_way(const Vec3& v) { return glm::length(v) > 0 && glm::length(v) < kInfinity; }

void require(bool fine, const char* what) {
  if (!fine) throw std::invalid_argument(what);
}
void require(const ViewOf& view) {
  const Vec3& v = view.direction_or_eye;
  require(view.central ? glm::length(v) < kInfinity : is_way(v), "the view must be finite, its direction of a length");
}

class Collector {
 public:
  Collector(const ImplicitSurface& surface, const ViewOf& view)
      : surface_(surface),
        formula_(surface.formula()),
        region_(surface.region()),
        view_(view),
        sight_(ImplicitCondition::sight(view)) {}

  ImplicitContours silhouette() {
    const ImplicitArcs found = implicit_arcs(formula_, region_, sight_, search_box());
    note(found);
    for (const ImplicitArc& arc : found.arcs) {
      // A stretch of a closed line may go on beyond its end, which is next to no singular point.
      const Interval regular{arc.regular.lo, arc.closed ? kInfinity : arc.regular.hi};
      each_inside(arc, [&](const CurvePtr& curve, bool closed) { add_silhouette(arc, curve, closed, regular); });
    }
    if (region_.is_ball && surface_.is_closed()) add_outline_of_ball();
    return std::move(result_);
  }

  ImplicitContours border() {
    if (region_.is_ball) {
      const ImplicitCondition sphere = ImplicitCondition::sphere(region_.box.center(), region_.radius());
      const ImplicitArcs found = implicit_arcs(formula_, region_, sphere, search_box());
      note(found);
      for (const ImplicitArc& arc : found.arcs) add(arc, arc.curve, arc.closed, surface_.is_closed());
      return std::move(result_);
    }
    for (int axis = 0; axis < 3; ++axis)
      for (const bool upper : {false, true}) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        Frame face;
        face.x = face.y = face.z = Vec3(0);
        face.x[u] = face.y[v] = face.z[axis] = 1;
        face.origin[axis] = (upper ? region_.box.hi : region_.box.lo)[axis];
        const ImplicitArcs found = implicit_arcs(formula_, region_, face, {region_.box.lo[u], region_.box.hi[u]},
                                                 {region_.box.lo[v], region_.box.hi[v]});
        note(found);
        for (const ImplicitArc& arc : found.arcs) add(arc, arc.curve, arc.closed, false);
      }
    if (surface_.is_closed()) add_box_edges();
    return std::move(result_);
  }

  ImplicitContours creases() {
    if (formula_.smoothness() == Expression::Smoothness::smooth) return {};
    const Box3 box = search_box();
    const std::vector<ImplicitBranch> branches = implicit_branches(formula_, box);
    for (const ImplicitBranch& branch : branches)
      for (size_t k = 0; k < branch.sides.size(); ++k) {
        const ImplicitSide& side = branch.sides[k];
        if (!side.positive) continue;  // that is another branch's
        const ImplicitArcs found =
            implicit_arcs(branch, region_, ImplicitCondition::other(*side.height, Affine()), box, k);
        note(found);
        for (const ImplicitArc& arc : found.arcs)
          each_inside(arc, [&](const CurvePtr& curve, bool closed) {
            add_crease(branch, *side.height, branches, curve, closed);
          });
      }
    return std::move(result_);
  }

  ImplicitContours section(const Vec3& origin, const Vec3& normal) {
    const Frame plane = frame_about(origin, normal);
    const Vec3 center = region_.box.center();
    Interval x{kInfinity, -kInfinity}, y = x;
    const auto include = [&](const Vec3& p) {
      const Vec3 local = plane.to_local_point(p);
      x = hull(x, Interval(local.x)), y = hull(y, Interval(local.y));
    };
    const double height = glm::dot(center - origin, normal);
    if (region_.is_ball) {
      const double r = region_.radius();
      if (!(std::abs(height) < r)) return {};
      const double reach = std::sqrt(r * r - height * height) + kAroundBall * r;
      for (const double side : {-1.0, 1.0}) include(center + side * reach * (plane.x + plane.y));
    } else {
      each_box_edge([&](const Vec3& from, const Vec3& to) {
        const double a = glm::dot(from - origin, normal), b = glm::dot(to - origin, normal);
        if ((a < 0) != (b < 0)) include(from + a / (a - b) * (to - from));
      });
      if (!(x.width() > 0 && y.width() > 0)) return {};
    }
    const ImplicitArcs found = implicit_arcs(formula_, region_, plane, x, y);
    note(found);
    for (const ImplicitArc& arc : found.arcs)
      each_inside(arc, [&](const CurvePtr& curve, bool closed) { add(arc, curve, closed, false); });
    if (surface_.is_closed()) add_section_of_region(plane, height);
    return std::move(result_);
  }

 private:
  Box3 search_box() const {
    return region_.is_ball ? region_.box.inflated(kAroundBall * region_.box.diameter()) : region_.box;
  }
  void note(const ImplicitArcs& found) { result_.complete = result_.complete && found.complete; }

  Vec3 sight_at(const Vec3& p) const { return view_.central ? p - view_.direction_or_eye : view_.direction_or_eye; }

  std::vector<double> changes_of_F(const Curve& curve, bool closed) const {
    return sign_changes(
        curve, closed, [&](const Box3& box) { return range_of(formula_, box).over.value; },
        [&](const Vec3& p) { return formula_(p); });
  }
  bool is_solid_at(const Vec3& p) const { return formula_(p) < 0; }

  // What of a curve lies in the region.
  void each_inside(const ImplicitArc& arc, const std::function<void(CurvePtr, bool)>& put) const {
    const Vec3 center = region_.box.center();
    std::vector<double> cuts;
    const auto cut = [&](const std::function<Interval(const Box3&)>& range,
                         const std::function<double(const Vec3&)>& value) {
      const std::vector<double> found = sign_changes(*arc.curve, arc.closed, range, value);
      cuts.insert(cuts.end(), found.begin(), found.end());
    };
    if (region_.is_ball) {
      const ImplicitCondition sphere = ImplicitCondition::sphere(center, region_.radius());
      cut([&](const Box3& box) { return sphere.at(SecondOrder<Interval>(), triple(box)).value; },
          [&](const Vec3& p) { return sphere.at(SecondOrder<double>(), triple(p)).value; });
    } else {
      for (int k = 0; k < 3; ++k)
        for (const double face : {region_.box.lo[k], region_.box.hi[k]})
          cut([k, face](const Box3& box) { return Interval(box.lo[k], box.hi[k]) - Interval(face); },
              [k, face](const Vec3& p) { return p[k] - face; });
    }
    std::sort(cuts.begin(), cuts.end());
    const auto is_inside = [&](double t) {
      const Vec3 p = arc.curve->point(t);
      return region_.is_ball ? glm::length(p - center) <= region_.radius()
                             : region_.box.inflated(kMinPart * region_.box.diameter()).contains(p);
    };
    const Interval all = arc.curve->domain();
    each_kept(all, arc.closed, cuts, is_inside, [&](const Interval& t) {
      if (t.width() == all.width() && cuts.empty())
        put(arc.curve, arc.closed);
      else
        put(stretch(arc.curve, t), false);
    });
  }

  void add_silhouette(const ImplicitArc& arc, const CurvePtr& curve, bool closed, const Interval& regular) {
    const ImplicitFormula& formula = *arc.formula;
    const auto bend_at = [&](const Vec3& p) { return bend_along(second_order(formula, p), triple(sight_at(p))); };
    ImplicitContour line{curve, closed, {}, nullptr};
    line.turns = sign_changes(
        *curve, closed,
        [&](const Box3& box) {
          const Triple<Interval> v = triple(Box3{view_.direction_or_eye, view_.direction_or_eye});
          return bend_along(range_of(formula, box).over, view_.central ? triple(box) - v : v);
        },
        bend_at);
    line.outward_offset = outward_offset_of(*curve, line.turns, regular, formula, bend_at);
    result_.lines.push_back(std::move(line));
  }

  // grad F, of unit length, to the side on which the line of sight passes. None where that cannot be told.
  CurvePtr outward_offset_of(const Curve& curve, const std::vector<double>& cusps, const Interval& regular,
                             const ImplicitFormula& formula, const std::function<double(const Vec3&)>& bend_at) {
    const Interval domain = curve.domain();
    std::vector<double> ends{domain.lo};
    for (const double cusp : cusps)
      if (cusp > ends.back() && cusp < domain.hi) ends.push_back(cusp);
    ends.push_back(domain.hi);
    std::vector<PolynomialCurve::Part> parts;
    for (size_t k = 0; k + 1 < ends.size(); ++k) {
      const Interval t{ends[k], ends[k + 1]};
      const double side = bend_at(curve.point(t.middle())) > 0 ? 1 : -1;
      const auto outward_offset = [&](double at) {
        const Vec3 slope = formula.gradient(curve.point(regular.clamp(at)));
        return side / glm::length(slope) * slope;
      };
      std::vector<Interval> pieces;
      for (const CurvePiece& piece : curve.pieces())
        if (const Interval part = intersect(piece.domain, t); part.width() > 0) pieces.push_back(part);
      const auto found = polynomial_approximation(outward_offset, pieces, kAgreeAside);
      if (!found) {
        result_.complete = false;
        return nullptr;
      }
      parts.insert(parts.end(), found->parts().begin(), found->parts().end());
    }
    return std::make_shared<PolynomialCurve>(std::move(parts));
  }

  // Where the height vanishes, and another branch begins.
  void add_crease(const ImplicitBranch& branch, const ImplicitFormula& height,
                  const std::vector<ImplicitBranch>& branches, const CurvePtr& curve, bool closed) {
    const Interval domain = curve->domain();
    bool is_sharp = false;
    const ImplicitFormula* other = nullptr;
    for (const double share : {0.05, 0.23, 0.5, 0.81, 0.97}) {
      const Vec3 p = curve->point(domain.lo + share * domain.width());
      const Vec3 up = height.gradient(p);
      if (!(glm::length(up) > 0)) continue;
      const Vec3 below = p - kBeside * region_.box.diameter() / glm::length(up) * up;
      const auto found =
          std::find_if(branches.begin(), branches.end(), [&](const ImplicitBranch& one) { return one.holds(below); });
      if (found == branches.end()) continue;
      other = found->formula.get();
      const Vec3 a = branch.formula->gradient(p), b = other->gradient(p);
      if (glm::length(a / glm::length(a) - b / glm::length(b)) > kSmoothEdge) is_sharp = true;
      // A jump: the sheet ends there, at a wall that is not known.
      if (std::abs((*other)(p)) > kNoJump * region_.box.diameter() * glm::length(b))
        is_sharp = true, result_.complete = false;
    }
    if (!other) result_.complete = false;
    if (!is_sharp) return;
    ImplicitContour line{curve, closed, silhouette_crossings(*curve, closed, *branch.formula, view_), nullptr};
    const std::vector<double> turns = silhouette_crossings(*curve, closed, *other, view_);
    line.turns.insert(line.turns.end(), turns.begin(), turns.end());
    result_.lines.push_back(std::move(line));
  }

  // Where the ball of the region turns away along a curve on it.
  std::vector<double> turns_of_ball(const Curve& curve, bool closed) const {
    const Vec3 center = region_.box.center();
    return sign_changes(
        curve, closed,
        [&](const Box3& box) {
          const Vec3& v = view_.direction_or_eye;
          const Triple<Interval> p = triple(box);
          return dot(p - triple(center), view_.central ? p - triple(v) : triple(Box3{v, v}));
        },
        [&](const Vec3& p) { return glm::dot(p - center, sight_at(p)); });
  }

  // A line on the surface, and perhaps on the ball of the region, that is no silhouette.
  void add(const ImplicitArc& arc, const CurvePtr& curve, bool closed, bool on_ball) {
    ImplicitContour line{curve, closed, silhouette_crossings(*curve, closed, *arc.formula, view_), nullptr};
    if (on_ball) {
      const std::vector<double> found = turns_of_ball(*curve, closed);
      line.turns.insert(line.turns.end(), found.begin(), found.end());
      std::sort(line.turns.begin(), line.turns.end());
    }
    result_.lines.push_back(std::move(line));
  }

  // As far as the solid fills the ball there.
  void add_outline_of_ball() {
    const std::array centers{region_.box.center()};
    const std::array radii{region_.radius()};
    for (const ShapeOutline& outline : outlines(Balls(centers, radii), view_).lines) {
      const auto* circle = dynamic_cast<const Circle*>(outline.curve.get());
      const auto* outward_offset = dynamic_cast<const Circle*>(outline.outward_offset.get());
      each_kept(
          circle->domain(), true, changes_of_F(*circle, true), [&](double t) { return is_solid_at(circle->point(t)); },
          [&](const Interval& t) {
            result_.lines.push_back({std::make_shared<Circle>(circle->frame(), circle->radius(), t),
                                     t.width() == circle->domain().width(),
                                     {},
                                     std::make_shared<Circle>(outward_offset->frame(), outward_offset->radius(), t)});
          });
    }
  }

  template <class Visit>
  void each_box_edge(const Visit& visit) const {
    for (int axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 4; ++side) {
        Vec3 from = region_.box.lo;
        if (side & 1) from[(axis + 1) % 3] = region_.box.hi[(axis + 1) % 3];
        if (side & 2) from[(axis + 2) % 3] = region_.box.hi[(axis + 2) % 3];
        Vec3 to = from;
        to[axis] = region_.box.hi[axis];
        visit(from, to);
      }
  }
  void add_box_edges() {
    each_box_edge([&](const Vec3& from, const Vec3& to) { add_in_solid(from, to); });
  }

  // What of a straight line lies in the solid.
  void add_in_solid(const Vec3& from, const Vec3& to) {
    if (from == to) return;
    const Segment whole(from, to);
    each_kept(
        whole.domain(), false, changes_of_F(whole, false), [&](double t) { return is_solid_at(whole.point(t)); },
        [&](const Interval& t) {
          result_.lines.push_back(
              {std::make_shared<Segment>(whole.point(t.lo), whole.point(t.hi)), false, {}, nullptr});
        });
  }

  // Where a plane meets the border of the region inside of the solid.
  void add_section_of_region(const Frame& plane, double height) {
    if (region_.is_ball) {
      const double r = region_.radius();
      Frame frame = plane;
      frame.origin = region_.box.center() - height * plane.z;
      const Circle circle(frame, std::sqrt(r * r - height * height));
      each_kept(
          circle.domain(), true, changes_of_F(circle, true), [&](double t) { return is_solid_at(circle.point(t)); },
          [&](const Interval& t) {
            const auto arc = std::make_shared<Circle>(frame, circle.radius(), t);
            const bool whole = t.width() == circle.domain().width();
            result_.lines.push_back({arc, whole, turns_of_ball(*arc, whole), nullptr});
          });
      return;
    }
    // On each face between the two of its edges that the plane meets.
    for (int axis = 0; axis < 3; ++axis)
      for (const double face : {region_.box.lo[axis], region_.box.hi[axis]}) {
        std::vector<Vec3> met;
        each_box_edge([&](const Vec3& from, const Vec3& to) {
          if (from[axis] != face || to[axis] != face) return;
          const double a = glm::dot(from - plane.origin, plane.z), b = glm::dot(to - plane.origin, plane.z);
          if ((a < 0) != (b < 0)) met.push_back(from + a / (a - b) * (to - from));
        });
        if (met.size() == 2) add_in_solid(met[0], met[1]);
      }
  }

  const ImplicitSurface& surface_;
  const ImplicitFormula& formula_;
  const ImplicitRegion& region_;
  const ViewOf& view_;
  const ImplicitCondition sight_;
  ImplicitContours result_;
};

}  // namespace

ImplicitContours silhouette(const ImplicitSurface& surface, const ViewOf& view) {
  require(view);
  return Collector(surface, view).silhouette();
}

ImplicitContours border(const ImplicitSurface& surface, const ViewOf& view) {
  require(view);
  return Collector(surface, view).border();
}

ImplicitContours creases(const ImplicitSurface& surface, const ViewOf& view) {
  require(view);
  return Collector(surface, view).creases();
}

ImplicitContours plane_section(const ImplicitSurface& surface, const Vec3& origin, const Vec3& normal,
                               const ViewOf& view) {
  require(view);
  require(is_way(normal) && glm::length(origin) < kInfinity, "the plane must be finite, its normal of a length");
  return Collector(surface, view).section(origin, glm::normalize(normal));
}

}  // namespace lekalo::geometry
