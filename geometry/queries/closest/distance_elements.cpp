#include "geometry/queries/closest/distance_elements.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/curves/operations/parameter_line.h"
#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/queries/closest/face_adjacency.h"
#include "geometry/queries/closest/unbounded_surfaces.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Places along an edge that is one point.
constexpr int kPlacesOfPole = 32;

class Gathering {
 public:
  explicit Gathering(DistanceElements& elements) : elements_(elements) {}

  void add_point(const DistancePlace& place, std::function<std::vector<DistanceStep>()> steps) {
    auto element = std::make_unique<DistanceElement>();
    element->place = place;
    element->box.include(place.point);
    if (steps) element->steps = [steps](const std::array<double, 2>&) { return steps(); };
    elements_.push_back(std::move(element));
  }

  // The smooth pieces of a curve of its own, with its kinks and, where it is open, ends.
  void add_curve(const CurvePtr& curve) {
    const std::vector<DistanceElement*> pieces = add_pieces(curve, {.kind = DistancePlace::Kind::curve});
    const double width = curve->domain().width();
    const bool closed =
        curve->is_closed() || (curve->period() > 0 && std::abs(curve->period() - width) <= kDomainSlack * width);
    bool any = false;
    for (size_t k = 0; k <= pieces.size(); ++k) {
      DistanceElement* before = k > 0 ? pieces[k - 1] : closed ? pieces.back() : nullptr;
      DistanceElement* behind = k < pieces.size() ? pieces[k] : nullptr;
      // The seam comes last. A smooth one is an element only if there is no other: all places on a closed plane curve
      // may be as near to a plane, and one of them must be among the points.
      if (closed && k == 0) continue;
      if (closed && k == pieces.size()) behind = pieces[0];
      const bool sharp = is_sharp(before, behind);
      if (!sharp && !(closed && k == pieces.size() && !any)) continue;
      any = true;
      if (before) before->ends_hi[0] = sharp;
      if (behind) behind->ends_lo[0] = sharp;
      DistancePlace place{.kind = DistancePlace::Kind::curve};
      place.t = behind ? behind->domain[0].lo : before->domain[0].hi;
      place.point = curve->point(place.t);
      add_point(place, [before, behind] { return along(before, behind); });
    }
  }

  // Where the domain does not reach its `borders` the surface goes on.
  void add_surface(const SurfacePtr& surface, const Rectangle& borders) {
    const auto sheet = std::make_shared<FaceAdjacency>();
    sheet->surface = surface;
    const DistancePlace place{.kind = DistancePlace::Kind::surface};
    add_patches(*sheet, place, surface->domain());
    add_lines(sheet, place, surface->domain(), borders);
  }

  void add_body(const Body& body) {
    for (int face = 0; face < static_cast<int>(body.faces.size()); ++face) add_face(body, face);
    std::vector<std::vector<DistanceElement*>> edges(body.edges.size());
    for (int index = 0; index < static_cast<int>(body.edges.size()); ++index)
      if (body.edges[index].kind != EdgeKind::pole) edges[index] = add_edge(body, index);
    for (int index = 0; index < static_cast<int>(body.vertices.size()); ++index) add_vertex(body, index, edges);
  }

 private:
  static std::vector<DistanceStep> along(const DistanceElement* before, const DistanceElement* behind) {
    std::vector<DistanceStep> steps;
    if (before) steps.push_back({before, {before->domain[0].hi}, {-1}});
    if (behind) steps.push_back({behind, {behind->domain[0].lo}, {1}});
    return steps;
  }

  static bool is_sharp(const DistanceElement* before, const DistanceElement* behind) {
    if (!before || !behind) return true;
    const Vec3 a = before->jet({before->domain[0].hi}).first[0], b = behind->jet({behind->domain[0].lo}).first[0];
    const double lengths = glm::length(a) * glm::length(b);
    return !(glm::length(a * glm::length(b) - b * glm::length(a)) <= kSharp * lengths) || !(lengths > 0);
  }

  std::vector<DistanceElement*> add_pieces(const CurvePtr& curve, const DistancePlace& place) {
    std::vector<DistanceElement*> result;
    for (const CurvePiece& piece : smooth_pieces(*curve)) {
      auto element = std::make_unique<DistanceElement>();
      element->dimension = 1;
      element->domain[0] = piece.domain;
      element->scale[0] = curve->domain().width();
      element->place = place;
      element->curve = curve;
      element->box = curve->enclose(piece.domain, 0).d[0];
      Box3 hull;
      if (piece.is_rational() && control_point_box(piece.points, hull)) element->box = hull;
      element->flat = is_straight(piece, *curve, *element);
      result.push_back(element.get());
      elements_.push_back(std::move(element));
    }
    return result;
  }

  // The patches of a sheet inside of `cut`.
  void add_patches(FaceAdjacency& sheet, const DistancePlace& place, const Rectangle& cut) {
    std::vector<SurfacePiece> pieces = smooth_pieces(*sheet.surface);
    if (pieces.empty()) pieces.push_back({cut, {}, {}, 0, 0, {}});
    sheet.scale = {cut.u.width(), cut.v.width()};
    for (SurfacePiece& piece : pieces) {
      const Rectangle within{intersect(piece.domain.u, cut.u), intersect(piece.domain.v, cut.v)};
      if (!(within.u.width() > 0) || !(within.v.width() > 0)) continue;
      auto element = std::make_unique<DistanceElement>();
      element->dimension = 2;
      element->box = sheet.surface->enclose(within, 0).d(0, 0);
      if (piece.is_rational() && within.u == piece.domain.u && within.v == piece.domain.v)
        element->box = bounds(*sheet.surface, piece);
      piece.domain = within;
      element->domain = {within.u, within.v};
      element->scale = sheet.scale;
      element->place = place;
      element->surface = sheet.surface;
      element->trim = sheet.trim;
      element->flat = is_plane(piece, *sheet.surface, *element);
      sheet.patches.push_back(element.get());
      elements_.push_back(std::move(element));
    }
  }

  // Borders of the domain (of a face they are edges), creases inside, corners and poles.
  void add_lines(const std::shared_ptr<FaceAdjacency>& sheet, const DistancePlace& place, const Rectangle& domain,
                 const Rectangle& borders) {
    const bool is_face = place.kind == DistancePlace::Kind::face;
    const Surface& surface = *sheet->surface;
    Box3 box;
    for (const DistanceElement* patch : sheet->patches) box.include(patch->box);
    std::array<std::vector<double>, 2> lines, poles;
    for (const int i : {0, 1}) {
      const Interval range = i == 0 ? domain.u : domain.v;
      for (const double at : sheet->sharp_places(i, domain, borders)) {
        sheet->mark(i, at);
        const bool border = at == range.lo || at == range.hi;
        if (border && is_face) continue;
        const ParameterLine line(sheet->surface, i == 0 ? IsoDirection::u : IsoDirection::v, at);
        const bool pole = border && bounds(line).diameter() <= kCollapsedEdge * box.diameter();
        (pole ? poles : lines)[i].push_back(at);
      }
    }
    for (const int i : {0, 1}) {
      for (const double at : lines[i]) add_line(sheet, place, i, at, poles[1 - i]);
      for (const double at : poles[i]) add_pole(sheet, place, i, at, i == 0 ? domain.v : domain.u);
    }
    for (const double u : lines[0])
      for (const double v : lines[1]) {
        if (sheet->trim && !sheet->trim->contains(u, v)) continue;
        DistancePlace corner = place;
        corner.u = u, corner.v = v, corner.point = surface.point(u, v);
        add_point(corner, [sheet, u, v] {
          std::vector<DistanceStep> steps;
          sheet->add_all_around({u, v}, steps);
          return steps;
        });
      }
  }

  void add_line(const std::shared_ptr<FaceAdjacency>& sheet, const DistancePlace& place, int i, double at,
                const std::vector<double>& poles) {
    const auto line = std::make_shared<ParameterLine>(sheet->surface, i == 0 ? IsoDirection::u : IsoDirection::v, at);
    for (DistanceElement* element : add_pieces(line, place)) {
      (i == 0 ? element->held_u : element->held_v) = at;
      element->trim = sheet->trim;
      // Its ends and kinks are corners, which are marked on the patches beside it.
      for (const DistanceElement* patch : sheet->patches) {
        if (patch->domain[1 - i].lo == element->domain[0].lo) element->ends_lo[0] |= patch->ends_lo[1 - i];
        if (patch->domain[1 - i].hi == element->domain[0].hi) element->ends_hi[0] |= patch->ends_hi[1 - i];
      }
      for (const double pole : poles) {
        element->ends_lo[0] |= element->domain[0].lo == pole;
        element->ends_hi[0] |= element->domain[0].hi == pole;
      }
      element->steps = [sheet, i, at](const std::array<double, 2>& t) {
        std::vector<DistanceStep> steps;
        for (const double side : {1.0, -1.0}) {
          const auto one = i == 0 ? sheet->step({at, t[0]}, {side, 0}) : sheet->step({t[0], at}, {0, side});
          if (one) steps.push_back(*one);
        }
        return steps;
      };
    }
  }

  void add_pole(const std::shared_ptr<FaceAdjacency>& sheet, const DistancePlace& place, int i, double at,
                const Interval& along) {
    DistancePlace pole = place;
    (i == 0 ? pole.u : pole.v) = at;
    (i == 0 ? pole.v : pole.u) = along.lo;
    pole.point = sheet->surface->point(pole.u, pole.v);
    add_point(pole, [sheet, i, at, along] {
      std::vector<DistanceStep> steps;
      for (int k = 0; k <= kPlacesOfPole; ++k) {
        const double t = along.lo + along.width() * k / kPlacesOfPole;
        for (const double side : {1.0, -1.0}) {
          const auto one = i == 0 ? sheet->step({at, t}, {side, 0}) : sheet->step({t, at}, {0, side});
          if (one) steps.push_back(*one);
        }
      }
      return steps;
    });
  }

  void add_face(const Body& body, int index) {
    const Face& face = body.faces[index];
    const auto sheet = std::make_shared<FaceAdjacency>();
    sheet->surface = face.surface;
    sheet->trim = trim_of(body, index);
    Rectangle cut = face.surface->domain();
    const Periods periods = face.surface->periods();
    if (sheet->trim) {
      // Ranges are a rounding error wide; in a periodic direction loops may lie whole periods away.
      if (periods.u == 0) cut.u = intersect(cut.u, sheet->trim->u_range());
      if (periods.v == 0) cut.v = intersect(cut.v, sheet->trim->v_range());
    }
    const DistancePlace place{.kind = DistancePlace::Kind::face, .index = index};
    add_patches(*sheet, place, cut);
    add_lines(sheet, place, cut, cut);
    sheets_.push_back(sheet);
  }

  const std::shared_ptr<FaceAdjacency>& sheet_of(const Body& body, int coedge) const {
    return sheets_[body.loops[body.coedges[coedge].loop].face];
  }

  std::vector<DistanceElement*> add_edge(const Body& body, int index) {
    const Edge& edge = body.edges[index];
    std::vector<std::pair<std::shared_ptr<FaceAdjacency>, Curve2Ptr>> images;
    for (const int coedge : edge.coedges) images.emplace_back(sheet_of(body, coedge), body.coedges[coedge].image);
    const DistancePlace place{.kind = DistancePlace::Kind::edge, .index = index};
    const std::vector<DistanceElement*> pieces = add_pieces(edge.curve, place);
    for (DistanceElement* element : pieces)
      element->steps = [images](const std::array<double, 2>& t) {
        std::vector<DistanceStep> steps;
        for (const auto& [sheet, image] : images) sheet->add_across(image->evaluate(t[0], 1), steps);
        return steps;
      };
    pieces.front()->ends_lo[0] = pieces.back()->ends_hi[0] = true;
    for (size_t k = 1; k < pieces.size(); ++k) {
      if (!is_sharp(pieces[k - 1], pieces[k])) continue;
      pieces[k - 1]->ends_hi[0] = pieces[k]->ends_lo[0] = true;
      DistancePlace kink = place;
      kink.t = pieces[k]->domain[0].lo;
      kink.point = edge.curve->point(kink.t);
      add_point(kink, [before = pieces[k - 1], behind = pieces[k], images, t = kink.t] {
        std::vector<DistanceStep> steps = along(before, behind);
        for (const auto& [sheet, image] : images) sheet->add_all_around(Vec2(image->point(t)), steps);
        return steps;
      });
    }
    return pieces;
  }

  void add_vertex(const Body& body, int index, const std::vector<std::vector<DistanceElement*>>& edges) {
    DistancePlace place{.kind = DistancePlace::Kind::vertex, .index = index};
    place.point = body.vertices[index].point;
    // Where the vertex lies on the images of its edges, and along which of these all points are it.
    struct Corner {
      std::shared_ptr<FaceAdjacency> sheet;
      Curve2Ptr image;
      double t;
      bool pole;
    };
    std::vector<Corner> corners;
    std::vector<DistanceStep> along_edges;
    for (size_t e = 0; e < body.edges.size(); ++e) {
      const Edge& edge = body.edges[e];
      for (const bool start : {true, false}) {
        if ((start ? edge.start : edge.end) != index) continue;
        const Interval domain = edge.curve->domain();
        for (const int c : edge.coedges)
          corners.push_back(
              {sheet_of(body, c), body.coedges[c].image, start ? domain.lo : domain.hi, edge.kind == EdgeKind::pole});
        if (edge.kind == EdgeKind::pole) continue;
        const std::vector<DistanceStep> more =
            start ? along(nullptr, edges[e].front()) : along(edges[e].back(), nullptr);
        along_edges.insert(along_edges.end(), more.begin(), more.end());
      }
    }
    add_point(place, [corners, along_edges] {
      std::vector<DistanceStep> steps = along_edges;
      for (const Corner& corner : corners) {
        if (!corner.pole) {
          corner.sheet->add_all_around(Vec2(corner.image->point(corner.t)), steps);
          continue;
        }
        const Interval domain = corner.image->domain();
        for (int k = 0; k <= kPlacesOfPole; ++k)
          corner.sheet->add_across(corner.image->evaluate(domain.lo + domain.width() * k / kPlacesOfPole, 1), steps);
      }
      return steps;
    });
  }

  DistanceElements& elements_;
  std::vector<std::shared_ptr<FaceAdjacency>> sheets_;  // of the faces of a body
};

}  // namespace

std::array<double, 2> DistanceStep::moved(double by) const {
  std::array<double, 2> result{};
  for (int i = 0; i < into->dimension; ++i)
    result[i] = into->domain[i].clamp(at[i] + by * into->scale[i] * direction[i]);
  return result;
}

ElementJet DistanceElement::jet(const std::array<double, 2>& at) const {
  if (dimension == 0) return {place.point, {}, {}};
  if (dimension == 1) {
    const CurveJet r = evaluate_within(*curve, domain[0], at[0], 2);
    return {r.d[0], {r.d[1]}, {r.d[2]}};
  }
  const SurfaceJet s = evaluate_within(*surface, {domain[0], domain[1]}, at[0], at[1], 2);
  return {s.point(), {s.du(), s.dv()}, {s.duu(), s.duv(), s.dvv()}};
}

ElementRange DistanceElement::range(const std::array<Interval, 2>& over) const {
  if (dimension == 0) return {{place.point, place.point}, {}, {}};
  if (dimension == 1) {
    const CurveEnclosure r = curve->enclose(over[0], 2);
    return {r.d[0], {r.d[1]}, {r.d[2]}};
  }
  const SurfaceEnclosure s = surface->enclose({over[0], over[1]}, 2);
  return {s.d(0, 0), {s.d(1, 0), s.d(0, 1)}, {s.d(2, 0), s.d(1, 1), s.d(0, 2)}};
}

Vec3 DistanceElement::at(const std::array<double, 2>& at) const {
  if (dimension == 0) return place.point;
  return dimension == 1 ? curve->point(at[0]) : surface->point(at[0], at[1]);
}

DistancePlace DistanceElement::place_at(const std::array<double, 2>& at) const {
  DistancePlace result = place;
  if (dimension == 0) return result;
  result.point = this->at(at);
  if (held_u || held_v)
    result.u = held_u.value_or(at[0]), result.v = held_v.value_or(at[0]);
  else if (dimension == 1)
    result.t = at[0];
  else
    result.u = at[0], result.v = at[1];
  return result;
}

bool DistanceElement::keeps(const std::array<double, 2>& at) const {
  if (!trim || dimension == 0) return true;
  return dimension == 2 ? trim->contains(at[0], at[1]) : trim->contains(held_u.value_or(at[0]), held_v.value_or(at[0]));
}

bool DistanceElement::is_on_border(const std::array<double, 2>& at, double slack) const {
  for (int i = 0; i < dimension; ++i) {
    const double near = slack * scale[i];
    if ((ends_lo[i] && at[i] <= domain[i].lo + near) || (ends_hi[i] && at[i] >= domain[i].hi - near)) return true;
  }
  return false;
}

DistanceElements distance_elements(const Distant& thing, const Box3& near) {
  DistanceElements elements;
  Gathering all(elements);
  if (const auto* point = std::get_if<Vec3>(&thing)) {
    DistancePlace place;
    place.point = *point;
    all.add_point(place, nullptr);
  } else if (const auto* curve = std::get_if<const Curve*>(&thing)) {
    all.add_curve(CurvePtr(CurvePtr(), *curve));
  } else if (const auto* body = std::get_if<const Body*>(&thing)) {
    all.add_body(**body);
  } else {
    const Surface& surface = *std::get<const Surface*>(thing);
    const SurfacePtr part = surface.bounded() ? SurfacePtr(SurfacePtr(), &surface)
                            : near.bounded()
                                ? part_near(surface, near)
                                : throw std::invalid_argument("both are unbounded: give one of them a domain");
    if (!part) throw std::invalid_argument("the surface is unbounded: give it a domain to measure from");
    all.add_surface(part, surface.domain());
  }
  return elements;
}

Box3 bounds(const Distant& thing) {
  if (const auto* point = std::get_if<Vec3>(&thing)) return {*point, *point};
  if (const auto* curve = std::get_if<const Curve*>(&thing)) return bounds(**curve);
  if (const auto* body = std::get_if<const Body*>(&thing)) return bounds(**body);
  const Surface& surface = *std::get<const Surface*>(thing);
  return surface.bounded() ? bounds(surface) : Box3::everything();
}

}  // namespace lekalo::geometry
