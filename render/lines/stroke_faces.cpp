// Parameter lines and creases of surfaces, and of bodies' faces as far as these go.
#include "geometry/curves/operations/creases.h"
#include "geometry/curves/operations/surface_curve.h"
#include "render/lines/stroke_collector.h"

namespace lekalo::render {

using namespace geometry;

void StrokeCollector::add_crease(const SurfacePtr& surface, const Crease& crease, const Interval& along,
                                 const Style& style, const HiddenLines& hidden) {
  // So far beside a crease its sides are asked for derivatives, of the domain: bounds on it hold those of both.
  constexpr double kBeside = 1e-13;
  const Interval range = crease.held == IsoDirection::u ? surface->domain().u : surface->domain().v;
  const double offset = kBeside * range.width();
  lies_on({surface, crease.held, crease.at + offset, along});
  lies_on({surface, crease.held, (crease.seam ? range.hi : crease.at) - offset, along});
  stroke(std::make_shared<ParameterLine>(surface, crease.held, crease.at, along), style, hidden);
}

void StrokeCollector::add(const NetLine& line, const Style& style, const HiddenLines& hidden) {
  each_smooth_part(line.surface, [&](const SurfacePtr& part) {
    const NetLine own{part, line.held, line.at, line.along};
    lies_on(own);
    stroke(own.curve(), style, hidden);
  });
}

void StrokeCollector::lies_on(const NetLine& line) {
  if (drawing_ || !cutters_.empty()) supporting_surfaces_.push_back({line.surface, line.image()});
}

void StrokeCollector::add_creases(const SurfacePtr& surface, const Style& style, const HiddenLines& hidden) {
  for (const Crease& crease : creases(*surface)) add_crease(surface, crease, crease.along, style, hidden);
  const std::vector<SmoothPart>& parts = smooth_parts_of(surface);
  const FreeCreases found = free_creases(parts);
  if (!found.complete) is_incomplete();
  for (const FreeCrease& crease : found.lines) {
    const auto lies_on_part = [&](int k) {
      const SurfacePtr& part = parts[static_cast<size_t>(crease.parts[k])].surface;
      if (drawing_) supporting_surfaces_.push_back({part, crease.image});
      return part;
    };
    const SurfacePtr on = lies_on_part(0);
    if (crease.step) {  // an edge of each side
      stroke(std::make_shared<SurfaceCurve>(on, crease.image), style, hidden);
      stroke(std::make_shared<SurfaceCurve>(lies_on_part(1), crease.image), style, hidden);
    } else {
      lies_on_part(1);
      stroke(std::make_shared<SurfaceCurve>(on, crease.image), style, hidden);
    }
  }
}

void StrokeCollector::add_creases(const Body& body, const Style& style, const HiddenLines& hidden) {
  constexpr double kMinPart = 1e-9;  // of a line
  for (const FaceRegion& face : face_regions(body)) {
    if (!face.region) {
      add_creases(face.surface, style, hidden);
      continue;
    }
    for (const Crease& crease : creases(*face.surface)) {
      const bool u = crease.held == IsoDirection::u;
      const Interval range = u ? face.region->u_range() : face.region->v_range();
      const double at =
          crease.at + shift_into(range, crease.at, u ? face.surface->periods().u : face.surface->periods().v);
      each_line_of_face(face, crease.held, at, [&](const NetLine& line) {
        const Interval both = intersect(line.along, crease.along);
        if (both.width() > kMinPart * line.along.width()) add_crease(face.surface, crease, both, style, hidden);
      });
    }
  }
}

}  // namespace lekalo::render
