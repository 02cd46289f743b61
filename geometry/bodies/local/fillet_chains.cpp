#include "geometry/bodies/local/fillet_chains.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "geometry/bodies/local/corners.h"
#include "geometry/bodies/local/support.h"
#include "geometry/bodies/topology/edge_selection.h"
#include "geometry/queries/differential/curvature.h"

namespace lekalo::geometry {

namespace {

constexpr double kSame = 1e-6;    // of curvatures, relative
constexpr double kAlong = 1e-6;   // of 1 - cos: a section, not a border
constexpr double kTurned = 1e-6;  // sine of the angle between the faces beside a fillet

enum class Shape { none, band, sphere };

// What a face's curvatures say of it.
struct Rounding {
  Shape shape = Shape::none;
  double curvature = 0;  // against the outward normal: positive where convex
};

class Recognition {
 public:
  explicit Recognition(const Body& body) : body_(body), parent_(body.faces.size()) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (size_t f = 0; f < body.faces.size(); ++f) roundings_.push_back(rounding_of(static_cast<int>(f)));
    for (size_t f = 0; f < body.faces.size(); ++f) between_.push_back(faces_beside_band(static_cast<int>(f)));
    for (size_t e = 0; e < body.edges.size(); ++e) join(static_cast<int>(e));
  }

  std::vector<FilletChain> chains() {
    std::vector<FilletChain> result;
    std::vector<int> number(body_.faces.size(), -1);
    for (size_t f = 0; f < body_.faces.size(); ++f) {
      if (!between_[f]) continue;
      int& n = number[root(static_cast<int>(f))];
      if (n < 0) {
        n = static_cast<int>(result.size());
        result.push_back({1 / std::abs(roundings_[f].curvature), roundings_[f].curvature > 0, {}, {}, {}});
      }
      result[n].faces.push_back(static_cast<int>(f));
      result[n].between.push_back(*between_[f]);
    }
    for (size_t f = 0; f < body_.faces.size(); ++f)
      if (const int n = number[root(static_cast<int>(f))]; n >= 0 && roundings_[f].shape == Shape::sphere)
        result[n].corners.push_back(static_cast<int>(f));
    return result;
  }

 private:
  SurfaceCurvature curvature_at(int f, const Vec2& uv) const {
    return geometry::curvature(*body_.faces[f].surface, uv.x, uv.y);
  }

  Rounding rounding_of(int f) const {
    std::vector<std::array<double, 2>> found;
    const auto look = [&](const Vec2& uv) {
      const SurfaceCurvature c = curvature_at(f, uv);
      if (c.regular) found.push_back({c.principal[0], c.principal[1]});
    };
    look(middle_of_face(body_, f));
    for (const int l : body_.faces[f].loops)
      for (const int c : body_.loops[l].coedges) {
        const Curve& image = *body_.coedges[c].image;
        for (const double share : {0.1, 0.5, 0.8})
          look(Vec2(image.point(image.domain().lo + share * image.domain().width())));
      }
    if (found.empty()) return {};
    // Normals of surfaces may look inward.
    const double side = body_.faces[f].forward ? -1 : 1;
    const auto is_everywhere = [&](double k) {
      return std::all_of(found.begin(), found.end(), [&](const auto& one) {
        return std::min(std::abs(one[0] - k), std::abs(one[1] - k)) <= kSame * std::abs(k);
      });
    };
    for (const double k : found.front()) {
      if (k == 0 || !is_everywhere(k)) continue;
      const bool is_sphere = std::all_of(found.begin(), found.end(), [&](const auto& one) {
        return std::max(std::abs(one[0] - k), std::abs(one[1] - k)) <= kSame * std::abs(k);
      });
      return {is_sphere ? Shape::sphere : Shape::band, side * k};
    }
    return {};
  }

  bool is_smooth(int edge) const {
    const Edge& e = body_.edges[edge];
    return e.kind == EdgeKind::regular && e.coedges.size() == 2 && !is_sharp(body_, edge);
  }

  // Of a smooth edge and the circles of a band that it crosses: the least and the largest cosine between them.
  Interval cosines(int f, int coedge) const {
    const Coedge& use = body_.coedges[coedge];
    const Curve& curve = *body_.edges[use.edge].curve;
    const double k = std::abs(roundings_[f].curvature);
    Interval found{1, 0};
    for (const double share : {0.2, 0.5, 0.9}) {
      const double t = curve.domain().lo + share * curve.domain().width();
      const SurfaceCurvature c = curvature_at(f, Vec2(use.image->point(t)));
      if (!c.regular) continue;
      const int i = std::abs(std::abs(c.principal[0]) - k) <= std::abs(std::abs(c.principal[1]) - k) ? 0 : 1;
      const double cosine = std::abs(glm::dot(glm::normalize(curve.evaluate(t, 1).d[1]), c.directions[i]));
      found = {std::min(found.lo, cosine), std::max(found.hi, cosine)};
    }
    return found;
  }
  bool is_section(int f, int coedge) const { return cosines(f, coedge).lo > 1 - kAlong; }

  // A fillet beside the face, not one that the face itself is: its circle is the smaller one.
  bool is_rounding_of(int other, int f, int coedge) const {
    return roundings_[other].shape == Shape::band &&
           std::abs(roundings_[other].curvature) > (1 + kSame) * std::abs(roundings_[f].curvature) &&
           cosines(f, coedge).hi > kTurned;
  }

  Vec3 normal_at(int coedge) const {
    const Coedge& use = body_.coedges[coedge];
    const Vec2 uv(use.image->point(use.image->domain().middle()));
    return body_.normal(face_of_coedge(body_, coedge), uv.x, uv.y);
  }

  // The faces with which a band is smooth on both sides; nothing where it is no fillet.
  std::optional<std::array<int, 2>> faces_beside_band(int f) const {
    if (roundings_[f].shape != Shape::band) return std::nullopt;
    std::vector<int> faces;
    std::vector<Vec3> normals;
    for (const int l : body_.faces[f].loops)
      for (const int c : body_.loops[l].coedges) {
        if (!is_smooth(body_.coedges[c].edge) || is_section(f, c)) continue;
        const int other = face_of_coedge(body_, coedge_partner(body_, c));
        if (other == f || is_rounding_of(other, f, c) || std::find(faces.begin(), faces.end(), other) != faces.end())
          continue;
        faces.push_back(other), normals.push_back(normal_at(c));
      }
    if (faces.size() != 2 || glm::length(glm::cross(normals[0], normals[1])) < kTurned) return std::nullopt;
    return std::array{faces[0], faces[1]};
  }

  bool are_alike(int f, int g) const {
    return std::abs(roundings_[f].curvature - roundings_[g].curvature) <= kSame * std::abs(roundings_[f].curvature);
  }

  // Bands that go on in each other, or in a sphere.
  void join(int edge) {
    if (!is_smooth(edge)) return;
    const std::vector<int>& uses = body_.edges[edge].coedges;
    const int f = face_of_coedge(body_, uses[0]), g = face_of_coedge(body_, uses[1]);
    const auto goes_on = [&](int face, int coedge) {
      return roundings_[face].shape == Shape::sphere || (between_[face] && is_section(face, coedge));
    };
    if (f == g || !(between_[f] || between_[g]) || !are_alike(f, g)) return;
    if (goes_on(f, uses[0]) && goes_on(g, uses[1])) parent_[std::max(root(f), root(g))] = std::min(root(f), root(g));
  }
  int root(int f) const { return parent_[f] == f ? f : root(parent_[f]); }

  const Body& body_;
  std::vector<int> parent_;
  std::vector<Rounding> roundings_;
  std::vector<std::optional<std::array<int, 2>>> between_;
};

}  // namespace

std::vector<FilletChain> fillet_chains(const Body& body) { return Recognition(body).chains(); }

}  // namespace lekalo::geometry
