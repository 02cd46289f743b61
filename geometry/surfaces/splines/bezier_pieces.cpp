// The rational Bezier patches of a NURBS surface (declared in geometry/surface.h).

#include <algorithm>

#include "geometry/curves/splines/blossom.h"
#include "geometry/curves/splines/knot_spans.h"
#include "geometry/curves/splines/weights.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// The patches of all spans in u by all in v; marks those of spans in which a patch has a weight that is not positive.
static std::vector<SurfacePiece> bezier_pieces(const NurbsSurfaceForm& form, const std::vector<SpanPart>& parts_u,
                                               const std::vector<SpanPart>& parts_v, std::vector<char>& uneven_u,
                                               std::vector<char>& uneven_v) {
  const int p = form.degree_u, q = form.degree_v, count_v = form.count_v();
  uneven_u.assign(parts_u.size(), 0), uneven_v.assign(parts_v.size(), 0);
  std::vector<SurfacePiece> pieces;
  pieces.reserve(parts_u.size() * parts_v.size());
  std::vector<Vec4> strip(static_cast<size_t>(p + 1) * count_v);  // Bezier in u, still B-spline in v
  for (size_t i = 0; i < parts_u.size(); ++i) {
    for (int k = 0; k < count_v; ++k)
      bezier_points(p, form.knots_u, parts_u[i].span, form.points.data() + k, count_v, parts_u[i].rational.lo,
                    parts_u[i].rational.hi, strip.data() + k, count_v);
    for (size_t j = 0; j < parts_v.size(); ++j) {
      SurfacePiece piece;
      piece.domain = {parts_u[i].natural, parts_v[j].natural};
      piece.map_u = parts_u[i].map;
      piece.map_v = parts_v[j].map;
      piece.degree_u = p;
      piece.degree_v = q;
      piece.points.resize(static_cast<size_t>(p + 1) * (q + 1));
      for (int k = 0; k <= p; ++k)
        bezier_points(q, form.knots_v, parts_v[j].span, strip.data() + static_cast<size_t>(k) * count_v, 1,
                      parts_v[j].rational.lo, parts_v[j].rational.hi,
                      piece.points.data() + static_cast<size_t>(k) * (q + 1), 1);
      if (!all_weights_positive(piece.points)) uneven_u[i] = uneven_v[j] = 1;
      pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

std::vector<SurfacePiece> bezier_pieces(const NurbsSurfaceForm& form, const Rectangle& domain) {
  std::vector<SpanPart> parts_u = span_parts(form.degree_u, form.knots_u, form.maps_u, domain.u),
                        parts_v = span_parts(form.degree_v, form.knots_v, form.maps_v, domain.v);
  const auto halve = [](std::vector<SpanPart>& parts, const std::vector<char>& chosen) {
    std::vector<SpanPart> finer;
    for (size_t k = 0; k < parts.size(); ++k) {
      const auto both = halves(parts[k]);
      if (chosen[k])
        finer.insert(finer.end(), both.begin(), both.end());
      else
        finer.push_back(parts[k]);
    }
    parts = std::move(finer);
  };
  std::vector<char> uneven_u, uneven_v;
  for (int halvings = 0;; halvings += 2) {
    std::vector<SurfacePiece> pieces = bezier_pieces(form, parts_u, parts_v, uneven_u, uneven_v);
    const bool any = std::find(uneven_u.begin(), uneven_u.end(), 1) != uneven_u.end();
    if (!any || halvings >= kMaxHalvingsForWeights) return pieces;
    halve(parts_u, uneven_u);
    halve(parts_v, uneven_v);
  }
}

}  // namespace lekalo::geometry
