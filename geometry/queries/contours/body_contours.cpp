// Every contour of a face's whole surface is cut where the face's edges cross what makes the contour: the plane, the
// other surface (by geometry/queries/intersections/curve_intersections.h, none lost). Between two such places it lies
// in the face altogether or not at all: its middle decides. Silhouettes have no surface to cross: there the edges'
// images are met in the parameter plane.
#include "geometry/queries/contours/body_contours.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <mutex>

#include "geometry/bodies/trims/trim.h"
#include "geometry/queries/contours/contour_approximation.h"
#include "geometry/queries/contours/contour_curve.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "geometry/queries/differential/plane_lines.h"
#include "geometry/queries/intersections/curve_intersections.h"
#include "geometry/surfaces/analytic/plane.h"

namespace lekalo::geometry {

namespace {

// Parts of the size.
constexpr double kSameCut = 1e-9;
constexpr double kSameJoint = 1e-8;
// What stands for a searched curve where crossings are sought to kSamePoint.
constexpr double kNearCurve = 1e-11;
// Of the parameters of a face's border.
constexpr double kOnBorder = 1e-9;

// A contour as a polygon, to look up its points.
class MeasuredContour {
 public:
  explicit MeasuredContour(const Contour& contour) : contour_(contour) {
    // Pieces of contours that were searched are short and their own parts of the polygon.
    constexpr int kPartsOfOthers = 16;
    const int parts = is_searched(*contour.curve) ? 1 : kPartsOfOthers;
    ends_.push_back(contour.curve->domain().lo);
    for (const CurvePiece& piece : contour.curve->pieces())
      for (int k = 1; k <= parts; ++k)
        ends_.push_back(k == parts ? piece.domain.hi : piece.domain.lo + piece.domain.width() * k / parts);
    for (const double t : ends_) {
      corners_.push_back(contour.curve->point(t));
      if (corners_.size() > 1) length_ += glm::length(corners_.back() - corners_[corners_.size() - 2]);
    }
  }
  double length() const { return length_; }
  // Length by parameter, in the mean.
  double speed() const { return length_ / contour_.curve->domain().width(); }

  // The parameter of a point on it; nothing where it is farther than `near` from it.
  std::optional<double> place_of(const Vec3& p, double near) const {
    double best = kInfinity, t = 0;
    for (size_t k = 0; k + 1 < corners_.size(); ++k) {
      const Vec3 chord = corners_[k + 1] - corners_[k];
      const double length = glm::length(chord);
      const double height = std::clamp(glm::dot(p - corners_[k], chord) / length, 0.0, length);
      const double apart = glm::length(corners_[k] + height / length * chord - p);
      if (apart < best) best = apart, t = ends_[k] + height / length * (ends_[k + 1] - ends_[k]);
    }
    // The chord's height is the parameter of what was searched; of others it starts Newton's iteration.
    const Interval domain = contour_.curve->domain();
    constexpr int kSteps = 6;
    CurveJet at = contour_.curve->evaluate(t, 1);
    for (int step = 0; step < kSteps; ++step) {
      const double off = glm::dot(p - at.d[0], at.d[1]) / glm::dot(at.d[1], at.d[1]);
      if (!(std::abs(off) * speed() > 1e-3 * near)) break;
      t += off;
      if (contour_.closed)
        t -= domain.width() * std::floor((t - domain.lo) / domain.width());
      else
        t = domain.clamp(t);
      at = contour_.curve->evaluate(t, 1);
    }
    if (!(glm::length(at.d[0] - p) <= near)) return std::nullopt;
    return t;
  }

 private:
  const Contour& contour_;
  std::vector<double> ends_;
  std::vector<Vec3> corners_;
  double length_ = 0;
};

struct FaceOf {
  const Body* body = nullptr;
  int face = -1;
  std::shared_ptr<const TrimRegion> trim;

  FaceOf(const Body& body, int face) : body(&body), face(face), trim(trim_of(body, face)) {}
  const Face& operator*() const { return body->faces[face]; }
  const Face* operator->() const { return &body->faces[face]; }
  bool holds(const Vec3& uv) const { return !trim || trim->contains(uv.x, uv.y, kOnBorder); }
  // Its edges but for seams and poles.
  std::vector<int> edges() const {
    std::vector<int> result;
    for (const int loop : body->faces[face].loops)
      for (const int c : body->loops[loop].coedges) {
        const int edge = body->coedges[c].edge;
        if (body->edges[edge].kind == EdgeKind::regular &&
            std::find(result.begin(), result.end(), edge) == result.end())
          result.push_back(edge);
      }
    return result;
  }
};

// A curve that lies on the contour all along, as seen in some places.
bool runs_along(const Curve& curve, const MeasuredContour& contour, double near) {
  for (const double share : {0.0, 0.11, 0.29, 0.5, 0.73, 0.91, 1.0}) {
    const Interval t = curve.domain();
    if (!contour.place_of(curve.point(t.lo + share * t.width()), near)) return false;
  }
  return true;
}

class Joining {
 public:
  explicit Joining(double size) : size_(size) {}

  // The stretches of a contour between the cuts that `holds` keeps.
  void add(const Contour& contour, const std::vector<Vec3>& cuts, int face, int other_face,
           const std::function<bool(double)>& holds) {
    const Interval domain = contour.curve->domain();
    const MeasuredContour measured(contour);
    const double same = kSameCut * size_ / measured.speed();
    std::vector<double> places;
    for (const Vec3& cut : cuts)
      if (const auto t = measured.place_of(cut, kSameJoint * size_)) places.push_back(*t);
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end(), [&](double a, double b) { return b - a <= same; }),
                 places.end());
    if (!contour.closed) {
      places.insert(places.begin(), domain.lo);
      places.push_back(domain.hi);
    } else if (places.empty()) {
      if (holds(domain.middle())) {
        BodyContourPart part{
            contour, domain, false, face, other_face, contour.curve->point(domain.lo), contour.curve->point(domain.lo)};
        whole_.push_back({{std::move(part)}, true});
      }
      return;
    } else {
      places.push_back(places.front() + domain.width());
    }
    for (size_t k = 0; k + 1 < places.size(); ++k) {
      const Interval t{places[k], places[k + 1]};
      const double middle = t.middle() > domain.hi ? t.middle() - domain.width() : t.middle();
      if (!(t.width() > same) || !holds(middle)) continue;
      parts_.push_back({contour, t, false, face, other_face, contour.curve->point(t.lo), contour.curve->point(t.hi)});
    }
  }

  BodyContours joined() {
    BodyContours result;
    result.branches = std::move(whole_);
    result.points = std::move(points);
    result.complete = complete;
    result.coincident = coincident;
    drop_doubles();
    std::vector<bool> used(parts_.size(), false);
    // Open branches from an end that no other part has, then loops.
    for (const bool open : {true, false})
      for (size_t k = 0; k < parts_.size(); ++k) {
        if (used[k]) continue;
        const bool from_begin = neighbour(k, parts_[k].begin, used) < 0,
                   from_end = neighbour(k, parts_[k].end, used) < 0;
        if (open && !from_begin && !from_end) continue;
        result.branches.push_back(chain(k, open && !from_begin, used));
      }
    return result;
  }

  std::vector<ContourPoint> points;
  bool complete = true, coincident = false;

 private:
  bool same(const Vec3& a, const Vec3& b) const { return glm::length(a - b) <= kSameJoint * size_; }

  // Along a common edge both faces have the contour.
  void drop_doubles() {
    for (size_t k = 0; k < parts_.size(); ++k)
      for (size_t i = k + 1; i < parts_.size();) {
        const BodyContourPart &a = parts_[k], &b = parts_[i];
        const bool ends =
            (same(a.begin, b.begin) && same(a.end, b.end)) || (same(a.begin, b.end) && same(a.end, b.begin));
        bool doubled = false;
        if (ends && a.face != b.face) {
          const MeasuredContour other(a.contour);
          doubled = other.place_of(b.contour.curve->point(b.t.middle()), kSameJoint * size_).has_value();
        }
        if (doubled)
          parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(i));
        else
          ++i;
      }
  }

  int neighbour(size_t of, const Vec3& p, const std::vector<bool>& used) const {
    for (size_t k = 0; k < parts_.size(); ++k)
      if (k != of && !used[k] && (same(parts_[k].begin, p) || same(parts_[k].end, p))) return static_cast<int>(k);
    return -1;
  }

  BodyContour chain(size_t first, bool backwards, std::vector<bool>& used) const {
    BodyContour branch;
    int k = static_cast<int>(first);
    while (k >= 0) {
      used[k] = true;
      BodyContourPart part = parts_[k];
      part.backwards = backwards;
      if (backwards) std::swap(part.begin, part.end);
      branch.parts.push_back(part);
      if (same(part.end, branch.parts.front().begin)) {
        branch.closed = true;
        break;
      }
      k = neighbour(k, part.end, used);
      if (k >= 0) backwards = same(parts_[k].end, part.end) && !same(parts_[k].begin, part.end);
    }
    return branch;
  }

  double size_;
  std::vector<BodyContourPart> parts_;
  std::vector<BodyContour> whole_;
};

// Singular points inside of the faces; where contours of whole surfaces end those of bodies may go on.
void keep_points(Joining& joining, const Contours& found, const FaceOf& face, const FaceOf* other) {
  joining.complete = joining.complete && found.complete;
  joining.coincident = joining.coincident || found.coincident;
  for (const ContourPoint& point : found.points) {
    if (point.kind == ContourPointKind::end) continue;
    if (point.parameters.size() < 2 || !face.holds({point.parameters[0], point.parameters[1], 0})) continue;
    if (other && point.parameters.size() == 4 && !other->holds({point.parameters[2], point.parameters[3], 0})) continue;
    joining.points.push_back(point);
  }
}

// Where an edge meets a surface; where it lies in the surface its ends.
std::vector<Vec3> cuts_of(const Curve& edge, const Surface& surface, double tolerance) {
  const SurfaceIntersections found = intersect(edge, surface, tolerance);
  std::vector<Vec3> cuts;
  for (const SurfaceIntersection& intersection : found.points) cuts.push_back(intersection.point);
  for (const Interval& part : found.on_surface)
    for (const double t : {part.lo, part.hi}) cuts.push_back(edge.point(t));
  return cuts;
}
// An edge is one of two faces: what was found is kept.
using KnownCuts = std::map<std::pair<const Curve*, const Surface*>, std::vector<Vec3>>;

void add_cuts(std::vector<Vec3>& cuts, const FaceOf& face, const Surface& surface, double tolerance, KnownCuts& known) {
  for (const int edge : face.edges()) {
    const Curve& curve = *face.body->edges[edge].curve;
    const auto [found, is_new] = known.try_emplace({&curve, &surface});
    if (is_new) found->second = cuts_of(curve, surface, tolerance);
    cuts.insert(cuts.end(), found->second.begin(), found->second.end());
  }
}

void meet_faces(Joining& joining, const FaceOf& a, const FaceOf& b, double tolerance, KnownCuts& known) {
  const Contours found = intersect(a->surface, b->surface, tolerance);
  keep_points(joining, found, a, &b);
  std::vector<Vec3> cuts;
  if (!found.branches.empty()) {
    add_cuts(cuts, a, *b->surface, tolerance, known);
    add_cuts(cuts, b, *a->surface, tolerance, known);
  }
  for (const Contour& contour : found.branches)
    joining.add(contour, cuts, a.face, b.face,
                [&](double t) { return a.holds(contour.images[0]->point(t)) && b.holds(contour.images[1]->point(t)); });
}

bool boxes_meet(const Box3& a, const Box3& b, double by) {
  for (int k = 0; k < 3; ++k)
    if (a.lo[k] - by > b.hi[k] || b.lo[k] - by > a.hi[k]) return false;
  return true;
}

double size_of(const Box3& box) { return std::max(box.diameter(), 1e-300); }

int count_of(const Body& body) { return static_cast<int>(body.faces.size()); }

}  // namespace

BodyContours plane_section(const Body& body, const Vec3& origin, const Vec3& normal) {
  Joining joining(size_of(bounds(body)));
  const Plane plane(frame_about(origin, glm::normalize(normal)));
  KnownCuts known;
  for (int k = 0; k < count_of(body); ++k) {
    const FaceOf face(body, k);
    const Contours found = plane_section(face->surface, origin, normal);
    keep_points(joining, found, face, nullptr);
    std::vector<Vec3> cuts;
    if (!found.branches.empty()) add_cuts(cuts, face, plane, kSamePoint, known);
    for (const Contour& contour : found.branches)
      joining.add(contour, cuts, k, -1, [&](double t) { return face.holds(contour.images[0]->point(t)); });
  }
  return joining.joined();
}

namespace {

bool is_plane(const Surface& surface) {
  return dynamic_cast<const Plane*>(&surface) || (surface.bounded() && plane_lines(surface).surface);
}

// The edges of a body as polynomials: of what was searched every enclosure solves equations. Safe to use from many
// threads.
class SimpleEdges {
 public:
  explicit SimpleEdges(const Body& body) : body_(body), made_(body.edges.size()), curves_(body.edges.size()) {}
  const Curve& of(int edge) {
    std::call_once(made_[edge], [&] { curves_[edge] = contour_approximation(body_.edges[edge].curve, kNearCurve); });
    return *curves_[edge];
  }

 private:
  const Body& body_;
  std::vector<std::once_flag> made_;
  std::vector<CurvePtr> curves_;
};

// Where a contour of a face's whole surface crosses the face's edges.
std::vector<Vec3> cuts_by_edges(const Contour& contour, const MeasuredContour& measured, const FaceOf& face,
                                SimpleEdges& edges, double near) {
  std::vector<Vec3> cuts;
  const CurvePtr simple = contour_approximation(contour.curve, kNearCurve);
  for (const int number : face.edges()) {
    const Curve& edge = edges.of(number);
    // The search for crossings takes long over common parts.
    if (runs_along(edge, measured, near)) {
      cuts.push_back(edge.point(edge.domain().lo));
      cuts.push_back(edge.point(edge.domain().hi));
      continue;
    }
    for (const CurveIntersection& intersection : intersect(*simple, edge).points) cuts.push_back(intersection.point);
  }
  return cuts;
}

// The silhouettes of a face's whole surface, and their cuts.
struct FaceSilhouettes {
  FaceOf face;
  Contours found;
  std::vector<std::vector<Vec3>> cuts;  // of each branch
};

void find(FaceSilhouettes& of, const ViewOf& view, SimpleEdges& edges, double size) {
  // What is plane has none, or is one where it is seen edge-on: its edges show that.
  if (is_plane(*of.face->surface)) return;
  of.found = silhouette(of.face->surface, view);
  std::vector<Contour> lines;
  for (Contour& contour : of.found.branches) {
    const MeasuredContour measured(contour);
    // A side of the parameters that is one point: the normal vanishes all along it.
    if (measured.length() <= kSameJoint * size) continue;
    of.cuts.push_back(cuts_by_edges(contour, measured, of.face, edges, kSameJoint * size));
    lines.push_back(std::move(contour));
  }
  of.found.branches = std::move(lines);
}

}  // namespace

BodyContours silhouette(const Body& body, const ViewOf& view) {
  const double size = size_of(bounds(body));
  SimpleEdges edges(body);
  std::vector<FaceSilhouettes> faces;
  for (int k = 0; k < count_of(body); ++k) faces.push_back({FaceOf(body, k), {}, {}});
  tbb::parallel_for(size_t{0}, faces.size(), [&](size_t k) { find(faces[k], view, edges, size); });
  Joining joining(size);
  for (const auto& [face, found, cuts] : faces) {
    keep_points(joining, found, face, nullptr);
    for (size_t k = 0; k < found.branches.size(); ++k) {
      const Contour& contour = found.branches[k];
      joining.add(contour, cuts[k], face.face, -1,
                  [&, &of = face](double t) { return of.holds(contour.images[0]->point(t)); });
    }
  }
  return joining.joined();
}

BodyContours intersect(const Body& a, const Body& b, double tolerance) {
  Box3 all = bounds(a);
  all.include(bounds(b));
  const double size = size_of(all);
  Joining joining(size);
  KnownCuts known;
  std::vector<FaceOf> faces_b;
  std::vector<Box3> boxes_b;
  for (int k = 0; k < count_of(b); ++k) {
    faces_b.emplace_back(b, k);
    boxes_b.push_back(bounds(*b.faces[k].surface));
  }
  for (int i = 0; i < count_of(a); ++i) {
    const FaceOf face(a, i);
    const Box3 box = bounds(*face->surface);
    for (int k = 0; k < count_of(b); ++k)
      if (boxes_meet(box, boxes_b[k], tolerance * size)) meet_faces(joining, face, faces_b[k], tolerance, known);
  }
  return joining.joined();
}

BodyContours intersect(const Body& a, const SurfacePtr& b, double tolerance) {
  const auto* plane = dynamic_cast<const Plane*>(b.get());
  if (plane && !plane->bounded()) return plane_section(a, plane->frame().origin, plane->frame().z);
  // A body of one face without edges.
  Body sheet;
  sheet.add_face(b, true, {}, false);
  return intersect(a, sheet, tolerance);
}

}  // namespace lekalo::geometry
