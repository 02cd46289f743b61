#include "geometry/queries/rays/cell_model.h"

#include <algorithm>
#include <cmath>

#include "geometry/numerics/instruction_sets.h"
#include "geometry/numerics/lanes.h"

namespace lekalo::geometry {

namespace {

// A vector in a cell's own directions: shares of dx and dy, and the part along the normal.
struct CellFrame {
  Vec3 dual_x{0}, dual_y{0}, normal{0};
  bool regular = false;
  CellFrame(const Vec3& dx, const Vec3& dy) {
    const Vec3 n = glm::cross(dx, dy);
    const double area2 = glm::dot(n, n);
    regular = area2 > 1e-24 * glm::dot(dx, dx) * glm::dot(dy, dy) && area2 > 1e-290;
    if (!regular) return;
    dual_x = glm::cross(dy, n) / area2;
    dual_y = glm::cross(n, dx) / area2;
    normal = n / std::sqrt(area2);
  }
};

// Largest parts of the vectors included, in the directions of a cell and of space.
class LargestParts {
 public:
  explicit LargestParts(const CellFrame& frame) {
    for (int k = 0; k < 3; ++k) load(Vec4(frame.dual_x[k], frame.dual_y[k], frame.normal[k], 0), column_[k]);
  }
  // The fourth lane counts in space only.
  void include(const Lanes& v) {
    const Lanes of_cell = v[0] * column_[0] + v[1] * column_[1] + v[2] * column_[2];
    raise(of_cell_, of_cell);
    raise(of_space_, v);
  }
  // `variation`: of x or y.
  void add_to(CellModel& m, double& variation, double factor) const {
    m.shift_x += factor * of_cell_[0];
    m.shift_y += factor * of_cell_[1];
    m.bend += factor * of_cell_[2];
    variation += factor * glm::length(Vec3(of_space_[0], of_space_[1], of_space_[2]));
  }
  double fourth() const { return of_space_[3]; }

 private:
  static void raise(Lanes& largest, const Lanes& v) {
    largest = v > largest ? v : largest;
    largest = -v > largest ? -v : largest;
  }
  Lanes column_[3];
  Lanes of_cell_{}, of_space_{};
};

}  // namespace

LEKALO_WIDE CellModel model_of(const PatchView& patch) {
  CellModel m;
  const PatchPoint center = evaluate(patch, 0.5, 0.5);
  m.point = center.point;
  m.dx = 0.5 * center.ds;
  m.dy = 0.5 * center.dt;
  const CellFrame frame(m.dx, m.dy);
  m.normal = frame.normal;
  double min_weight = kInfinity, max_weight = -kInfinity;
  for (int k = 0; k < patch.count(); ++k) {
    min_weight = std::min(min_weight, patch.points[k].w);
    max_weight = std::max(max_weight, patch.points[k].w);
  }
  if (!(min_weight > 0)) {
    m.shift_x = m.shift_y = m.bend = m.variation_x = m.variation_y = kInfinity;
    return m;
  }
  // With X~ = X - w S0 the derivative is S_x = (X~_x - S~ w_x) / w, S~ = S - S0 = X~ / w. All in Bernstein form: the
  // derivative of X~ raised to the patch's own degree, less w dx, has coefficients K; then
  //   |S_x - dx| <= max|K| / min w + max|S~| max|w_x| / min w
  // holds for every part of the vectors. The fourth lane holds w_x.
  const bool polynomial = min_weight == max_weight;
  const int p = patch.degree_u, q = patch.degree_v;
  LargestParts along_x(frame), along_y(frame), reach(frame);
  Lanes middle, dx, dy;
  load(Vec4(m.point, 0), middle);
  load(Vec4(m.dx, 0), dx);
  load(Vec4(m.dy, 0), dy);
  // Coefficient k of a derivative of degree n raised by one degree, times 1/2 for x = 2 s - 1.
  const auto include = [&](int k, int n, const Vec4& before, const Lanes& c, const Vec4& after, const Lanes& mean,
                           LargestParts& parts) {
    Lanes a, b;
    load(before, a);
    load(after, b);
    const Lanes d = 0.5 * (static_cast<double>(k) * (c - a) + static_cast<double>(n - k) * (b - c));
    parts.include(d - d[3] * middle - c[3] * mean);
  };
  for (int i = 0; i <= p; ++i)
    for (int j = 0; j <= q; ++j) {
      const Vec4& at = patch.at(i, j);
      Lanes c;
      load(at, c);
      include(i, p, i > 0 ? patch.at(i - 1, j) : at, c, i < p ? patch.at(i + 1, j) : at, dx, along_x);
      include(j, q, j > 0 ? patch.at(i, j - 1) : at, c, j < q ? patch.at(i, j + 1) : at, dy, along_y);
      if (!polynomial) reach.include(c / c[3] - middle);
    }
  along_x.add_to(m, m.variation_x, 1 / min_weight);
  along_y.add_to(m, m.variation_y, 1 / min_weight);
  if (!polynomial) {
    reach.add_to(m, m.variation_x, along_x.fourth() / min_weight);
    reach.add_to(m, m.variation_y, along_y.fourth() / min_weight);
  }
  if (!frame.regular) m.shift_x = m.shift_y = kInfinity;
  return m;
}

CellModel model_of(const Surface& surface, const Rectangle& box) {
  CellModel m;
  const double hu = 0.5 * box.u.width(), hv = 0.5 * box.v.width();
  const SurfaceJet jet = surface.evaluate(box.u.middle(), box.v.middle(), 1);
  m.point = jet.point();
  m.dx = hu * jet.du();
  m.dy = hv * jet.dv();
  const CellFrame frame(m.dx, m.dy);
  m.normal = frame.normal;
  const SurfaceEnclosure hull = surface.enclose(box, 1);
  const auto include = [&](const Box3& derivative, const Vec3& mean, double h, double& variation) {
    // The box's support in each direction.
    const Vec3 d = h * glm::max(glm::abs(derivative.lo - mean), glm::abs(derivative.hi - mean));
    m.shift_x += glm::dot(d, glm::abs(frame.dual_x));
    m.shift_y += glm::dot(d, glm::abs(frame.dual_y));
    m.bend += glm::dot(d, glm::abs(frame.normal));
    variation = glm::length(d);
    if (!(variation < kInfinity)) variation = kInfinity;  // the mean may be no number
  };
  include(hull.d(1, 0), jet.du(), hu, m.variation_x);
  include(hull.d(0, 1), jet.dv(), hv, m.variation_y);
  if (!frame.regular || !m.is_bounded()) m.shift_x = m.shift_y = kInfinity;
  if (!m.is_bounded()) m.bend = kInfinity;
  return m;
}

HalfFloat HalfFloat::above(double value) {
  auto f = static_cast<float>(value);
  if (f < value) f = std::nextafter(f, INFINITY);
  const auto word = std::bit_cast<uint32_t>(f);
  // Towards zero what is negative, away from it what is positive; the carry may go into the exponent, up to infinity.
  return {static_cast<uint16_t>((f > 0 ? word + 0xffff : word) >> 16)};
}

HalfFloat HalfFloat::below(double value) {
  const HalfFloat turned = above(-value);
  return {static_cast<uint16_t>(turned.bits ^ 0x8000)};
}

PatchCell::PatchCell(const PatchView& part, const CellModel& model, const CellPlace& place)
    : at_x(static_cast<int16_t>(kPlaces * place.x)),
      at_y(static_cast<int16_t>(kPlaces * place.y)),
      halvings_x(static_cast<uint8_t>(-std::ilogb(place.hx))),
      halvings_y(static_cast<uint8_t>(-std::ilogb(place.hy))) {
  const CellFrame own(model.dx, model.dy);
  const double size = glm::length(model.dx) + glm::length(model.dy);
  const bool regular = own.regular && model.shift_x < kInfinity;
  // Singular cells have the axes of space.
  const double unit = size > 0 ? 1 / size : 1;
  const Vec3 rows[] = {regular ? own.dual_x : Vec3(unit, 0, 0), regular ? own.dual_y : Vec3(0, unit, 0),
                       regular ? own.normal : Vec3(0, 0, 1)};
  Vec3 middle, rounded[3];
  for (int k = 0; k < 3; ++k) {
    for (int row = 0; row < 3; ++row) rounded[row][k] = frame[k][row] = static_cast<float>(rows[row][k]);
    middle[k] = frame[k][3] = static_cast<float>(model.point[k]);
  }
  const auto parts = [&](const Vec3& v) {
    return Vec3(glm::dot(rounded[0], v), glm::dot(rounded[1], v), glm::dot(rounded[2], v));
  };
  Box3 box;
  for (int k = 0; k < part.count(); ++k) {
    const Vec4& p = part.points[k];
    if (!(p.w > 0)) {
      box = Box3::everything();
      break;
    }
    box.include(parts(Vec3(p) / p.w - middle));
  }
  // Much more than the doubles' rounding and the slack of borders, much less than matters.
  const Vec3 slack = 1e-9 * (Vec3(1) + glm::max(glm::abs(box.lo), glm::abs(box.hi))) * Vec3(1, 1, size);
  for (int k = 0; k < 3; ++k) {
    lo[k] = HalfFloat::below(box.lo[k] - slack[k]);
    hi[k] = HalfFloat::above(box.hi[k] + slack[k]);
  }
  // The bounds of the model are about its own middle in its own frame. With the frame's rounding in a vector of that
  // length in the derivatives:
  const double length = model.reach_x() + model.reach_y();
  const Vec3 off = glm::abs(parts(model.point - middle));
  const auto turned = [&](int row) { return glm::length(rounded[row] - rows[row]) * length; };
  lo[3] = HalfFloat::above(regular ? model.shift_x + off.x + turned(0) : kInfinity);
  hi[3] = HalfFloat::above(regular ? model.shift_y + off.y + turned(1) : kInfinity);
  bend = HalfFloat::above(model.bend + off.z + turned(2));
  reach_x = HalfFloat::above(model.reach_x());
  reach_y = HalfFloat::above(model.reach_y());
}

bool flattens_across_u(const PatchView& patch, double x, double y) {
  const int p = patch.degree_u, q = patch.degree_v;
  const auto size = [](const Vec4& d) { return std::abs(d.x) + std::abs(d.y) + std::abs(d.z) + std::abs(d.w); };
  double bend_u = 0, bend_v = 0, twist = 0;
  for (int i = 0; i <= p; ++i)
    for (int j = 0; j <= q; ++j) {
      const Vec4& at = patch.at(i, j);
      if (i > 0 && i < p) bend_u = std::max(bend_u, size(patch.at(i - 1, j) - at - at + patch.at(i + 1, j)));
      if (j > 0 && j < q) bend_v = std::max(bend_v, size(patch.at(i, j - 1) - at - at + patch.at(i, j + 1)));
      if (i > 0 && j > 0)
        twist = std::max(twist, size(patch.at(i - 1, j - 1) - patch.at(i - 1, j) - patch.at(i, j - 1) + at));
    }
  bend_u *= p * (p - 1);
  bend_v *= q * (q - 1);
  twist *= p * q;
  return twist >= std::max(bend_u, bend_v) ? x >= y : bend_u >= bend_v;
}

double roughness(const CellModel& m) {
  const double shorter = std::min(glm::length(m.dx), glm::length(m.dy));
  const double r = std::max(m.shift_x, m.shift_y) + m.bend / shorter;
  return r < kInfinity ? r : kInfinity;
}

}  // namespace lekalo::geometry
