#include "geometry/bodies/blends/overruns.h"

#include <algorithm>
#include <cmath>

#include "geometry/bodies/blends/band_meetings.h"
#include "geometry/bodies/blends/body_draft.h"
#include "geometry/bodies/blends/supports.h"
#include "geometry/bodies/topology/edge_selection.h"
#include "geometry/bodies/topology/entity_names.h"
#include "geometry/curves/operations/curve_part.h"

namespace lekalo::geometry {

namespace {

constexpr int kSteps = 256;  // along a border
constexpr int kRimSteps = 64;

bool touch(const Body& body, int a, int b) {
  const Edge &e = body.edges[a], &f = body.edges[b];
  return e.start == f.start || e.start == f.end || e.end == f.start || e.end == f.end;
}

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

// Segments from a to b and from c to d; the share of each at their crossing.
std::optional<Vec2> crossing_of(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double det = cross(b - a, d - c);
  if (det == 0) return std::nullopt;
  const Vec2 shares(cross(c - a, d - c) / det, cross(c - a, b - a) / det);
  const bool inside = shares.x >= 0 && shares.x < 1 && shares.y >= 0 && shares.y < 1;
  return inside ? std::optional(shares) : std::nullopt;
}

// The border of a band in the parameter plane of its face, at even steps of s.
std::vector<Vec2> border_polygon(const BlendBand& band, int side, const SurfacePtr& surface, Vec2 near) {
  std::vector<Vec2> points;
  const auto [from, to] = band.ends();
  for (int k = 0; k <= kSteps; ++k) {
    near = foot_place_anywhere(surface, band.at(from + (to - from) * k / kSteps, side).point, near);
    points.push_back(near);
  }
  return points;
}

struct Met {
  int edge;
  BandOnCurve at;
};

std::vector<Met> crossings(const Body& body, const BlendEdge& edge, const BlendBand& band, int side) {
  const int face = edge.faces[side];
  std::vector<Met> found;
  std::vector<Vec2> border;
  const auto [from, to] = band.ends();
  for (const int loop : body.faces[face].loops)
    for (const int c : body.loops[loop].coedges) {
      const int rim = body.coedges[c].edge;
      if (body.edges[rim].kind != EdgeKind::regular || rim == edge.edge || touch(body, rim, edge.edge)) continue;
      if (border.empty())
        border = border_polygon(band, side, body.faces[face].surface,
                                Vec2(body.coedges[c].image->point(body.coedges[c].image->domain().lo)));
      const Curve& image = *body.coedges[c].image;
      const Interval w = image.domain();
      for (int j = 0; j < kRimSteps; ++j) {
        const double w0 = w.lo + w.width() * j / kRimSteps, w1 = w.lo + w.width() * (j + 1) / kRimSteps;
        const Vec2 p(image.point(w0)), q(image.point(w1));
        for (int k = 0; k < kSteps; ++k) {
          const auto shares = crossing_of(border[k], border[k + 1], p, q);
          if (!shares) continue;
          const auto met = border_on_curve(band, side, *body.edges[rim].curve,
                                           from + (to - from) * (k + shares->x) / kSteps, w0 + shares->y * (w1 - w0));
          if (met) found.push_back({rim, *met});
        }
      }
    }
  std::sort(found.begin(), found.end(), [](const Met& a, const Met& b) { return a.at.s < b.at.s; });
  return found;
}

int face_beyond(const Body& body, int rim, int face) {
  for (const int c : body.edges[rim].coedges)
    if (face_of(body, c) != face) return face_of(body, c);
  return face;
}

// The edge's parameter across which the section at s stands.
double parameter_at(const Curve& curve, const BlendBand& band, double s) {
  const Interval domain = curve.domain();
  const Vec3 p = band.kind() == BlendKind::ball && band.is_ball() ? band.center(s)
                                                                  : 0.5 * (band.at(s, 0).point + band.at(s, 1).point);
  double t = domain.lo + (s - band.ends()[0]) / (band.ends()[1] - band.ends()[0]) * domain.width();
  for (int k = 0; k < 30; ++k) {
    const CurveJet jet = curve.evaluate(t, 2);
    const double f = glm::dot(p - jet.d[0], jet.d[1]),
                 df = glm::dot(p - jet.d[0], jet.d[2]) - glm::dot(jet.d[1], jet.d[1]);
    const double step = f / df;
    t -= step;
    if (std::abs(step) <= 1e-15 * domain.width()) break;
  }
  return t;
}

// Images have the parameters of their edges but for rounding.
CurvePtr part_of(const CurvePtr& curve, double from, double to) {
  const Interval domain = curve->domain();
  return std::make_shared<CurvePart>(curve, Interval(domain.clamp(from), domain.clamp(to)));
}

// An edge in three parts, with their vertices.
struct Parts {
  std::vector<int> edges;
  std::array<int, 2> vertices;
};

Parts divide(BodyDraft& draft, int e, const std::array<double, 2>& at, const std::array<Vec3, 2>* points) {
  const Edge old = draft.edges[e];
  const std::array<double, 2> t{std::min(at[0], at[1]), std::max(at[0], at[1])};
  Parts parts;
  for (int k = 0; k < 2; ++k) {
    const bool turned = at[0] > at[1];
    parts.vertices[k] = draft.add_vertex(points ? (*points)[turned ? 1 - k : k] : old.curve->point(t[k]));
  }
  const std::array<double, 4> ends{old.curve->domain().lo, t[0], t[1], old.curve->domain().hi};
  const std::array<int, 4> vertices{old.start, parts.vertices[0], parts.vertices[1], old.end};
  for (int k = 0; k < 3; ++k) {
    const CurvePtr curve = part_of(old.curve, ends[k], ends[k + 1]);
    parts.edges.push_back(draft.add_edge(curve, vertices[k], vertices[k + 1], old.origin, old.kind));
    draft.edges.back().tolerance = old.tolerance;
  }
  for (DraftFace& face : draft.faces)
    for (auto& loop : face.loops) {
      std::vector<Body::Use> uses;
      for (const Body::Use& use : loop) {
        if (use.edge != e) {
          uses.push_back(use);
          continue;
        }
        for (int k = 0; k < 3; ++k) {
          const int part = use.forward ? k : 2 - k;
          uses.push_back({parts.edges[part], use.forward, part_of(use.image, ends[part], ends[part + 1])});
        }
      }
      loop = std::move(uses);
    }
  return parts;
}

}  // namespace

std::optional<Overrun> overrun_of(const Body& body, const BlendEdge& edge, const BlendBand& band, Overflow overflow) {
  for (const int side : {0, 1}) {
    const std::vector<Met> met = crossings(body, edge, band, side);
    if (met.size() != 2 || met[0].edge != met[1].edge) continue;
    Overrun result;
    Beyond& beyond = result.beyond;
    beyond.side = side, beyond.rim = met[0].edge;
    beyond.face = face_beyond(body, beyond.rim, edge.faces[side]);
    beyond.kind = !is_sharp(body, beyond.rim)  ? BeyondKind::roll
                  : overflow == Overflow::edge ? BeyondKind::edge
                                               : BeyondKind::overflow;
    for (int k = 0; k < 2; ++k) {
      beyond.s[k] = met[k].at.s, beyond.points[k] = met[k].at.point;
      result.t[k] = parameter_at(*body.edges[edge.edge].curve, band, met[k].at.s);
      result.w[k] = met[k].at.t;
    }
    for (int k = 0; k < 2; ++k) beyond.contacts[k] = band.at(beyond.s[0], k).point;
    return result;
  }
  return std::nullopt;
}

Divided divided(const Body& body, int edge, const Overrun& overrun) {
  BodyDraft draft(body);
  Divided result;
  const size_t count = draft.edges.size();
  const Parts rim = divide(draft, overrun.beyond.rim, overrun.w, &overrun.beyond.points);
  std::vector<std::vector<int>> parts(count);
  for (size_t e = 0; e < count; ++e) parts[e] = {static_cast<int>(e)};
  parts[overrun.beyond.rim] = rim.edges;
  int blended = edge;
  if (overrun.beyond.kind != BeyondKind::overflow) {
    parts[edge] = divide(draft, edge, overrun.t, nullptr).edges;
    blended = parts[edge][1];
  }
  std::vector<int> numbers;
  result.body = draft.body(&numbers);
  for (auto& one : parts)
    for (int& part : one) part = numbers[part];
  result.parts = std::move(parts);
  result.blended = numbers[blended];
  result.beyond = overrun.beyond;
  result.beyond.rim = numbers[rim.edges[1]];
  return result;
}

}  // namespace lekalo::geometry
