#include "geometry/bodies/booleans/gluing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "geometry/bodies/booleans/boolean.h"
#include "geometry/bodies/topology/characteristics.h"
#include "geometry/queries/differential/curvature.h"

namespace lekalo::geometry {

namespace {

// Half-planes nearer to each other, in radians, are one.
constexpr double kSameAngle = 1e-6;

// One use of a strand by a piece.
struct Use {
  int piece, loop, number;
};

class Gluing {
 public:
  Gluing(const std::vector<FacePiece>& pieces, const Imprint& imprint) : pieces_(pieces), imprint_(imprint) {}

  Body body() {
    for (size_t p = 0; p < pieces_.size(); ++p)
      for (size_t l = 0; l < pieces_[p].loops.size(); ++l)
        for (size_t k = 0; k < pieces_[p].loops[l].size(); ++k)
          uses_[pieces_[p].loops[l][k].strand].push_back(
              {static_cast<int>(p), static_cast<int>(l), static_cast<int>(k)});
    make_edges();
    make_vertices();
    make_faces();
    divide_shells(body_);
    set_tolerances();
    return std::move(body_);
  }

 private:
  const DirectedCurve& curve(const Use& use) const { return pieces_[use.piece].loops[use.loop][use.number]; }
  int& edge_of(const Use& use) { return edge_of_use_[use.piece][use.loop][use.number]; }

  // The strand runs along the loop of the face, which has it on its left against its normal.
  bool runs_forward(const Use& use) const {
    return curve(use).forward == (side_of(piece_face(pieces_[use.piece])) > 0);
  }
  static Face piece_face(const FacePiece& piece) {
    Face face;
    face.surface = piece.surface;
    face.forward = piece.forward;
    return face;
  }

  void make_edges() {
    for (const FacePiece& piece : pieces_) {
      edge_of_use_.emplace_back();
      for (const auto& loop : piece.loops) edge_of_use_.back().emplace_back(loop.size(), -1);
    }
    for (auto& [strand, uses] : uses_) {
      const Strand& of = imprint_.strands[strand];
      const auto add = [&] {
        edge_strand_.push_back(strand);
        return body_.add_edge(of.curve, -1, -1, of.origin, of.kind);
      };
      if (of.kind == EdgeKind::pole) {
        for (const Use& use : uses) edge_of(use) = add();
        continue;
      }
      if (uses.size() % 2 != 0) throw BooleanError("the faces that are left do not close along an edge", middle(of));
      for (const auto& [a, b] : pairs(of, uses)) {
        if (runs_forward(a) == runs_forward(b))
          throw BooleanError("the faces that are left do not fit together along an edge", middle(of));
        const int edge = add();
        edge_of(a) = edge_of(b) = edge;
        body_.edges[edge].kind = a.piece == b.piece ? EdgeKind::seam : EdgeKind::regular;
      }
    }
  }

  static Vec3 middle(const Strand& strand) { return strand.curve->point(strand.curve->domain().middle()); }

  // Neighbours around the edge with material between them.
  std::vector<std::pair<Use, Use>> pairs(const Strand& strand, const std::vector<Use>& uses) const {
    if (uses.size() == 2) return {{uses[0], uses[1]}};
    const double t = strand.curve->domain().lo + 0.4871 * strand.curve->domain().width();
    const CurveJet at = strand.curve->evaluate(t, 1);
    const Frame frame = frame_about(at.d[0], glm::normalize(at.d[1]));
    struct Half {
      Use use;
      double angle;         // counterclockwise about the strand, from the first one's
      double bend;          // how the angle grows with the distance from the strand, twice as fast
      bool material_after;  // counterclockwise about the strand
    };
    double first = 0;
    std::vector<Half> halves;
    for (const Use& use : uses) {
      const FacePiece& piece = pieces_[use.piece];
      const Vec3 uv = curve(use).image->point(t);
      const Vec3 normal = (piece.forward ? 1.0 : -1.0) * piece.surface->normal(uv.x, uv.y);
      const Vec3 along = (runs_forward(use) ? 1.0 : -1.0) * frame.z;
      const Vec3 into = glm::cross(normal, along);  // the face is on the left
      double angle = std::atan2(glm::dot(into, frame.y), glm::dot(into, frame.x));
      if (halves.empty()) first = angle - kSameAngle;
      angle = std::fmod(angle - first + kTwoPi, kTwoPi);
      // Turning counterclockwise goes along z x into; the material is behind the normal.
      const Vec3 onward = glm::cross(frame.z, into);
      const Mat3 bending = shape_operator(curvature(piece.surface->evaluate(uv.x, uv.y, 2), normal));
      const double bend = glm::dot(into, bending * into) * glm::dot(normal, onward);
      halves.push_back({use, angle, bend, glm::dot(onward, normal) < 0});
    }
    std::sort(halves.begin(), halves.end(), [](const Half& a, const Half& b) { return a.angle < b.angle; });
    // Faces that touch along the strand differ in how they bend.
    for (auto begin = halves.begin(); begin != halves.end();) {
      const auto end =
          std::find_if(begin, halves.end(), [&](const Half& half) { return half.angle > begin->angle + kSameAngle; });
      std::sort(begin, end, [](const Half& a, const Half& b) { return a.bend < b.bend; });
      begin = end;
    }
    std::vector<std::pair<Use, Use>> result;
    for (size_t k = 0; k < halves.size(); ++k) {
      const Half& next = halves[(k + 1) % halves.size()];
      if (!halves[k].material_after) continue;
      if (next.material_after) throw BooleanError("faces that touch along an edge are not told apart", at.d[0]);
      result.emplace_back(halves[k].use, next.use);
    }
    if (2 * result.size() != halves.size())
      throw BooleanError("faces that touch along an edge are not told apart", at.d[0]);
    return result;
  }

  // A corner of a loop, between two of its curves, joins two edge ends; those that are joined share a vertex.
  void make_vertices() {
    const size_t edges = body_.edges.size();
    std::vector<int> root(2 * edges);
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int k) {
      while (root[k] != k) k = root[k] = root[root[k]];
      return k;
    };
    const auto end_of = [&](const Use& use, bool last) {
      return 2 * edge_of(use) + (curve(use).forward == last ? 1 : 0);
    };
    for (size_t p = 0; p < pieces_.size(); ++p)
      for (size_t l = 0; l < pieces_[p].loops.size(); ++l) {
        const size_t count = pieces_[p].loops[l].size();
        for (size_t k = 0; k < count; ++k) {
          const Use here{static_cast<int>(p), static_cast<int>(l), static_cast<int>(k)},
              next{here.piece, here.loop, static_cast<int>((k + 1) % count)};
          root[find(end_of(here, true))] = find(end_of(next, false));
        }
      }
    // A pole edge begins where it ends.
    for (size_t e = 0; e < edges; ++e)
      if (body_.edges[e].kind == EdgeKind::pole)
        root[find(static_cast<int>(2 * e))] = find(static_cast<int>(2 * e + 1));
    std::map<int, int> vertex_of;
    const auto vertex = [&](size_t end, int point) {
      const auto [found, is_new] = vertex_of.try_emplace(find(static_cast<int>(end)), 0);
      if (is_new) found->second = body_.add_vertex(imprint_.points[point], imprint_.origins[point]);
      return found->second;
    };
    for (size_t e = 0; e < edges; ++e) {
      const Strand& strand = imprint_.strands[edge_strand_[e]];
      body_.edges[e].start = vertex(2 * e, strand.from);
      body_.edges[e].end = vertex(2 * e + 1, strand.to);
    }
  }

  void make_faces() {
    for (size_t p = 0; p < pieces_.size(); ++p) {
      const FacePiece& piece = pieces_[p];
      const int face = body_.add_face(piece.surface, piece.forward, piece.origin);
      for (size_t l = 0; l < piece.loops.size(); ++l) {
        std::vector<Body::Use> loop;
        for (size_t k = 0; k < piece.loops[l].size(); ++k) {
          const Use use{static_cast<int>(p), static_cast<int>(l), static_cast<int>(k)};
          loop.push_back({edge_of(use), runs_forward(use), curve(use).image});
        }
        if (side_of(body_.faces[face]) < 0) std::reverse(loop.begin(), loop.end());
        body_.add_loop(face, loop);
      }
    }
  }

  // How far curves are from their images, and from the vertices.
  void set_tolerances() {
    for (size_t e = 0; e < body_.edges.size(); ++e) {
      Edge& edge = body_.edges[e];
      if (edge.kind == EdgeKind::pole) continue;
      const Interval t = edge.curve->domain();
      for (const bool last : {false, true}) {
        Vertex& vertex = body_.vertices[last ? edge.end : edge.start];
        vertex.tolerance =
            std::max(vertex.tolerance, glm::length(edge.curve->point(last ? t.hi : t.lo) - vertex.point));
      }
      double worst = 0;
      for (const int c : edge.coedges) {
        const Face& face = body_.faces[body_.loops[body_.coedges[c].loop].face];
        constexpr int kPlaces = 33;
        for (int k = 0; k <= kPlaces; ++k) {
          const double at = t.lo + t.width() * k / kPlaces;
          const Vec3 uv = body_.coedges[c].image->point(at);
          worst = std::max(worst, glm::length(face.surface->point(uv.x, uv.y) - edge.curve->point(at)));
        }
      }
      if (worst > imprint_.tolerance)
        throw BooleanError("an edge is found with less accuracy than bodies need", edge.curve->point(t.middle()));
      edge.tolerance = 2 * worst;
    }
  }

  const std::vector<FacePiece>& pieces_;
  const Imprint& imprint_;
  std::map<int, std::vector<Use>> uses_;
  std::vector<std::vector<std::vector<int>>> edge_of_use_;
  std::vector<int> edge_strand_;
  Body body_;
};

}  // namespace

Body glued(const std::vector<FacePiece>& pieces, const Imprint& imprint) { return Gluing(pieces, imprint).body(); }

}  // namespace lekalo::geometry
