#include "support/line_oracle.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lekalo::oracle {

namespace {

constexpr int kMaxDegree = 15;
constexpr size_t kMaxCells = 4096;
constexpr double kPlace = 1e-6;  // of the size: what is longer is no place

Vec4 casteljau(std::vector<Vec4> c, double t) {
  for (size_t k = c.size() - 1; k > 0; --k)
    for (size_t i = 0; i < k; ++i) c[i] = (1 - t) * c[i] + t * c[i + 1];
  return c[0];
}

}  // namespace

PatchOracle::PatchOracle(std::vector<Vec4> points, int degree_u, int degree_v)
    : points_(std::move(points)), p_(degree_u), q_(degree_v) {
  if (points_.size() > kMaxPoints || p_ > kMaxDegree || q_ > kMaxDegree)
    throw std::invalid_argument("the oracle has no room for such degrees");
  bool convex = true;
  for (const Vec4& h : points_) {
    center_ += Vec3(h) / h.w / double(points_.size());
    convex = convex && h.w > 0;
  }
  for (Vec4& h : points_) {
    for (int axis = 0; axis < 3; ++axis)
      h[axis] = static_cast<double>(static_cast<long double>(h[axis]) - static_cast<long double>(h.w) * center_[axis]);
    radius_ = std::max(radius_, glm::length(Vec3(h) / h.w));
  }
  if (!convex) radius_ = geometry::kInfinity;
}

std::vector<Root> PatchOracle::roots(const Line& given, bool* undecided) const {
  // The line with its origin at its foot point near the patch.
  long double along = 0, square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    along += (static_cast<long double>(center_[axis]) - given.origin[axis]) * given.direction[axis];
    square += static_cast<long double>(given.direction[axis]) * given.direction[axis];
  }
  const long double foot_point = along / square;
  Line line{Vec3(0), given.direction};
  for (int axis = 0; axis < 3; ++axis)
    line.origin[axis] = static_cast<double>(given.origin[axis] + foot_point * given.direction[axis] -
                                            static_cast<long double>(center_[axis]));
  if (glm::length(line.origin) > radius_ * (1 + 1e-9)) return {};

  const Vec3 across = std::abs(line.direction.x) < 0.6 * glm::length(line.direction) ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 n1 = glm::normalize(glm::cross(line.direction, across));
  const Vec3 n2 = glm::normalize(glm::cross(line.direction, n1));
  Net net;
  double largest = 0;
  for (size_t k = 0; k < points_.size(); ++k) {
    const Vec3 r = Vec3(points_[k]) - points_[k].w * line.origin;
    net[k] = {glm::dot(n1, r), glm::dot(n2, r)};
    largest = std::max(largest, glm::length(Vec3(points_[k])) + std::abs(points_[k].w) * glm::length(line.origin));
  }
  Search search{4 * 2.3e-16 * largest, {}, false};
  halve(net, 0.5, 0.5, 0.5, 0.5, search);
  if (search.full && undecided) {
    *undecided = true;
    return {};
  }
  bool runs_along = false;
  std::vector<Root> found = cluster(std::move(search.cells), line, runs_along);
  if (undecided) *undecided = runs_along;
  for (Root& root : found) root.t = static_cast<double>(foot_point + root.t);
  return found;
}

Vec3 PatchOracle::local_point(double u, double v) const {
  std::vector<Vec4> row(p_ + 1);
  for (int i = 0; i <= p_; ++i)
    row[i] = casteljau({points_.begin() + i * (q_ + 1), points_.begin() + (i + 1) * (q_ + 1)}, v);
  const Vec4 h = casteljau(row, u);
  return Vec3(h) / h.w;
}

double PatchOracle::extent(const Net& net, bool along_u) const {
  Vec2 largest(0);
  for (int i = 0; i <= p_ - along_u; ++i)
    for (int j = 0; j <= q_ - !along_u; ++j) {
      const int k = i * (q_ + 1) + j, next = along_u ? k + q_ + 1 : k + 1;
      largest = glm::max(largest, glm::abs(net[next] - net[k]));
    }
  return std::max(largest.x, largest.y) * (along_u ? p_ : q_);
}

void PatchOracle::split(const Net& net, bool along_u, Net& a, Net& b) const {
  const int n = along_u ? p_ : q_, rows = along_u ? q_ + 1 : p_ + 1, stride = along_u ? q_ + 1 : 1;
  for (int r = 0; r < rows; ++r) {
    const int base = along_u ? r : r * (q_ + 1);
    std::array<Vec2, kMaxDegree + 1> work;
    for (int i = 0; i <= n; ++i) work[i] = net[base + i * stride];
    for (int k = 0; k <= n; ++k) {
      a[base + k * stride] = work[0];
      b[base + (n - k) * stride] = work[n - k];
      for (int i = 0; i < n - k; ++i) work[i] = 0.5 * (work[i] + work[i + 1]);
    }
  }
}

bool PatchOracle::excludes_line(const Net& net, double slack) const {
  const size_t count = points_.size();
  // Whether all points are on one side of the line through the origin along `side`, farther from it than `room`.
  const auto is_beside = [&](const Vec2& side, double room) {
    const double first = side.x * net[0].y - side.y * net[0].x;
    const Vec2 across = first > 0 ? side : -side;
    size_t k = 0;
    while (k < count && across.x * net[k].y - across.y * net[k].x > room) ++k;
    return k == count;
  };
  if (is_beside({1, 0}, slack) || is_beside({0, 1}, slack)) return true;
  for (const size_t end : {static_cast<size_t>(p_) * (q_ + 1), static_cast<size_t>(q_)}) {
    const Vec2 side = net[end] - net[0];
    const double length = glm::length(side);
    if (length > slack && is_beside(side / length, 2 * slack)) return true;
  }
  return false;
}

void PatchOracle::halve(const Net& net, double u, double v, double hu, double hv, Search& search) const {
  if (search.full || excludes_line(net, search.slack)) return;
  const double extent_u = extent(net, true), extent_v = extent(net, false);
  // Near a collapsed edge one direction is far shorter in space than the other, down to what the arithmetic can tell.
  const bool done_u = hu < 5e-12 || extent_u <= search.slack, done_v = hv < 5e-12 || extent_v <= search.slack;
  if (done_u && done_v) {
    search.cells.push_back({u, v, hu, hv});
    search.full = search.cells.size() >= kMaxCells;
    return;
  }
  const bool along_u = done_v || (!done_u && extent_u >= extent_v);
  Net a, b;
  split(net, along_u, a, b);
  const double du = along_u ? hu / 2 : 0, dv = along_u ? 0 : hv / 2;
  halve(a, u - du, v - dv, along_u ? hu / 2 : hu, along_u ? hv : hv / 2, search);
  halve(b, u + du, v + dv, along_u ? hu / 2 : hu, along_u ? hv : hv / 2, search);
}

std::vector<Root> PatchOracle::cluster(std::vector<Cell> cells, const Line& line, bool& runs_along) const {
  std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.u < b.u; });
  double widest = 0;
  for (const Cell& cell : cells) widest = std::max(widest, cell.hu);
  const double per_length2 = 1 / glm::dot(line.direction, line.direction);
  const auto along = [&](const Vec3& x) { return glm::dot(x - line.origin, line.direction) * per_length2; };
  std::vector<int> group(cells.size());
  for (size_t i = 0; i < cells.size(); ++i) group[i] = static_cast<int>(i);
  const auto find = [&](int i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  for (size_t i = 0; i < cells.size(); ++i)
    for (size_t j = i + 1; j < cells.size() && cells[j].u - cells[i].u < 1e-9 + cells[i].hu + widest; ++j)
      if (std::abs(cells[i].u - cells[j].u) < 1e-9 + cells[i].hu + cells[j].hu &&
          std::abs(cells[i].v - cells[j].v) < 1e-9 + cells[i].hv + cells[j].hv)
        group[find(static_cast<int>(i))] = find(static_cast<int>(j));
  std::vector<Root> roots;
  for (size_t i = 0; i < cells.size(); ++i) {
    if (find(static_cast<int>(i)) != static_cast<int>(i)) continue;
    double u = 0, v = 0, n = 0, first = geometry::kInfinity, last = -geometry::kInfinity;
    const auto reaches = [&](const Cell& c, double du, double dv) {
      const double t = along(local_point(c.u + du, c.v + dv));
      first = std::min(first, t);
      last = std::max(last, t);
    };
    for (size_t j = 0; j < cells.size(); ++j) {
      if (find(static_cast<int>(j)) != static_cast<int>(i)) continue;
      const Cell& c = cells[j];
      u += c.u, v += c.v, n += 1;
      if (std::max(c.hu, c.hv) < 1e-9) continue;
      for (const double side : {-1, 1}) reaches(c, side * c.hu, side * c.hv), reaches(c, side * c.hu, -side * c.hv);
    }
    u /= n;
    v /= n;
    runs_along = runs_along || last - first > kPlace * radius_ * std::sqrt(per_length2);
    roots.push_back({along(local_point(u, v)), u, v});
  }
  std::sort(roots.begin(), roots.end(), [](const Root& a, const Root& b) { return a.t < b.t; });
  return roots;
}

}  // namespace lekalo::oracle
