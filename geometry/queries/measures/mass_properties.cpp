// Mass properties by surface integrals (Golovanov 2016, 8.9): by the divergence theorem, with m dS = (s_u x s_v) du dv,
//
//   V = 1/3 int r.m dS,   V c_x = 1/4 int x r.m dS,   int x y dV = 1/5 int x y r.m dS.
//
// The origin is first moved to the middle of the body, so that r.m does not cancel, and lengths are measured by the
// body's half diameter: then all integrals are of the order of one, and an integrand that is nothing but rounding (r.m
// on a plane through the origin) is seen to be one.
#include "geometry/queries/measures/mass_properties.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <unordered_map>

#include "geometry/contour.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/queries/differential/curvature.h"
#include "geometry/queries/measures/face_integral.h"
#include "geometry/queries/measures/steady_parts.h"

namespace lekalo::geometry {

namespace {

// area, its three moments, volume, its three moments, xx yy zz xy yz zx
constexpr int kAreaIntegrals = 4;
constexpr int kAllIntegrals = 14;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// The origin and unit of length that integrals are taken in.
struct Scale {
  Vec3 origin;
  double unit;
  double rounding;  // of a coordinate, in the unit: far from the world's origin lengths have fewer figures
  // Bounds may be infinite where the thing is not (sin(x)/x).
  explicit Scale(const Box3& box)
      : origin(box.bounded() ? box.center() : Vec3(0)),
        unit(box.bounded() && box.diameter() > 0 ? 0.5 * box.diameter() : 1.0),
        rounding(box.bounded() ? kEpsilon * glm::length(glm::max(glm::abs(box.lo), glm::abs(box.hi))) / unit
                               : kEpsilon) {}
  // Of integral k of the list above, in this unit.
  double factor(int k) const {
    const int power = k == 0 ? 2 : k < 5 ? 3 : k < 8 ? 4 : 5;
    return std::pow(unit, power);
  }
};

double area_element(const SurfaceJet& jet, const Scale& scale) {
  return glm::length(glm::cross(jet.du(), jet.dv())) / (scale.unit * scale.unit);
}

void area_integrands(const SurfaceJet& jet, const Scale& scale, std::span<double> values) {
  const double element = area_element(jet, scale);
  const Vec3 r = (jet.point() - scale.origin) / scale.unit;
  values[0] = element;
  for (int k = 0; k < 3; ++k) values[1 + k] = element * r[k];
}

double volume_element(const SurfaceJet& jet, const Scale& scale) {
  return glm::dot((jet.point() - scale.origin) / scale.unit, glm::cross(jet.du() / scale.unit, jet.dv() / scale.unit));
}

void mass_integrands(const SurfaceJet& jet, const Scale& scale, std::span<double> values) {
  area_integrands(jet, scale, values);
  const Vec3 r = (jet.point() - scale.origin) / scale.unit;
  const double flux = volume_element(jet, scale);
  values[4] = flux / 3;
  for (int k = 0; k < 3; ++k) values[5 + k] = flux * r[k] / 4;
  for (int k = 0; k < 3; ++k) values[8 + k] = flux * r[k] * r[k] / 5;
  values[11] = flux * r.x * r.y / 5;
  values[12] = flux * r.y * r.z / 5;
  values[13] = flux * r.z * r.x / 5;
}

// The centroid of a wire or sheet whose length or area is the first integral and whose moments are the next three.
void set_centroid(const Integral& integral, const Scale& scale, Vec3& centroid, double& error) {
  const double size = integral.value[0];
  const Vec3 moment(integral.value[1], integral.value[2], integral.value[3]);
  const Vec3 moment_error(integral.error[1], integral.error[2], integral.error[3]);
  if (!(size > 0)) {  // what has no extent: the middle of its box
    centroid = scale.origin;
    error = scale.unit;
    return;
  }
  centroid = scale.origin + scale.unit / size * moment;
  error = scale.unit *
          (scale.rounding + (glm::length(moment_error) + glm::length(moment) / size * integral.error[0]) / size);
}

// What the rounding of coordinates may change: an area about as much as its border moves, and all that follow, which
// are integrals of coordinates over it.
void add_rounding(Integral& integral, const Scale& scale, double diameter) {
  const double area = integral.value[0];
  integral.error[0] += scale.rounding * (2 * diameter / scale.unit + area);
  for (size_t k = 1; k < integral.error.size(); ++k) integral.error[k] += scale.rounding * area;
}

std::vector<double> smooth_breaks(const Curve& curve, const Interval& range) {
  std::vector<double> breaks{range.lo};
  for (const CurvePiece& piece : curve.pieces())
    if (piece.domain.lo > breaks.back() && piece.domain.lo < range.hi) breaks.push_back(piece.domain.lo);
  breaks.push_back(range.hi);
  return breaks;
}

// Enclosures of searched curves take long, and their pieces are short.
SteadyParts parts_of(const Curve& curve, const Interval& range) {
  return is_searched(curve) ? SteadyParts{smooth_breaks(curve, range), {}, 0, 0} : steady_parts(curve, range);
}

double speed_in(const SteadyParts& parts, double t, const CurveJet& jet) {
  const ChordPart* chord = parts.chord_at(t);
  return chord ? chord->length / chord->t.width() : glm::length(jet.d[1]);
}

// Where the derivatives are those of a fit, integrals over it tell the area of the fit. Points that are moved by up to
// d change an area by at most d (length of its border + int |2 H| dS), and a length by d (2 + int k ds), but for d^2:
// the first variation. The slopes that come with d, much larger than it is, cancel between the ends.
struct Variation {
  double distance = 0;  // d, a length
  double factor = 0;    // border + bend of an area (a length), ends + turn of a length (a number)
};

constexpr IntegrationGoal kBend{0, 1e-2, 20000};  // the integrals of curvature: no more than a size

double turn(const Curve& curve, const Interval& range) {
  const auto integrand = [&](double t, std::span<double> values) {
    const CurveJet jet = curve.evaluate(t, 2);
    const double speed2 = glm::dot(jet.d[1], jet.d[1]);
    values[0] = speed2 > 0 ? glm::length(glm::cross(jet.d[1], jet.d[2])) / speed2 : 0;
  };
  const Integral integral = integrate(integrand, 1, smooth_breaks(curve, range), kBend);
  return integral.value[0] + integral.error[0];
}

Variation variation(const Curve& curve, const Interval& range) {
  const double distance = curve.fit_distance();
  return distance > 0 ? Variation{distance, 2 + turn(curve, range)} : Variation{};
}

double bend(const Surface& surface) {
  const auto integrand = [&](double u, double v, std::span<double> values) {
    const SurfaceJet jet = surface.evaluate(u, v, 2);
    const SurfaceCurvature c = curvature(jet, surface.normal(u, v, jet));
    values[0] = c.regular ? std::abs(2 * c.mean) * glm::length(glm::cross(jet.du(), jet.dv())) : 0;
  };
  const Rectangle domain = surface.domain();
  const Integral integral = integrate(integrand, 1, domain.u, domain.v, kBend);
  return integral.value[0] + integral.error[0];
}

// Of a part of the surface with this border.
Variation variation(const Surface& surface, const std::function<double()>& border) {
  const double distance = surface.fit_distance();
  return distance > 0 ? Variation{distance, border() + bend(surface)} : Variation{};
}

double border_of(const Surface& surface) {
  const SurfacePtr alias(SurfacePtr(), &surface);
  const Rectangle domain = surface.domain();
  double sum = 0;
  for (const double u : {domain.u.lo, domain.u.hi})
    sum += arc_length(ParameterLine(alias, IsoDirection::u, u), domain.v.lo, domain.v.hi).value;
  for (const double v : {domain.v.lo, domain.v.hi})
    sum += arc_length(ParameterLine(alias, IsoDirection::v, v), domain.u.lo, domain.u.hi).value;
  return sum;
}

double border_of(const Body& body, int face) {
  double sum = 0;
  for (const int loop : body.faces[face].loops)
    for (const int coedge : body.loops[loop].coedges) {
      const Curve& edge = *body.edges[body.coedges[coedge].edge].curve;
      sum += arc_length(edge, edge.domain().lo, edge.domain().hi).value;
    }
  return sum;
}

// To the first integral, a length or an area (of `dimension` 1 or 2), to its moments, and to integrals of coordinates
// over it.
void add_variation(Integral& integral, const Scale& scale, const Variation& by, int dimension) {
  const double distance = by.distance / scale.unit, change = distance * by.factor / std::pow(scale.unit, dimension - 1);
  integral.error[0] += change;
  for (size_t k = 1; k < integral.error.size(); ++k)
    integral.error[k] += distance * integral.value[0] + (k < kAreaIntegrals ? change : 0);
}

SurfaceMeasures area_of(Integral integral, const Scale& scale, const Variation& by) {
  add_rounding(integral, scale, 2 * scale.unit);
  add_variation(integral, scale, by, 2);
  SurfaceMeasures result;
  result.area = {scale.factor(0) * integral.value[0], scale.factor(0) * integral.error[0]};
  set_centroid(integral, scale, result.centroid, result.centroid_error);
  return result;
}

// An integral that comes no nearer to rest than this is infinite, for all that can be told: beside a place where the
// derivatives grow without bounds, that of 1/x changes by more with the last digit of x, that of x^(-3/4) by less.
constexpr double kMinAccuracy = 1e-3;

// Of a length or an area, integral 0.
void require_measure(const Integral& integral, const std::string& what) {
  const bool is_found = std::isfinite(integral.value[0]) &&
                        (integral.converged || integral.error[0] <= kMinAccuracy * std::abs(integral.value[0]));
  if (!is_found)
    throw std::invalid_argument(
        what +
        " is infinite or cannot be told: somewhere in the domain the derivatives grow "
        "without bounds, have no values or change faster than the digits of the parameter tell");
}

// An integrand that is nothing but rounding seems to err as much as it is large, in either direction.
IntegrationGoal goal(double accuracy, const Scale& scale) {
  return {0.1 * accuracy, accuracy, 2000000, 4 * scale.rounding};
}

// From the integrals about `origin` to the properties about the centroid.
MassProperties properties_of(const std::array<double, kAllIntegrals>& value,
                             const std::array<double, kAllIntegrals>& error, const Vec3& origin, double size) {
  MassProperties result;
  result.area = {value[0], error[0]};
  result.volume = {value[4], error[4]};
  const double volume = value[4];
  if (volume == 0) return result;
  const Vec3 c = Vec3(value[5], value[6], value[7]) / volume;
  result.centroid = origin + c;
  result.centroid_error =
      kEpsilon * glm::length(origin) +
      (glm::length(Vec3(error[5], error[6], error[7])) + glm::length(c) * error[4]) / std::abs(volume);
  const double xx = value[8] - volume * c.x * c.x, yy = value[9] - volume * c.y * c.y,
               zz = value[10] - volume * c.z * c.z;
  const double xy = value[11] - volume * c.x * c.y, yz = value[12] - volume * c.y * c.z,
               zx = value[13] - volume * c.z * c.x;
  result.inertia = Mat3(Vec3(yy + zz, -xy, -zx), Vec3(-xy, zz + xx, -yz), Vec3(-zx, -yz, xx + yy));
  double worst = 0;
  for (int k = 8; k < kAllIntegrals; ++k) worst = std::max(worst, error[k]);
  result.inertia_error = 2 * worst + std::abs(volume) * result.centroid_error * size;
  principal_moments(result.inertia, result.principal_moments, result.principal_axes);
  return result;
}

void require_bounded(const Interval& range) {
  if (!(range.lo > -kInfinity && range.hi < kInfinity))
    throw std::invalid_argument("an unbounded curve has no length; give it a range");
}

bool has_free_borders(const Body& body) {
  for (const Edge& edge : body.edges)
    if (edge.kind != EdgeKind::pole && edge.coedges.size() != 2) return true;
  return false;
}

}  // namespace

bool spans_area(const Surface& surface) {
  // Where a domain has no end, near what end it has or zero.
  const auto inside = [](const Interval& range, double fraction) {
    const double lo = range.lo > -kInfinity ? range.lo : std::min(0.0, range.hi) - 1,
                 hi = range.hi < kInfinity ? range.hi : std::max(0.0, range.lo) + 1;
    return lo + fraction * (hi - lo);
  };
  const Rectangle domain = surface.domain();
  const auto at = [&](double x, double y) { return surface.evaluate(inside(domain.u, x), inside(domain.v, y), 1); };
  const auto area = [](const SurfaceJet& jet) { return glm::length(glm::cross(jet.du(), jet.dv())); };
  const auto parallel = [](const SurfaceJet& jet) { return 1e-12 * glm::length(jet.du()) * glm::length(jet.dv()); };
  for (const double x : {0.382, 0.113, 0.647, 0.923, 0.271})
    for (const double y : {0.618, 0.157, 0.389, 0.877, 0.731})
      if (const SurfaceJet jet = at(x, y); !(area(jet) <= parallel(jet))) return true;
  // Very large weights draw all but a rim to one point or curve.
  for (const double x : {0.0, 1.0})
    for (const double y : {0.0, 1.0})
      if (const SurfaceJet jet = at(x, y); area(jet) > parallel(jet)) return true;
  return false;
}

CurveMeasures measure(const Curve& curve) {
  require_bounded(curve.domain());
  const Scale scale(bounds(curve));
  const SteadyParts parts = parts_of(curve, curve.domain());
  const auto integrand = [&](double t, std::span<double> values) {
    const CurveJet jet = curve.evaluate(t, 1);
    const double speed = speed_in(parts, t, jet) / scale.unit;
    values[0] = speed;
    for (int k = 0; k < 3; ++k) values[1 + k] = speed * (jet.d[0][k] - scale.origin[k]) / scale.unit;
  };
  Integral integral = integrate(integrand, 4, parts.breaks, goal(kMeasureAccuracy, scale));
  require_measure(integral, "the length");
  const double parts_error = parts.error(scale.unit * integral.value[0]);
  // Of chords the moments err by the length and by where on the chord it is, the size being 2.
  for (int k = 0; k < 4; ++k) integral.error[k] += parts_error / scale.unit;
  for (const ChordPart& chord : parts.chords)
    for (int k = 1; k < 4; ++k) integral.error[k] += std::pow((chord.length + chord.error) / scale.unit, 2);
  integral.error[0] += 2 * scale.rounding;  // at its ends
  for (int k = 1; k < 4; ++k) integral.error[k] += scale.rounding * integral.value[0];
  add_variation(integral, scale, variation(curve, curve.domain()), 1);
  CurveMeasures result;
  result.length = {scale.unit * integral.value[0], scale.unit * integral.error[0]};
  set_centroid(integral, scale, result.centroid, result.centroid_error);
  return result;
}

Measured arc_length(const Curve& curve, double a, double b) {
  require_bounded({std::min(a, b), std::max(a, b)});
  if (a == b) return {};
  const Interval range{std::min(a, b), std::max(a, b)};
  const SteadyParts parts = parts_of(curve, range);
  const Integral integral =
      integrate([&](double t, std::span<double> values) { values[0] = speed_in(parts, t, curve.evaluate(t, 1)); }, 1,
                parts.breaks, {0, kMeasureAccuracy, 2000000});
  const Variation by = variation(curve, range);
  return {a < b ? integral.value[0] : -integral.value[0],
          integral.error[0] + parts.error(integral.value[0]) + by.distance * by.factor};
}

SurfaceMeasures measure(const Surface& surface) {
  if (!surface.bounded()) throw std::invalid_argument("an unbounded surface has no area; give it a domain");
  const Scale scale(bounds(surface));
  const auto integrands = [&](const SurfaceJet& jet, std::span<double> values) { area_integrands(jet, scale, values); };
  const Integral integral =
      integrate_over(surface, surface.domain(), integrands, kAreaIntegrals, goal(kMeasureAccuracy, scale));
  require_measure(integral, "the area");
  return area_of(integral, scale, variation(surface, [&] { return border_of(surface); }));
}

SurfaceMeasures measure_face(const Body& body, int face) {
  Box3 box;
  for (int loop : body.faces[face].loops)
    for (int coedge : body.loops[loop].coedges) box.include(bounds(*body.edges[body.coedges[coedge].edge].curve));
  const Scale scale(box);
  const auto integrands = [&](const SurfaceJet& jet, std::span<double> values) { area_integrands(jet, scale, values); };
  const Integral integral = integrate_over(body, face, integrands, kAreaIntegrals, goal(kMeasureAccuracy, scale));
  require_measure(integral, "the area of face " + std::to_string(face));
  return area_of(integral, scale, variation(*body.faces[face].surface, [&] { return border_of(body, face); }));
}

namespace {
// Normals that look outward are those of r_u x r_v where this is 1, the opposite ones where it is -1.
double outward(const Face& face) { return face.forward == (face.surface->normal_sign() > 0) ? 1 : -1; }
}  // namespace

MassProperties measure(const Body& body, double accuracy) {
  const Box3 box = bounds(body);
  const Scale scale(box);
  const auto integrands = [&](const SurfaceJet& jet, std::span<double> values) { mass_integrands(jet, scale, values); };
  std::array<double, kAllIntegrals> value{}, error{};
  for (int face = 0; face < static_cast<int>(body.faces.size()); ++face) {
    Integral integral = integrate_over(body, face, integrands, kAllIntegrals, goal(accuracy, scale));
    require_measure(integral, "the area of face " + std::to_string(face));
    add_rounding(integral, scale, bounds(body, face).diameter());
    add_variation(integral, scale, variation(*body.faces[face].surface, [&] { return border_of(body, face); }), 2);
    for (int k = 0; k < kAllIntegrals; ++k) {
      const double sign = k < kAreaIntegrals ? 1 : outward(body.faces[face]);
      value[k] += sign * scale.factor(k) * integral.value[k];
      error[k] += scale.factor(k) * integral.error[k];
    }
  }
  MassProperties result = properties_of(value, error, scale.origin, box.diameter());
  result.closed = !has_free_borders(body);
  return result;
}

double signed_volume(const Body& body, int shell, double accuracy) {
  const Scale scale(bounds(body));
  const auto integrands = [&](const SurfaceJet& jet, std::span<double> values) {
    values[0] = area_element(jet, scale);
    values[1] = volume_element(jet, scale) / 3;
  };
  double volume = 0;
  for (int face : body.shells[shell].faces)
    volume += outward(body.faces[face]) * integrate_over(body, face, integrands, 2, goal(accuracy, scale)).value[1];
  return scale.factor(4) * volume;
}

// A tetrahedron from the origin to a triangle a b c: with d = det(a, b, c),
//   V = d/6,   V c = d/24 s,   int r r^T = d/120 (s s^T + a a^T + b b^T + c c^T),   s = a + b + c    (Mirtich 1996)
MassProperties measure(const Mesh& mesh) {
  const Box3 box = bounds(mesh);
  if (box.empty()) return {};
  const Vec3 origin = box.center();
  std::array<double, kAllIntegrals> value{}, size{};
  const auto add = [&](int k, double term) {
    value[k] += term;
    size[k] += std::abs(term);
  };
  for (const Mesh::Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.points[t.point[0]] - origin, b = mesh.points[t.point[1]] - origin,
               c = mesh.points[t.point[2]] - origin, s = a + b + c;
    const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
    const double d = glm::dot(a, glm::cross(b, c));
    add(0, area);
    add(4, d / 6);
    const auto product = [&](int i, int j) { return s[i] * s[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]; };
    for (int k = 0; k < 3; ++k) {
      add(1 + k, area * s[k] / 3);
      add(5 + k, d * s[k] / 24);
      add(8 + k, d * product(k, k) / 120);
      add(11 + k, d * product(k, (k + 1) % 3) / 120);
    }
  }
  constexpr double kRoundings = 16;
  for (double& each : size) each *= kRoundings * std::numeric_limits<double>::epsilon();
  MassProperties result = properties_of(value, size, origin, box.diameter());
  result.closed = is_closed(mesh);
  return result;
}

Mat3 inertia_about(const MassProperties& properties, const Vec3& point) {
  const Vec3 d = properties.centroid - point;
  return properties.inertia + properties.volume.value * (glm::dot(d, d) * Mat3(1.0) - glm::outerProduct(d, d));
}

void principal_moments(const Mat3& inertia, Vec3& moments, Mat3& axes) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) matrix(i, j) = 0.5 * (inertia[i][j] + inertia[j][i]);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  for (int k = 0; k < 3; ++k) {
    moments[k] = solver.eigenvalues()[k];
    for (int i = 0; i < 3; ++i) axes[k][i] = solver.eigenvectors()(i, k);
  }
  if (glm::determinant(axes) < 0) axes[2] = -axes[2];
}

}  // namespace lekalo::geometry
