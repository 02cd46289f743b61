#include "geometry/tessellation/surfel_net.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/describe.h"
#include "geometry/mesh.h"

namespace lekalo::geometry {

namespace {

constexpr size_t kMaxSurfels = 1000000;
constexpr double kTip = 1e-2;  // of epsilon: cells of this diameter need no normal

struct Range {
  double lo, hi;
};
Range product(const Range& a, const Range& b) {
  const auto [lo, hi] = std::minmax({a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi});
  return {lo, hi};
}

// Of r_u x r_v.
Box3 cross(const Box3& a, const Box3& b) {
  Box3 result;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Range first = product({a.lo[j], a.hi[j]}, {b.lo[k], b.hi[k]}),
                second = product({a.lo[k], a.hi[k]}, {b.lo[j], b.hi[j]});
    result.lo[i] = first.lo - second.hi;
    result.hi[i] = first.hi - second.lo;
  }
  return result;
}

double farthest(const Box3& box, const Vec3& from) { return glm::length(glm::max(box.hi - from, from - box.lo)); }

// The largest angle between two vectors of the box; pi if that is not known.
double spread(const Box3& box) {
  const double share = 0.5 * box.diameter() / glm::length(box.center());
  return share < 1 ? 2 * std::asin(share) : kPi;
}

class Net {
 public:
  Net(const Surface& surface, double epsilon, double gamma) : surface_(surface), epsilon_(epsilon), gamma_(gamma) {}

  std::vector<Surfel> surfels() {
    std::vector<Rectangle> cells{surface_.domain()};
    while (!cells.empty()) {
      const Rectangle cell = cells.back();
      cells.pop_back();
      if (net_.size() + cells.size() > kMaxSurfels)
        throw FieldError("epsilon", fmt::format("the net has more than {} points", kMaxSurfels),
                         "larger numbers make fewer");
      const SurfaceEnclosure in = surface_.enclose(cell, 1);
      const double u = cell.u.middle(), v = cell.v.middle();
      const Vec3 point = surface_.point(u, v);
      const double reach = farthest(in.d(0, 0), point);
      const bool is_tip = reach < kTip * epsilon_;
      if (is_tip || (reach <= epsilon_ && spread(cross(in.d(1, 0), in.d(0, 1))) <= gamma_))
        net_.push_back({point, surface_.normal(u, v), u, v});
      else
        halve(cell, in, cells);
    }
    return std::move(net_);
  }

 private:
  // Across its longer side.
  static void halve(const Rectangle& cell, const SurfaceEnclosure& in, std::vector<Rectangle>& cells) {
    const double along_u = farthest(in.d(1, 0), Vec3(0)) * cell.u.width(),
                 along_v = farthest(in.d(0, 1), Vec3(0)) * cell.v.width();
    Rectangle first = cell, second = cell;
    if (along_u >= along_v)
      first.u.hi = second.u.lo = cell.u.middle();
    else
      first.v.hi = second.v.lo = cell.v.middle();
    cells.push_back(second);
    cells.push_back(first);
  }

  const Surface& surface_;
  double epsilon_, gamma_;
  std::vector<Surfel> net_;
};

// Hexagons about the surfels, in their planes: the middle and six corners each.
Mesh hexagons(const std::vector<Surfel>& net, double radius) {
  Mesh mesh;
  for (size_t i = 0; i < net.size(); ++i) {
    const Surfel& s = net[i];
    const Frame plane = frame_about(s.point, s.normal);
    const auto first = static_cast<int32_t>(mesh.points.size()), number = static_cast<int32_t>(i);
    mesh.points.push_back(s.point);
    mesh.normals.push_back(s.normal);
    mesh.parameters.emplace_back(s.u, s.v);
    for (int k = 0; k < 6; ++k) {
      const double angle = k * kPi / 3;
      mesh.points.push_back(plane.point({radius * std::cos(angle), radius * std::sin(angle), 0}));
    }
    for (int32_t k = 0; k < 6; ++k)
      mesh.triangles.push_back({{first, first + 1 + k, first + 1 + (k + 1) % 6},
                                {number, number, number},
                                {number, number, number},
                                number});
  }
  return mesh;
}

}  // namespace

std::vector<Surfel> surfel_net(const Surface& surface, double epsilon, double gamma) {
  return Net(surface, epsilon, gamma).surfels();
}

TypeDeclaration surfel_net_type() {
  return declare(
             Category::mesh, "surfel_net",
             "Oriented points of a surface, order of no matter, such that each of its points has one within epsilon "
             "whose normal is off by at most gamma; shown as hexagons in their planes, two-sided like all surfaces.")
      .example("of: { type: torus_surface, major_radius: 2, minor_radius: 0.8 }, epsilon: 0.3")
      .field("of", reference({Category::surface}), "the surface")
      .field("epsilon", length().positive(), "largest distance of a point of the surface from the net")
      .field("gamma", angle().positive().at_most(kPi / 2), "largest angle between the normals there", "30")
      .field("size", number().positive(), "radius of the hexagons as a share of epsilon; 1.2 leaves no holes", "0.4")
      .built_by([](const Fields& f) -> std::any {
        const SurfacePtr surface = f.surface("of");
        const Rectangle domain = surface->domain();
        if (!(domain.u.width() < kInfinity && domain.v.width() < kInfinity))
          throw FieldError("of", "the surface is unbounded", "give it a domain");
        const double epsilon = f.number("epsilon");
        return MeshPtr(std::make_shared<const Mesh>(
            hexagons(surfel_net(*surface, epsilon, f.number("gamma")), f.number("size") * epsilon)));
      });
}

}  // namespace lekalo::geometry
