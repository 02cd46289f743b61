// A kink off the grid's lines would make all of them dense: the deviation of a cell that it passes falls with the
// cell's size, not with its square. Cells that it passes are left as they are by the grid, and their triangles are
// split here instead. Splits at the kink itself make the triangles follow it, so that two plane pieces need no more
// than a triangle or two for each cell; elsewhere, as at corners of kinks, halving goes on to the size of the sag.
#include "geometry/tessellation/breaks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "geometry/tessellation/grid_lines.h"

namespace lekalo::geometry {

namespace {

// So far inside of its ends a segment looks at the surface, as part of its length, and a triangle inside of its sides
// and corners, as part of the way to its middle: they may stand on a break. More than what find_break leaves open in
// what becomes of a side by and by, and breaks so near to an end count as there.
constexpr double kInside = 1e-5;
// Points of a triangle that are measured stand in a lattice of so many steps; one kink deviates by at most 4/3 of what
// is seen there.
constexpr int kLattice = 4;
constexpr double kSeen = 0.75;
// A triangle less high than this part of the sag has no plane worth the name.
constexpr double kThin = 0.1;
// Deviations at breaks that are this part of the largest are worth a split there.
constexpr double kWorthFollowing = 0.3;
// What a point and its limit from inside a triangle may differ by, as part of the sag, and be one: beside a singular
// point the limit is not reached yet.
constexpr double kSamePlace = 0.5;
// Triangles this small or thin, as part of the domain or of their length, are not split whatever they deviate by.
constexpr double kSmallest = 1e-9, kThinnest = 1e-8;

Vec2 mix(const Vec2& a, const Vec2& b, double at) { return (1 - at) * a + at * b; }

bool is_finite(const Vec3& x) { return std::isfinite(x.x + x.y + x.z); }

// Halves [kInside, 1 - kInside] towards the larger change of a value.
template <class Value>
std::optional<double> bisect(const Value& value, double least) {
  double lo = kInside, hi = 1 - kInside;
  Vec3 at_lo = value(lo), at_hi = value(hi);
  const double limit = std::max(least, 0.25 * glm::length(at_hi - at_lo));
  while (hi - lo > 1e-12) {
    if (!(glm::length(at_hi - at_lo) >= limit)) return std::nullopt;
    const double middle = 0.5 * (lo + hi);
    const Vec3 at_middle = value(middle);
    if (glm::length(at_middle - at_lo) > glm::length(at_hi - at_middle))
      hi = middle, at_hi = at_middle;
    else
      lo = middle, at_lo = at_middle;
  }
  return 0.5 * (lo + hi);
}

// A triangle that is being split.
struct Piece {
  std::array<int32_t, 3> point;
  std::array<Vec2, 3> uv;
};

class BreakSplitter {
 public:
  BreakSplitter(Mesh& mesh, const BrokenMesh& part, const TessellationTolerance& tolerance)
      : mesh_(mesh), part_(part), surface_(part.surface), tolerance_(tolerance) {
    touched_.resize(mesh.points.size(), 0);
    face_ = mesh.triangles[part.over.front()].face;
  }

  void run() {
    std::vector<char> taken(mesh_.triangles.size() - part_.first, 0);
    const auto take = [&](size_t index) {
      const Mesh::Triangle& t = mesh_.triangles[index];
      Piece piece{t.point, {}};
      for (int k = 0; k < 3; ++k) piece.uv[k] = mesh_.parameters[t.parameter[k]];
      taken[index - part_.first] = 1;
      waiting_.push_back(piece);
    };
    for (int index : part_.over) take(index);
    while (!waiting_.empty()) {
      split_waiting();
      for (size_t i = part_.first; i < mesh_.triangles.size(); ++i)
        if (!taken[i - part_.first] && split_side(mesh_.triangles[i].point) >= 0) take(i);
      std::vector<Piece> finished;
      finished.swap(done_);
      for (const Piece& piece : finished) (split_side(piece.point) < 0 ? done_ : waiting_).push_back(piece);
    }
    size_t kept = part_.first;
    for (size_t i = part_.first; i < mesh_.triangles.size(); ++i)
      if (!taken[i - part_.first]) mesh_.triangles[kept++] = mesh_.triangles[i];
    mesh_.triangles.resize(kept);
    for (const Piece& piece : done_) emit(piece);
  }

 private:
  struct Split {
    double at;  // from the lower point
    int32_t point;
  };
  // What a triangle sees of the surface at a corner.
  struct Corner {
    Vec3 point, normal;
  };

  static uint64_t key(int32_t a, int32_t b) { return static_cast<uint64_t>(std::min(a, b)) << 32 | std::max(a, b); }

  // The side k, from corner k to the next, that is split already; -1 if none is.
  int split_side(const std::array<int32_t, 3>& point) const {
    for (int k = 0; k < 3; ++k) {
      const int32_t a = point[k], b = point[(k + 1) % 3];
      if (touched_[a] && touched_[b] && splits_.count(key(a, b))) return k;
    }
    return -1;
  }

  void split_waiting() {
    while (!waiting_.empty()) {
      const Piece piece = waiting_.back();
      waiting_.pop_back();
      if (split_side(piece.point) < 0) {
        const Fate fate = judge(piece);
        if (fate == Fate::keep) done_.push_back(piece);
        if (fate != Fate::split) continue;
      }
      const int k = split_side(piece.point), next = (k + 1) % 3;
      const int32_t a = piece.point[k], b = piece.point[next];
      const Split& split = splits_.at(key(a, b));
      const auto [from, to] = side(piece, k);
      Piece first = piece, second = piece;
      first.point[next] = second.point[k] = split.point;
      first.uv[next] = second.uv[k] = mix(from, to, a < b ? split.at : 1 - split.at);
      waiting_.push_back(first);
      waiting_.push_back(second);
    }
  }

  // The ends of a side; a pole stands where the other end is.
  std::array<Vec2, 2> side(const Piece& piece, int k) const {
    const int next = (k + 1) % 3;
    std::array<Vec2, 2> ends{piece.uv[k], piece.uv[next]};
    const auto a = part_.poles.find(piece.point[k]), b = part_.poles.find(piece.point[next]);
    if (a != part_.poles.end()) ends[0][a->second] = ends[1][a->second];
    if (b != part_.poles.end()) ends[1][b->second] = ends[0][b->second];
    return ends;
  }

  Corner corner(const Piece& piece, int k) const {
    const Vec2 middle = (piece.uv[0] + piece.uv[1] + piece.uv[2]) / 3.0, uv = mix(piece.uv[k], middle, kInside);
    const SurfaceJet jet = surface_.evaluate(uv.x, uv.y, 1);
    const Vec2 back = piece.uv[k] - uv;
    const Vec3 limit = jet.point() + back.x * jet.du() + back.y * jet.dv(), &own = mesh_.points[piece.point[k]];
    // The mesh's own point but where the surface jumps.
    return {is_finite(limit) && !is_same_place(limit, own) ? limit : own, surface_.normal(uv.x, uv.y, jet)};
  }

  bool is_same_place(const Vec3& a, const Vec3& b) const {
    return glm::length(a - b) <= kSamePlace * tolerance_.sag_near(b);
  }

  // What becomes of a triangle.
  enum class Fate { keep, split, drop };

  // Splits a side, at a break on it if that is what deviates, else the longest in its middle; or the triangle keeps its
  // tolerance as it is, or spans a step and is none of the surface.
  Fate judge(const Piece& piece) {
    const Vec2 middle = (piece.uv[0] + piece.uv[1] + piece.uv[2]) / 3.0;
    const std::array<Corner, 3> corners{corner(piece, 0), corner(piece, 1), corner(piece, 2)};
    const SurfaceJet jet = surface_.evaluate(middle.x, middle.y, 1);
    const Vec3 own = surface_.normal(middle.x, middle.y, jet);
    const double sag = tolerance_.sag_near(jet.point());
    const auto inside = [&](const Vec2& uv) { return mix(uv, middle, kInside); };
    // Deviation from the flat triangle along the normals that the surface has there, on both sides of a break, and
    // along the triangle's own, which means nothing where it is thin.
    const std::array<Vec3, 3> flat_side{corners[1].point - corners[0].point, corners[2].point - corners[1].point,
                                        corners[0].point - corners[2].point};
    const Vec3 cross = glm::cross(flat_side[0], flat_side[1]);
    const double area = glm::length(cross);
    const double reach = std::max({glm::length(flat_side[0]), glm::length(flat_side[1]), glm::length(flat_side[2])});
    const Vec3 flat_normal = area > kThin * sag * reach ? cross / area : Vec3(0);
    const auto excess = [&](const std::array<double, 3>& weight) {
      Vec2 uv(0);
      Vec3 flat(0);
      for (int k = 0; k < 3; ++k) uv += weight[k] * piece.uv[k], flat += weight[k] * corners[k].point;
      uv = inside(uv);
      const Vec3 offset = surface_.point(uv.x, uv.y) - flat;
      double result = std::max(std::abs(glm::dot(offset, own)), std::abs(glm::dot(offset, flat_normal)));
      for (const Corner& each : corners) result = std::max(result, std::abs(glm::dot(offset, each.normal)));
      return result / (kSeen * sag);
    };

    double worst = 0;
    for (int i = 0; i <= kLattice; ++i)
      for (int j = 0; i + j <= kLattice; ++j)
        if (std::max({i, j, kLattice - i - j}) < kLattice)
          worst = std::max(worst,
                           excess({double(i) / kLattice, double(j) / kLattice, double(kLattice - i - j) / kLattice}));
    // Sides and twice the area, without steps on them.
    std::array<Vec3, 3> along;
    std::array<double, 3> length;
    std::array<bool, 3> turns;
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      const Vec2 step = piece.uv[next] - piece.uv[k];
      along[k] = step.x * jet.du() + step.y * jet.dv();
      length[k] = glm::length(along[k]);
      turns[k] = length[k] > sag && glm::dot(corners[k].normal, corners[next].normal) < cosine_;
    }
    const double doubled_area = glm::length(glm::cross(along[0], along[1]));
    const bool deviates = worst > 1;
    if (!deviates && !turns[0] && !turns[1] && !turns[2]) return Fate::keep;

    const double longest = std::max({length[0], length[1], length[2]});
    const bool small = is_small(piece) || longest <= 0.5 * sag;
    const bool narrow = small || doubled_area <= 0.5 * sag * longest;
    int best = -1;
    double at = 0.5, most = kWorthFollowing * worst;
    for (int k = 0; k < 3; ++k) {
      const auto [from, to] = side(piece, k);
      const auto found = find_break(surface_, inside(from), inside(to));
      if (!found) continue;
      if (narrow && found->step) return Fate::drop;
      turns[k] = false;
      // On the side itself, if it is there as well: others split it too.
      const double place = find_break(surface_, from, to).value_or(*found).at;
      std::array<double, 3> weight{};
      weight[k] = 1 - place;
      weight[(k + 1) % 3] = place;
      const double here = found->step ? kInfinity : excess(weight);
      if (deviates && here > most && !is_fixed(piece, k)) best = k, at = place, most = here;
    }
    if (small) return Fate::keep;
    if (best < 0) {
      for (int k = 0; k < 3; ++k)
        if ((deviates || turns[k]) && !is_fixed(piece, k) && (best < 0 || length[k] > length[best])) best = k;
    }
    if (best < 0) return Fate::keep;
    add_split(piece, best, at);
    return Fate::split;
  }

  bool is_small(const Piece& piece) const {
    const Rectangle domain = surface_.domain();
    const Vec2 scale(1 / domain.u.width(), 1 / domain.v.width());
    const Vec2 a = scale * (piece.uv[1] - piece.uv[0]), b = scale * (piece.uv[2] - piece.uv[0]);
    const double longest = std::max({glm::length(a), glm::length(b), glm::length(b - a)});
    return longest < kSmallest || std::abs(a.x * b.y - a.y * b.x) < kThinnest * longest * longest;
  }

  bool is_fixed(const Piece& piece, int k) const {
    return part_.is_fixed && part_.is_fixed(piece.point[k], piece.point[(k + 1) % 3]);
  }

  void add_split(const Piece& piece, int k, double at) {
    if (static_cast<double>(mesh_.triangles.size() + done_.size()) > kMaxTriangles) refuse_mesh(kMaxTriangles);
    const int32_t a = piece.point[k], b = piece.point[(k + 1) % 3];
    const auto [from, to] = side(piece, k);
    const Vec2 uv = mix(from, to, at);
    splits_.emplace(key(a, b), Split{a < b ? at : 1 - at, static_cast<int32_t>(mesh_.points.size())});
    mesh_.points.push_back(surface_.point(uv.x, uv.y));
    touched_.push_back(0);
    touched_[a] = touched_[b] = 1;
  }

  void emit(const Piece& piece) {
    Mesh::Triangle triangle;
    triangle.face = face_;
    for (int k = 0; k < 3; ++k) {
      const Corner seen = corner(piece, k);
      triangle.point[k] = point_at(piece.point[k], seen.point);
      triangle.normal[k] = triangle.parameter[k] =
          attributes_at(triangle.point[k], piece.uv[k], part_.sign * seen.normal);
    }
    mesh_.triangles.push_back(triangle);
  }

  // The mesh point that stands for a place: the point itself, or another on the other side of a step.
  int32_t point_at(int32_t point, const Vec3& place) {
    if (is_same_place(place, mesh_.points[point])) return point;
    std::vector<int32_t>& others = others_[point];
    for (int32_t other : others)
      if (is_same_place(place, mesh_.points[other])) return other;
    others.push_back(static_cast<int32_t>(mesh_.points.size()));
    mesh_.points.push_back(place);
    return others.back();
  }

  int32_t attributes_at(int32_t point, const Vec2& uv, const Vec3& normal) {
    std::vector<int32_t>& known = attributes_[point];
    for (int32_t index : known)
      if (mesh_.parameters[index] == uv && glm::dot(mesh_.normals[index], normal) > 1 - 1e-9) return index;
    known.push_back(static_cast<int32_t>(mesh_.parameters.size()));
    mesh_.parameters.push_back(uv);
    mesh_.normals.push_back(normal);
    return known.back();
  }

  Mesh& mesh_;
  const BrokenMesh& part_;
  const Surface& surface_;
  const TessellationTolerance& tolerance_;
  const double cosine_ = std::cos(std::min(kPi, tolerance_.angle*(1 + 1e-6)));
  int32_t face_ = 0;
  std::vector<Piece> waiting_, done_;
  std::unordered_map<uint64_t, Split> splits_;
  std::vector<char> touched_;  // points at which split sides end
  std::unordered_map<int32_t, std::vector<int32_t>> others_, attributes_;
};

}  // namespace

std::optional<SurfaceBreak> find_break(const Surface& surface, const Vec2& from, const Vec2& to) {
  const auto point = [&](double at) {
    const Vec2 uv = mix(from, to, at);
    return surface.point(uv.x, uv.y);
  };
  const auto normal = [&](double at) {
    const Vec2 uv = mix(from, to, at);
    return surface.normal(uv.x, uv.y);
  };
  // What rounding makes of points and normals is no break.
  const double rounding = 1e-9 * (glm::length(point(0)) + glm::length(point(1)));
  if (const auto at = bisect(point, rounding)) return SurfaceBreak{*at, true};
  if (const auto at = bisect(normal, 1e-6)) return SurfaceBreak{*at, false};
  return std::nullopt;
}

void split_at_breaks(Mesh& mesh, const BrokenMesh& part, const TessellationTolerance& tolerance) {
  if (!part.over.empty()) BreakSplitter(mesh, part, tolerance).run();
}

}  // namespace lekalo::geometry
