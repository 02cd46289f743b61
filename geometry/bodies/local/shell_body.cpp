// Thin-walled body (Golovanov 2016, 6.8): between a body and the one whose kept faces are set off by the thickness
// while the opened ones stay, so that both have loops on the opened faces; between these lies the rim. Without opened
// faces the two are shells of a hollow body.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/bodies/local/face_replacement.h"
#include "geometry/bodies/local/offset_of_body.h"
#include "geometry/bodies/local/plane_seams.h"
#include "geometry/bodies/local/support.h"
#include "geometry/bodies/topology/characteristics.h"
#include "geometry/bodies/topology/entity_names.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/queries/closest/closest_point.h"

namespace lekalo::geometry {

namespace {

struct Half {
  Body body;
  std::vector<int> source;  // of each face: that of the body that is opened
};

class Walls {
 public:
  // `outer` encloses `inner`; opened: of each source.
  Walls(const Half& outer, const Half& inner, const std::vector<char>& opened)
      : outer_(outer), inner_(inner), opened_(opened), size_(bounds(outer.body).diameter()) {}

  Body build() {
    vertices_[0].assign(outer_.body.vertices.size(), -1);
    vertices_[1].assign(inner_.body.vertices.size(), -1);
    edges_[0].assign(outer_.body.edges.size(), -1);
    edges_[1].assign(inner_.body.edges.size(), -1);
    cut_.resize(outer_.body.edges.size());
    find_cut_edges();
    for (const int h : {0, 1})
      for (size_t f = 0; f < half(h).body.faces.size(); ++f)
        if (!opened_[half(h).source[f]]) add_wall(h, static_cast<int>(f));
    for (size_t s = 0; s < opened_.size(); ++s)
      if (opened_[s]) add_rim(static_cast<int>(s));
    add_shells();
    measure_tolerances(made_);
    return std::move(made_);
  }

 private:
  const Half& half(int h) const { return h == 0 ? outer_ : inner_; }

  bool is_between_opened(int h, int e) const {
    const Half& x = half(h);
    const Edge& edge = x.body.edges[e];
    return edge.kind != EdgeKind::pole && std::all_of(edge.coedges.begin(), edge.coedges.end(), [&](int c) {
             return opened_[x.source[face_of_coedge(x.body, c)]] != 0;
           });
  }

  std::vector<int> sources_of(int h, int e) const {
    std::vector<int> result;
    for (const int c : half(h).body.edges[e].coedges) result.push_back(half(h).source[face_of_coedge(half(h).body, c)]);
    std::sort(result.begin(), result.end());
    return result;
  }

  // Where two opened faces meet, the inner edge lies on the outer one and is no edge any more; what is left of the
  // outer one are its ends.
  void find_cut_edges() {
    for (size_t e = 0; e < inner_.body.edges.size(); ++e) {
      if (!is_between_opened(1, static_cast<int>(e))) continue;
      const Edge& in = inner_.body.edges[e];
      const auto sources = sources_of(1, static_cast<int>(e));
      for (size_t k = 0; k < outer_.body.edges.size(); ++k) {
        if (!is_between_opened(0, static_cast<int>(k)) || sources_of(0, static_cast<int>(k)) != sources) continue;
        const Edge& out = outer_.body.edges[k];
        const CurveFootPoints found = project(in.curve->point(in.curve->domain().middle()), *out.curve);
        if (found.foot_points.empty() || found.foot_points.front().distance > 1e-9 * size_) continue;
        cut_[k].push_back(static_cast<int>(e));
      }
    }
  }

  int vertex(int h, int v) {
    int& number = vertices_[h][v];
    if (number < 0) {
      const Vertex& old = half(h).body.vertices[v];
      number = made_.add_vertex(old.point, named(h, old.origin));
      made_.vertices.back().tolerance = old.tolerance;
    }
    return number;
  }

  // What lies inside is called so.
  static Origin named(int h, Origin origin) {
    if (h == 1) origin.feature = origin.feature.empty() ? "inner" : "inner." + origin.feature;
    return origin;
  }

  int edge(int h, int e) {
    int& number = edges_[h][e];
    if (number < 0) {
      const Edge& old = half(h).body.edges[e];
      number = made_.add_edge(old.curve, vertex(h, old.start), vertex(h, old.end), named(h, old.origin), old.kind);
      made_.edges.back().tolerance = old.tolerance;
    }
    return number;
  }

  // A loop of a half as it bounds the wall: that of the inner one is turned.
  std::vector<Body::Use> uses_of(int h, int loop) {
    std::vector<Body::Use> uses;
    for (const int c : half(h).body.loops[loop].coedges) {
      const Coedge& use = half(h).body.coedges[c];
      uses.push_back({edge(h, use.edge), use.forward != (h == 1), use.image});
    }
    if (h == 1) std::reverse(uses.begin(), uses.end());
    return uses;
  }

  void add_wall(int h, int f) {
    const Face& old = half(h).body.faces[f];
    const int face = made_.add_face(old.surface, old.forward != (h == 1), named(h, old.origin), old.trimmed);
    for (const int l : old.loops) made_.add_loop(face, uses_of(h, l));
    halves_.push_back(h);
  }

  // The ends of an outer edge beside the inner one on it, with their images for one use of it.
  std::vector<Body::Use> ends_of(int e, const Curve2Ptr& image, bool forward) {
    const Edge& out = outer_.body.edges[e];
    struct Place {
      double t;
      int half, vertex;
      bool operator==(const Place& other) const { return half == other.half && vertex == other.vertex; }
    };
    const Interval range = out.curve->domain();
    std::vector<Place> places{{range.lo, 0, out.start}, {range.hi, 0, out.end}};
    for (const int k : cut_[e]) {
      const Edge& in = inner_.body.edges[k];
      if (in.start == in.end) return {};  // all of a closed edge
      for (const int v : {in.start, in.end}) {
        const Vec3 p = inner_.body.vertices[v].point;
        Place place{project(p, *out.curve).foot_points.front().t, 1, v};
        for (const auto& [end, own] : {std::pair(range.lo, out.start), std::pair(range.hi, out.end)})
          if (glm::length(outer_.body.vertices[own].point - p) <= 1e-11 * size_) place = {end, 0, own};
        places.push_back(place);
      }
    }
    std::stable_sort(places.begin(), places.end(), [](const Place& x, const Place& y) { return x.t < y.t; });
    std::vector<Body::Use> uses;
    for (size_t k = 0; k + 1 < places.size(); k += 2) {
      const double from = places[k].t, to = places[k + 1].t;
      if (places[k] == places[k + 1] || !(to > from)) continue;
      const int a = vertex(places[k].half, places[k].vertex), b = vertex(places[k + 1].half, places[k + 1].vertex);
      int& number = ends_[{a, b}];
      if (number == 0)
        number = 1 + made_.add_edge(trimmed_curve(out.curve, from, to, false), a, b, Origin{"", "rim", rims_++});
      uses.push_back({number - 1, forward, trimmed_curve(image, from, to, false)});
    }
    return uses;
  }

  void add_rim(int source) {
    std::vector<Body::Use> uses;
    const Face* of = nullptr;
    std::optional<Frame> plane;
    for (const int h : {0, 1})
      for (size_t f = 0; f < half(h).body.faces.size(); ++f) {
        if (half(h).source[f] != source) continue;
        const Face& face = half(h).body.faces[f];
        if (!of) of = &face, plane = plane_of(face.surface);
        for (const int l : face.loops)
          for (const int c : half(h).body.loops[l].coedges) {
            const Coedge& use = half(h).body.coedges[c];
            const Curve2Ptr image = plane ? image_in(*plane, half(h).body.edges[use.edge].curve) : use.image;
            if (!is_between_opened(h, use.edge))
              uses.push_back({edge(h, use.edge), use.forward != (h == 1), image});
            else if (h == 0 && cut_[use.edge].empty())
              uses.push_back({edge(h, use.edge), use.forward, image});
            else if (h == 0)
              for (const Body::Use& end : ends_of(use.edge, image, use.forward)) uses.push_back(end);
          }
      }
    if (uses.empty()) return;
    add_rim_faces(*of, plane, chained(std::move(uses)));
  }

  int begin_of(const Body::Use& u) const { return u.forward ? made_.edges[u.edge].start : made_.edges[u.edge].end; }
  int end_of(const Body::Use& u) const { return u.forward ? made_.edges[u.edge].end : made_.edges[u.edge].start; }

  std::vector<std::vector<Body::Use>> chained(std::vector<Body::Use> uses) const {
    std::vector<std::vector<Body::Use>> loops;
    while (!uses.empty()) {
      std::vector<Body::Use> loop{uses.front()};
      uses.erase(uses.begin());
      while (end_of(loop.back()) != begin_of(loop.front())) {
        const auto next = std::find_if(uses.begin(), uses.end(), [&](const Body::Use& u) {
          return begin_of(u) == end_of(loop.back()) && joins(loop.back(), u);
        });
        if (next == uses.end())
          throw FieldError("open", "the rim of an opened face does not close", "open its neighbours too, or less");
        loop.push_back(*next);
        uses.erase(next);
      }
      loops.push_back(std::move(loop));
    }
    return loops;
  }

  static bool joins(const Body::Use& a, const Body::Use& b) {
    const Interval s = a.image->domain(), t = b.image->domain();
    const Vec3 p = a.image->point(a.forward ? s.hi : s.lo), q = b.image->point(b.forward ? t.lo : t.hi);
    return glm::length(p - q) <= 1e-7 * (1 + glm::length(p));
  }

  // Each loop that has the rim inside is a face; the hole of an opening belongs to the one around it.
  void add_rim_faces(const Face& of, const std::optional<Frame>& plane, std::vector<std::vector<Body::Use>> loops) {
    const bool forward = plane ? outward_side(of) > 0 : of.forward;
    const double side = forward == (plane || of.surface->normal_sign() > 0) ? 1 : -1;
    std::vector<std::vector<std::vector<Body::Use>>> faces;
    std::vector<std::vector<Body::Use>> holes;
    for (auto& loop : loops) {
      if (side * area_of_loop(loop) > 0)
        faces.push_back({std::move(loop)});
      else
        holes.push_back(std::move(loop));
    }
    for (auto& hole : holes) {
      const Vec3 p = hole[0].image->point(hole[0].image->domain().lo);
      // The innermost: rims lie within each other where the walls fall apart.
      auto around = faces.end();
      for (auto one = faces.begin(); one != faces.end(); ++one)
        if (box_of((*one)[0]).contains(p) &&
            (around == faces.end() || box_of((*one)[0]).diameter() < box_of((*around)[0]).diameter()))
          around = one;
      if (around == faces.end())
        throw FieldError("thickness", "the walls are too thick: nothing is left of the rim", "thinner walls");
      around->push_back(std::move(hole));
    }
    for (size_t k = 0; k < faces.size(); ++k) {
      std::vector<CurvePtr> images;
      for (const auto& loop : faces[k])
        for (const Body::Use& u : loop) images.push_back(u.image);
      Origin origin = of.origin;
      if (faces.size() > 1) {
        origin.feature = origin.text();
        origin.role = "part";
        origin.index = static_cast<int>(k);
      }
      const int face = plane ? add_plane_face(made_, *plane, forward, origin, images)
                             : made_.add_face(of.surface, forward, origin, true);
      for (const auto& loop : faces[k]) made_.add_loop(face, loop);
      halves_.push_back(0);
    }
  }

  static Box3 box_of(const std::vector<Body::Use>& loop) {
    Box3 box;
    for (const Body::Use& u : loop) box.include(bounds(*u.image));
    return box.inflated(1e-9 * box.diameter());
  }

  void add_shells() {
    if (std::any_of(opened_.begin(), opened_.end(), [](char open) { return open != 0; })) return divide_shells(made_);
    made_.shells.resize(2);
    for (size_t f = 0; f < made_.faces.size(); ++f) {
      made_.faces[f].shell = halves_[f];
      made_.shells[halves_[f]].faces.push_back(static_cast<int>(f));
    }
  }

  const Half &outer_, &inner_;
  const std::vector<char>& opened_;
  double size_;
  std::vector<std::vector<int>> cut_;  // of each outer edge, the inner ones on it
  std::vector<int> vertices_[2], edges_[2], halves_;
  std::map<std::pair<int, int>, int> ends_;  // 1 + the edge
  int rims_ = 0;
  Body made_;
};

Body shell(const Fields& f) {
  const Body& body = *f.body("of");
  if (!body.is_closed() || body.shells.size() != 1)
    throw FieldError("of", "the body is open, or hollow already", "a closed body of one shell");
  std::vector<char> opened(body.faces.size(), 0);
  for (const int k : faces_named(body, f, "open")) opened[k] = 1;
  if (std::all_of(opened.begin(), opened.end(), [](char open) { return open != 0; }))
    throw FieldError("open", "no face is left to be a wall", "open fewer");
  const bool inward = f.text("side") == "inward";
  const double h = f.number("thickness");
  std::vector<double> distances;
  for (const char open : opened) distances.push_back(open ? 0 : inward ? -h : h);
  FaceReplacement moved = offset_of_body(body, distances, "thickness", "thinner walls");
  Half old{without_plane_seams(body), {}}, made{std::move(moved.body), std::move(moved.faces)};
  for (size_t k = 0; k < body.faces.size(); ++k) old.source.push_back(static_cast<int>(k));
  FaceReplacement result;
  result.body = (inward ? Walls(old, made, opened) : Walls(made, old, opened)).build();
  check_replacement(result, "thickness", "thinner walls, or other faces opened");
  return std::move(result.body);
}

}  // namespace

TypeDeclaration shell_body_type() {
  return declare(Category::body, "shell_body",
                 "Thin-walled body: the walls of another, some of whose faces are opened. Faces outside keep their "
                 "names, those inside are called inner and the name; the rim of an opening has the opened face's name.")
      .example("of: { type: box, size: [6, 4, 3] }, thickness: 0.2, open: z_max")
      .field("of", reference({Category::body}), "the body; closed, without voids")
      .field("thickness", length().positive(), "of the walls")
      .field("open", texts(), "names or numbers of the faces that are left open; none: a hollow body", "[]")
      .field("side", choice({"inward", "outward"}), "where the walls stand: inside of the body's faces, or outside",
             "inward")
      .built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(shell(f)); });
}

}  // namespace lekalo::geometry
