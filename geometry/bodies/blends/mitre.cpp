// Bands that meet in edges at a corner of three faces (Golovanov 2016, figure 6.9.5).
//
// Two borders meet in a point of each face between two bands. Two bands then go on to the third edge, together or,
// where one reaches farther, this one alone: it cuts the third face. Three bands end in a common point.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "geometry/bodies/blends/crossing.h"
#include "geometry/bodies/blends/supports.h"
#include "geometry/bodies/blends/surgery.h"
#include "geometry/bodies/topology/entity_names.h"

namespace lekalo::geometry {

namespace {

// A point of two bands.
struct Shared {
  std::array<BandOnCurve, 2> on;
  int vertex = -1;
};

Eigen::Vector3d column(const Vec3& v) { return {v.x, v.y, v.z}; }

class Corner {
 public:
  Corner(Surgery& surgery, const Fan& fan) : surgery_(surgery), body_(surgery.body), fan_(fan) {}

  void meet_two() {
    const HalfEdge &a = half(0), &b = half(1), &rib = half(2);
    const Shared v = borders_meet(0, 1);
    const BandOnCurve of_a = border_on_rib(a, side_before(a), rib), of_b = border_on_rib(b, side_after(b), rib);
    const double from = parameter_of(body_, rib);
    const double far_a = std::abs(of_a.t - from), far_b = std::abs(of_b.t - from);
    const bool together = glm::length(of_a.point - of_b.point) <= 1e-9 * surgery_.size;
    const bool is_a = together || far_a > far_b;
    const int end = surgery_.draft.add_vertex(is_a ? of_a.point : of_b.point);
    surgery_.trim(rib, is_a ? of_a.t : of_b.t, end, is_a ? a.edge : b.edge);
    if (together) {
      const int edge = add_mitre(0, 1, v, {{of_a, of_b}, end});
      surgery_.end_border(a, side_before(a), of_a.s, end), surgery_.end_border(b, side_after(b), of_b.s, end);
      finish(a, {{edge, false, nullptr}}), finish(b, {{edge, true, nullptr}});
    } else if (is_a) {
      // The border of b ends on the band of a, which goes on across the face to the third edge.
      const Shared p = border_on_band(1, side_after(b), 0);
      const int mitre_edge = add_mitre(0, 1, v, {{p.on[1], p.on[0]}, p.vertex});
      const int cut = add_cut(a, fan_.faces[1], rib, of_a, end, p.on[1], p.vertex);
      surgery_.corners[rib] = {{cut, true, on_face_}};
      surgery_.end_border(a, side_before(a), of_a.s, end), surgery_.end_border(b, side_after(b), p.on[0].s, p.vertex);
      finish(a, {{cut, true, nullptr}, {mitre_edge, false, nullptr}}), finish(b, {{mitre_edge, true, nullptr}});
    } else {
      const Shared p = border_on_band(0, side_before(a), 1);
      const int mitre_edge = add_mitre(0, 1, v, p);
      const int cut = add_cut(b, fan_.faces[2], rib, of_b, end, p.on[1], p.vertex);
      surgery_.corners[a] = {{cut, false, on_face_}};
      surgery_.end_border(a, side_before(a), p.on[0].s, p.vertex), surgery_.end_border(b, side_after(b), of_b.s, end);
      finish(a, {{mitre_edge, false, nullptr}}), finish(b, {{mitre_edge, true, nullptr}, {cut, false, nullptr}});
    }
  }

  void meet_three() {
    std::array<Shared, 3> on_face;
    for (size_t i = 0; i < 3; ++i) on_face[i] = borders_meet(i, fan_.next(i));
    const std::array<BandOnCurve, 3> tip = common_point();
    const int vertex = surgery_.draft.add_vertex(tip[0].point);
    std::array<int, 3> edges;
    for (size_t i = 0; i < 3; ++i)
      edges[i] = add_mitre(i, fan_.next(i), on_face[i], {{tip[i], tip[fan_.next(i)]}, vertex});
    for (size_t i = 0; i < 3; ++i)
      finish(half(i), {{edges[fan_.before(i)], true, nullptr}, {edges[i], false, nullptr}});
  }

 private:
  const HalfEdge& half(size_t i) const { return fan_.edges[i]; }
  const BlendBand& band(size_t i) const { return surgery_.blends[surgery_.blend_of.at(half(i).edge)].band; }
  double start(size_t i) const { return band(i).ends()[half(i).at_end]; }

  // Of the bands on both sides of a face.
  Shared borders_meet(size_t i, size_t j) {
    const BlendBand &a = band(i), &b = band(j);
    const double za = side_after(half(i)), zb = side_before(half(j));
    Eigen::Vector2d x(start(i), start(j));
    double off = kInfinity;
    for (int k = 0; k < 30; ++k) {
      const BlendBand::Local p = a.at(x(0), za), q = b.at(x(1), zb);
      Eigen::Matrix<double, 3, 2> matrix;
      matrix.col(0) = column(p.ds), matrix.col(1) = column(-q.ds);
      const Eigen::Vector2d step = matrix.colPivHouseholderQr().solve(column(p.point - q.point));
      off = glm::length(p.point - q.point);
      if (!step.allFinite()) break;
      x -= step;
      if ((matrix * step).norm() <= 1e-15 * surgery_.size) break;
    }
    if (!(off <= 1e-10 * surgery_.size))
      throw BlendError(half(i).edge,
                       fmt::format("its border does not meet that of {}", name_of_edge(body_, half(j).edge)));
    const Vec3 point = a.at(x(0), za).point;
    const int vertex = surgery_.draft.add_vertex(point);
    surgery_.end_border(half(i), side_after(half(i)), x(0), vertex);
    surgery_.end_border(half(j), side_before(half(j)), x(1), vertex);
    return {{BandOnCurve{x(0), za, 0, point}, BandOnCurve{x(1), zb, 0, point}}, vertex};
  }

  BandOnCurve border_on_rib(const HalfEdge& of, int side, const HalfEdge& rib) const {
    const BlendBand& band = surgery_.blends[surgery_.blend_of.at(of.edge)].band;
    const double s = band.ends()[of.at_end];
    const auto met = border_on_curve(band, side, *body_.edges[rib.edge].curve, s, start_on(body_, rib, band, s, side));
    if (!met) throw BlendError(of.edge, fmt::format("its border does not meet {}", name_of_edge(body_, rib.edge)));
    return *met;
  }

  // Where the border of band i ends on band j.
  Shared border_on_band(size_t i, int side, size_t j) {
    const BlendBand &a = band(i), &b = band(j);
    const Vec2 near = foot_place_anywhere(b.surface(), a.at(start(i), side).point, b.place(start(j), 0.5));
    const auto met = line_on_surface(a, side, *b.surface(), {start(i), near});
    const double z = met ? b.z_of(met->place) : -1;
    if (!met || z < -1e-9 || z > 1 + 1e-9)
      throw BlendError(half(i).edge,
                       fmt::format("its border does not end on the blend of {}", name_of_edge(body_, half(j).edge)));
    const Vec3 point = a.at(met->s, side).point;
    return {{BandOnCurve{met->s, static_cast<double>(side), 0, point}, BandOnCurve{b.s_of(met->place), z, 0, point}},
            surgery_.draft.add_vertex(point)};
  }

  // The point of all three bands, from the middle of their sections on.
  std::array<BandOnCurve, 3> common_point() const {
    Eigen::Matrix<double, 6, 1> x;
    for (int i = 0; i < 3; ++i) x(2 * i) = start(i), x(2 * i + 1) = 0.5;
    double off = kInfinity;
    for (int k = 0; k < 40; ++k) {
      Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
      Eigen::Matrix<double, 6, 1> value;
      std::array<BlendBand::Local, 3> p;
      for (int i = 0; i < 3; ++i) p[i] = band(i).at(x(2 * i), x(2 * i + 1));
      for (int i = 0; i < 2; ++i) {
        matrix.block<3, 1>(3 * i, 0) = column(p[0].ds), matrix.block<3, 1>(3 * i, 1) = column(p[0].dz);
        matrix.block<3, 1>(3 * i, 2 * i + 2) = column(-p[i + 1].ds);
        matrix.block<3, 1>(3 * i, 2 * i + 3) = column(-p[i + 1].dz);
        value.segment<3>(3 * i) = column(p[0].point - p[i + 1].point);
      }
      off = value.norm();
      const Eigen::Matrix<double, 6, 1> step = matrix.fullPivLu().solve(value);
      if (!step.allFinite()) break;
      x -= step;
      if ((matrix * step).norm() <= 1e-15 * surgery_.size) break;
    }
    std::array<BandOnCurve, 3> result;
    bool is_inside = off <= 1e-10 * surgery_.size;
    for (int i = 0; i < 3; ++i) {
      result[i] = {x(2 * i), x(2 * i + 1), 0, band(i).at(x(2 * i), x(2 * i + 1)).point};
      is_inside = is_inside && result[i].z > 0 && result[i].z < 1;
    }
    if (!is_inside) throw BlendError(half(0).edge, "the blends of the three edges at its end have no point in common");
    return result;
  }

  // From a point on the face between two bands to another of their points; images are kept for `finish`.
  int add_mitre(size_t i, size_t j, const Shared& from, const Shared& to) {
    const BlendBand &a = band(i), &b = band(j);
    const Crossing made =
        crossing(a, b.surface(), {from.on[0], to.on[0]},
                 {b.place(from.on[1].s, from.on[1].z), b.place(to.on[1].s, to.on[1].z)}, surgery_.size, half(i).edge);
    const int edge =
        surgery_.draft.add_edge(made.curve, from.vertex, to.vertex, surgery_.origin(surgery_.blend(half(i)), "mitre"));
    images_[{edge, half(i)}] = made.on_band, images_[{edge, half(j)}] = made.on_face;
    return edge;
  }

  // The band of `of` across a face, from the rib to a point of its own.
  int add_cut(const HalfEdge& of, int face, const HalfEdge& rib, const BandOnCurve& from, int from_vertex,
              const BandOnCurve& to, int to_vertex) {
    EdgeBlend& blend = surgery_.blend(of);
    const SurfacePtr& surface = body_.faces[face].surface;
    const Vec2 begin = place_on(body_, face, rib, from.t), end = foot_place_anywhere(surface, to.point, begin);
    const Crossing made = crossing(blend.band, surface, {from, to}, {begin, end}, surgery_.size, of.edge);
    const int edge = surgery_.draft.add_edge(made.curve, from_vertex, to_vertex, surgery_.origin(blend, "end"));
    images_[{edge, of}] = made.on_band;
    on_face_ = made.on_face;
    return edge;
  }

  void finish(const HalfEdge& of, std::vector<Body::Use> path) {
    for (Body::Use& use : path) use.image = images_.at({use.edge, of});
    surgery_.end_section(of, std::move(path));
  }

  Surgery& surgery_;
  const Body& body_;
  const Fan& fan_;
  std::map<std::pair<int, HalfEdge>, Curve2Ptr> images_;
  Curve2Ptr on_face_;
};

}  // namespace

void Surgery::end_section(const HalfEdge& half, std::vector<Body::Use> path) {
  if (side_before(half) == 1) {
    std::reverse(path.begin(), path.end());
    for (Body::Use& use : path) use.forward = !use.forward;
  }
  blend(half).sections[half.at_end] = std::move(path);
}

void mitre(Surgery& surgery, const Fan& fan) {
  // The edge that stays, if there is one, is the last.
  Fan turned = fan;
  while (std::any_of(turned.edges.begin(), turned.edges.end() - 1,
                     [&](const HalfEdge& half) { return !surgery.is_blended(half); })) {
    std::rotate(turned.edges.begin(), turned.edges.begin() + 1, turned.edges.end());
    std::rotate(turned.faces.begin(), turned.faces.begin() + 1, turned.faces.end());
  }
  Corner corner(surgery, turned);
  if (surgery.is_blended(turned.edges.back()))
    corner.meet_three();
  else
    corner.meet_two();
}

}  // namespace lekalo::geometry
