// A sheet of some thickness on a surface or a trimmed part of one (Golovanov 2016, 5.9): the base b, the offset
// r = b + h m, and for each free edge (u(t), v(t)) of the base the ruled face (1 - w) b + w r. Loops for h > 0: r as
// the base, b the other way round, sides +e_1 +e_i -e_2 -e_(i-1).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/bodies/primitives/construct.h"
#include "geometry/bodies/topology/sew.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/queries/contours/parameter_lines.h"
#include "geometry/queries/differential/curvature.h"
#include "geometry/surfaces/derived/offset.h"
#include "geometry/surfaces/nets/lofts.h"

namespace lekalo::geometry {

namespace {

constexpr int kTried = 24;

// The offset is regular while 1 - 2 h H + h^2 K > 0 and h is below both principal radii on its side.
void check_regular(const Surface& base, double u, double v, double h) {
  const SurfaceCurvature found = curvature(base, u, v);
  if (!found.regular) return;
  const double largest = h > 0 ? found.principal[0] : -found.principal[1];
  if (std::abs(h) * largest >= 1)
    throw FieldError("thickness",
                     fmt::format("the surface is curved more than that at (u, v) = ({:.6g}, {:.6g}): its radius of "
                                 "curvature on this side is {:.6g}",
                                 u, v, 1 / largest),
                     "a smaller thickness, or the other side (its negative)");
}

// At places of the face, and of its borders where it is a part of its surface.
void check_regular(const FaceRegion& face, double h) {
  const Surface& base = *face.surface;
  const Rectangle d = face.region ? Rectangle{face.region->u_range(), face.region->v_range()} : base.domain();
  const auto at = [](const Interval& range, int k) { return range.clamp(range.lo + range.width() * k / kTried); };
  for (int i = 0; i <= kTried; ++i)
    for (int j = 0; j <= kTried; ++j) {
      const double u = at(d.u, i), v = at(d.v, j);
      if (!face.region || face.region->contains(u, v)) check_regular(base, u, v, h);
    }
  if (!face.region) return;
  for (const Curve2Ptr& border : face.borders)
    for (int k = 0; k <= kTried; ++k) {
      const Vec3 place = border->point(at(border->domain(), k));
      check_regular(base, place.x, place.y, h);
    }
}

class Thickening {
 public:
  Thickening(const Body& sheet, double h) : sheet_(sheet), h_(h) {}

  Body build() {
    for (const Vertex& v : sheet_.vertices) body_.add_vertex(v.point, v.origin);
    lift_vertices();
    for (const Edge& e : sheet_.edges) body_.add_edge(e.curve, e.start, e.end, e.origin, e.kind);
    for (size_t e = 0; e < sheet_.edges.size(); ++e) lift_edge(e);
    for (size_t f = 0; f < sheet_.faces.size(); ++f) {
      add_copy(f, false);
      add_copy(f, true);
    }
    for (size_t e = 0; e < sheet_.edges.size(); ++e)
      if (is_free(sheet_.edges[e])) add_side(e);
    make_shells();
    measure_tolerances(body_);
    return std::move(body_);
  }

 private:
  bool is_free(const Edge& edge) const { return edge.kind != EdgeKind::pole && edge.coedges.size() == 1; }
  const Coedge& first_use(const Edge& edge) const { return sheet_.coedges[edge.coedges[0]]; }
  const SurfacePtr& base_of(const Coedge& c) const { return sheet_.faces[sheet_.loops[c.loop].face].surface; }
  SurfacePtr lifted(size_t face) {
    if (lifted_.empty()) lifted_.resize(sheet_.faces.size());
    // The normal of the face, not that of the surface.
    if (!lifted_[face])
      lifted_[face] = offset_surface(sheet_.faces[face].surface, sheet_.faces[face].forward ? h_ : -h_);
    return lifted_[face];
  }

  void lift_vertices() {
    std::vector<Vec3> points(sheet_.vertices.size());
    for (const Coedge& c : sheet_.coedges) {
      const Edge& edge = sheet_.edges[c.edge];
      const SurfacePtr top = lifted(sheet_.loops[c.loop].face);
      for (const bool last : {false, true}) {
        const Vec3 uv = c.image->point(last ? c.image->domain().hi : c.image->domain().lo);
        points[last ? edge.end : edge.start] = top->point(uv.x, uv.y);
      }
    }
    for (size_t v = 0; v < points.size(); ++v) body_.add_vertex(points[v], sheet_.vertices[v].origin);
  }

  void lift_edge(size_t e) {
    const Edge& edge = sheet_.edges[e];
    const Coedge& use = first_use(edge);
    const SurfacePtr top = lifted(sheet_.loops[use.loop].face);
    const int shift = static_cast<int>(sheet_.vertices.size());
    CurvePtr curve;
    if (edge.kind == EdgeKind::pole)
      curve = point_curve(edge.curve->domain(), body_.vertices[edge.start + shift].point);
    else
      curve = std::make_shared<SurfaceCurve>(top, use.image);
    body_.add_edge(curve, edge.start + shift, edge.end + shift, edge.origin, edge.kind);
  }

  void add_copy(size_t f, bool top) {
    const Face& face = sheet_.faces[f];
    // Outward on the far side of the thickness: with the face's normal where h > 0.
    const bool along = top == (h_ > 0);
    const size_t count = sheet_.faces.size();
    const int index = count == 1 ? -1 : static_cast<int>(f);
    const int copy = body_.add_face(top ? lifted(f) : face.surface, face.forward == along,
                                    {"", top ? "offset" : "base", index}, face.trimmed);
    for (const int l : face.loops) {
      std::vector<Body::Use> uses;
      for (const int c : sheet_.loops[l].coedges) {
        const Coedge& use = sheet_.coedges[c];
        const int edge = use.edge + (top ? static_cast<int>(sheet_.edges.size()) : 0);
        uses.push_back({edge, use.forward == along, use.image});
      }
      if (!along) std::reverse(uses.begin(), uses.end());
      body_.add_loop(copy, uses);
    }
  }

  int post(int vertex) {
    if (posts_.empty()) posts_.assign(sheet_.vertices.size(), -1);
    int& found = posts_[vertex];
    if (found < 0) {
      const int top = vertex + static_cast<int>(sheet_.vertices.size());
      found = body_.add_edge(std::make_shared<Segment>(body_.vertices[vertex].point, body_.vertices[top].point), vertex,
                             top, {"", "post", vertex});
    }
    return found;
  }

  void add_side(size_t e) {
    const int bottom = static_cast<int>(e), top = bottom + static_cast<int>(sheet_.edges.size());
    const Edge& edge = sheet_.edges[e];
    const SurfacePtr side = ruled_surface(body_.edges[bottom].curve, body_.edges[top].curve);
    const Rectangle d = side->domain();
    const bool closed = edge.start == edge.end;
    const int from = post(edge.start), to = post(edge.end);
    if (closed) body_.edges[from].kind = EdgeKind::seam;
    // The base lies to the left of its use: so the side's normal, tangent x post, looks away from it for h > 0.
    const bool outward = first_use(edge).forward == (h_ > 0);
    const int face = body_.add_face(side, outward, {"", "side", sides_++}, false);
    std::vector<Body::Use> uses{{bottom, true, image_line(d.u, {d.u.lo, 0}, {d.u.hi, 0})},
                                {to, true, image_line({0, 1}, {d.u.hi, 0}, {d.u.hi, 1})},
                                {top, false, image_line(d.u, {d.u.lo, 1}, {d.u.hi, 1})},
                                {from, false, image_line({0, 1}, {d.u.lo, 0}, {d.u.lo, 1})}};
    if (!outward) {
      std::reverse(uses.begin(), uses.end());
      for (Body::Use& use : uses) use.forward = !use.forward;
    }
    body_.add_loop(face, uses);
  }

  // Without sides the base and its offset are two shells, the outer one first.
  void make_shells() {
    body_.close_shell();
    if (sides_ > 0) return;
    Shell base, top;
    for (size_t f = 0; f < body_.faces.size(); ++f) (f % 2 == 0 ? base : top).faces.push_back(static_cast<int>(f));
    const bool top_is_outer = h_ > 0;
    body_.shells = {top_is_outer ? top : base, top_is_outer ? base : top};
    for (size_t s = 0; s < 2; ++s)
      for (const int f : body_.shells[s].faces) body_.faces[f].shell = static_cast<int>(s);
  }

  const Body& sheet_;
  double h_;
  Body body_;
  std::vector<SurfacePtr> lifted_;
  std::vector<int> posts_;
  int sides_ = 0;
};

BodyPtr sheet_of(const std::any& of) {
  if (const auto* body = std::any_cast<BodyPtr>(&of)) {
    if ((*body)->is_closed())
      throw FieldError("of", "a closed body has no thickness to get", "a surface, or a trimmed part of one");
    for (const Edge& edge : (*body)->edges)
      if (edge.kind == EdgeKind::regular && edge.coedges.size() > 1)
        throw FieldError("of", "the sheet has several faces that meet along edges", "thicken one surface");
    return *body;
  }
  const SurfacePtr surface = std::any_cast<SurfacePtr>(of);
  if (!surface->bounded()) throw FieldError("of", "the surface is unbounded", "give it a domain");
  return std::make_shared<Body>(sew(std::array{surface}, 1e-12));
}

Body thickened(const Fields& f) {
  const double h = f.number("thickness");
  if (h == 0) throw FieldError("thickness", "the thickness is zero");
  const BodyPtr sheet = sheet_of(f.any("of"));
  const std::vector<FaceRegion> faces = face_regions(*sheet);
  for (size_t f = 0; f < faces.size(); ++f) check_regular(faces[f], sheet->faces[f].forward ? h : -h);
  return Thickening(*sheet, h).build();
}

}  // namespace

TypeDeclaration thickened_sheet_type() {
  return declare(
             Category::body, "thickened_sheet",
             "Body of constant thickness on a surface, or on a trimmed part of one. Faces: base, offset, and side.k "
             "along its borders; a surface closed both ways makes a hollow body.")
      .example("of: { type: cylinder_surface, radius: 1, height: 2 }, thickness: 0.2")
      .field("of", reference({Category::surface, Category::body}), "a surface, or a trimmed_surface")
      .field("thickness", length(), "along the normal; negative to the other side")
      .built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(thickened(f)); });
}

}  // namespace lekalo::geometry
