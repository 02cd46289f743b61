#include "geometry/queries/measures/shape_measures.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include "geometry/spatial/box_tree.h"

namespace lekalo::geometry {

namespace {

constexpr int kShifts = 16;
constexpr int kLines = 1 << 13;  // of one shift, about
// What n lines did not meet is met by less than this / n of all, with the certainty of three standard deviations.
constexpr double kUnseen = 6;
// Parts whose boxes are so nearly of the size of their common box are looked at together.
constexpr double kLikeSize = 0.125;
// How many groups of parts before it a part is compared with.
constexpr size_t kCompared = 32;
// Hits lie in the boxes of their pieces but for this part of the coordinates.
constexpr double kBoxSlack = 1e-13;
// Of the lines, for crossings that are not where their parts should be.
constexpr double kStrayShare = 1.0 / 16;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

double area(const Box3& box) {
  const Vec3 d = box.size();
  return box.empty() ? 0 : 2 * (d.x * d.y + d.y * d.z + d.z * d.x);
}
Box3 hull(Box3 a, const Box3& b) {
  a.include(b);
  return a;
}

// Mean of several estimates, and the standard deviation of that mean.
template <class T>
class Estimates {
 public:
  void add(const T& x) {
    ++count_;
    const T off = x - mean_;
    mean_ += off / static_cast<double>(count_);
    squares_ += off * (x - mean_);  // Welford 1962
  }
  const T& mean() const { return mean_; }
  T deviation() const {
    using std::sqrt, glm::sqrt;
    return sqrt(squares_ / (static_cast<double>(count_) * (count_ - 1)));
  }

 private:
  int count_ = 0;
  T mean_{0}, squares_{0};
};

constexpr int kMaxDimensions = 5;
using CubePoint = std::array<double, kMaxDimensions>;

// Points of the lattice of the generalised golden ratio g (g^(D+1) = g + 1), shifted and wrapped into the unit cube of
// D dimensions (Roberts 2018).
class Lattice {
 public:
  explicit Lattice(int dimensions) : dimensions_(dimensions) {
    double g = 2;
    for (int i = 0; i < 60; ++i) g = std::pow(1 + g, 1.0 / (dimensions + 1));
    for (int d = 0; d < dimensions; ++d) powers_[d] = std::pow(g, -(d + 1));
  }
  void shift(std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    for (int d = 0; d < dimensions_; ++d) shift_[d] = unit(random);
  }
  CubePoint point(int k) const {
    CubePoint point{};
    for (int d = 0; d < dimensions_; ++d) {
      const double x = shift_[d] + k * powers_[d];
      point[d] = x - std::floor(x);
    }
    return point;
  }

 private:
  int dimensions_;
  CubePoint powers_{}, shift_{};
};

// What lines are aimed at together: parts in one box, or the pieces of one part.
struct Group {
  Box3 box;  // of one piece, where there are several
  int part = -1;
  int64_t pieces = 1;
  int lines = 0;                              // of one shift
  bool has_volume = false, has_area = false;  // lines to it met it
};

class Measurement {
 public:
  explicit Measurement(const Shape& shape) : shape_(shape), bounds_(shape.bounds()), parts_(shape.surface_parts()) {
    far_ = glm::length(glm::max(glm::abs(bounds_.lo), glm::abs(bounds_.hi)));
    slack_ = kBoxSlack * far_;
    group_parts();
    find_solids();
    share_lines();
  }

  ShapeMeasures run() {
    for (int shift = 0; shift < kShifts; ++shift) {
      add_volumes(shift % 3);
      add_areas();
    }
    return result();
  }

 private:
  void group_parts();
  void find_solids();
  void share_lines();
  // Calls visit(group, piece, box, p, weight) for each line of one shift: the box that it is aimed at, numbers p for
  // its place and direction, of which it takes so many, and the share of the piece's surface that it stands for.
  template <class Visit>
  void each_aim(int numbers, const Visit& visit) {
    for (Group& group : groups_) {
      if (group.lines == 0) continue;
      Lattice lattice(numbers + (group.pieces > 1 ? 1 : 0));  // one more chooses the piece
      lattice.shift(random_);
      const double weight = static_cast<double>(group.pieces) / group.lines;
      for (int k = 0; k < group.lines; ++k) {
        const CubePoint p = lattice.point(k);
        int64_t piece;
        const Box3 box = target(group, p[numbers], piece);
        if (!box.empty()) visit(group, piece, box, p, weight);
      }
    }
  }
  void cross(const Line& line) {
    hits_.clear();
    shape_.all_hits(line, Interval::entire(), hits_);
  }
  void add_volumes(int axis);
  void add_areas();
  ShapeMeasures result() const;

  Box3 box_of(const PieceOfSurface& piece) const {
    const Box3 box = shape_.piece_box(piece);
    return box.empty() ? box.inflated(slack_) : box;  // operands that touch may share a face's box but for rounding
  }
  // The box of the piece of a group that lines with this number in 0 to 1 are aimed at.
  Box3 target(const Group& group, double x, int64_t& piece) const {
    piece = 0;
    if (group.pieces == 1) return group.box;
    piece = std::min(static_cast<int64_t>(x * static_cast<double>(group.pieces)), group.pieces - 1);
    return box_of({group.part, piece});
  }
  // Whether a crossing counts with the lines to the group's piece in the box. Each counts with those of one piece.
  bool counts(const Group& group, int64_t piece, const Box3& box, const SurfaceHit& hit, const Vec3& place) const {
    if (strays_().lines == 0) return true;
    const PieceOfSurface at = shape_.piece_of(hit);
    const Group& own = groups_[group_of_[at.part]];
    if (&group == &strays_()) return !holds(own.pieces > 1 ? box_of(at) : own.box, place);
    return &own == &group && (own.pieces == 1 || at.piece == piece) && holds(box, place);
  }
  bool holds(const Box3& box, const Vec3& place) const { return box.inflated(slack_).contains(place); }
  const Group& strays_() const { return groups_.back(); }
  // Where lines along the axis are measured from: both ends of a chord agree. In the middle of a solid; of a chord that
  // is as short as the pieces at its ends, in its own.
  double origin_of(const SurfaceHit& in, const SurfaceHit& out, const Line& line, int axis) const {
    const int a = shape_.piece_of(in).part, b = shape_.piece_of(out).part;
    if (solid_of_[a] == solid_of_[b] && !(parts_[a].thin && parts_[b].thin))
      return solids_[solid_of_[a]].center()[axis];
    return line.at(0.5 * (in.t + out.t))[axis];
  }

  const Shape& shape_;
  Box3 bounds_;
  double far_ = 0;  // of the coordinates
  double slack_ = 0;
  std::vector<SurfacePart> parts_;
  std::vector<Group> groups_;  // the last is that of strays
  std::vector<int> group_of_;  // parts
  std::vector<Box3> solids_;   // that have nothing to do with each other
  std::vector<int> solid_of_;  // parts
  std::mt19937_64 random_{1};
  Estimates<double> area_, volume_;
  Estimates<Vec3> moment_;
  std::vector<SurfaceHit> hits_;
};

void Measurement::group_parts() {
  for (int part = 0; part < static_cast<int>(parts_.size()); ++part) {
    const int64_t pieces = parts_[part].pieces;
    const Box3 box = box_of({part, pieces / 2});
    size_t found = groups_.size();
    for (size_t k = groups_.size(); pieces == 1 && found == groups_.size() && k-- > 0;) {
      if (k + kCompared < groups_.size()) break;
      const Group& group = groups_[k];
      if (group.pieces > 1) continue;
      const double a = area(group.box), b = area(box), both = area(hull(group.box, box));
      if (both <= a + b && std::min(a, b) >= kLikeSize * both) found = k;
    }
    group_of_.push_back(static_cast<int>(found));
    if (found < groups_.size())
      groups_[found].box.include(box);
    else
      groups_.push_back({box, part, pieces});
  }
  groups_.push_back({bounds_});
}

// Solids whose boxes meet may be one: a chord ends on those that do.
void Measurement::find_solids() {
  const int count = static_cast<int>(parts_.size());
  std::vector<Box3> boxes;
  for (const SurfacePart& part : parts_) boxes.push_back(part.solid);
  std::vector<int> first(count);
  std::iota(first.begin(), first.end(), 0);
  const auto root = [&](int k) {
    while (first[k] != k) k = first[k] = first[first[k]];
    return k;
  };
  const BoxTree tree(boxes);
  for (int k = 0; k < count; ++k)
    if (!boxes[k].empty()) tree.around(boxes[k].inflated(slack_), [&](int other) { first[root(other)] = root(k); });
  solids_.resize(count);
  for (int k = 0; k < count; ++k) {
    solid_of_.push_back(root(k));
    solids_[solid_of_[k]].include(boxes[k]);
  }
}

// Half of the lines by the boxes' areas, for what is large, and half to all alike, for what is small.
void Measurement::share_lines() {
  double all = 0;
  int count = 0;
  const auto size = [&](const Group& group) { return static_cast<double>(group.pieces) * area(group.box); };
  for (const Group& group : groups_) {
    if (&group == &strays_() || group.box.empty()) continue;
    all += size(group);
    ++count;
  }
  for (Group& group : groups_) {
    if (group.box.empty() || &group == &strays_()) continue;
    group.lines = static_cast<int>(std::ceil(0.5 * kLines * (size(group) / all + 1.0 / count)));
  }
  const bool has_strays = count > 1 || groups_[0].pieces > 1;
  if (has_strays) groups_.back().lines = static_cast<int>(kLines * kStrayShare);
}

void Measurement::add_volumes(int z) {
  const int x = (z + 1) % 3, y = (z + 2) % 3;
  const Vec3 center = bounds_.center();
  Line line;
  line.direction = Vec3(0);
  line.direction[z] = 1;
  long double volume = 0;  // thousands of terms: their sum rounds less than they do
  Vec3 moment(0);
  each_aim(2, [&](Group& group, int64_t piece, const Box3& box, const CubePoint& p, double weight) {
    const Vec3 middle = box.center(), half = 0.5 * box.size();
    line.origin = middle;
    line.origin[x] += half[x] * (2 * p[0] - 1);
    line.origin[y] += half[y] * (2 * p[1] - 1);
    const double share = weight * 4 * half[x] * half[y];
    cross(line);
    for (size_t i = 0; i + 1 < hits_.size(); i += 2) {
      const double from = origin_of(hits_[i], hits_[i + 1], line, z);
      for (const size_t end : {i, i + 1}) {
        Vec3 place = line.at(hits_[end].t);
        if (!counts(group, piece, box, hits_[end], place)) continue;
        group.has_volume = true;
        const double length = (end == i ? -share : share) * (place[z] - from);
        place[z] = 0.5 * (place[z] + from);
        volume += length;
        moment += length * (place - center);
      }
    }
  });
  volume_.add(static_cast<double>(volume));
  moment_.add(moment);
}

void Measurement::add_areas() {
  double area = 0;
  each_aim(4, [&](Group& group, int64_t piece, const Box3& box, const CubePoint& p, double weight) {
    const double radius = 0.5 * box.diameter() + 2 * slack_, z = 2 * p[0] - 1, across = std::sqrt(1 - z * z);
    const Frame frame =
        frame_about(box.center(), Vec3(across * std::cos(kTwoPi * p[1]), across * std::sin(kTwoPi * p[1]), z));
    const double r = radius * std::sqrt(p[2]);
    const Line line{frame.point({r * std::cos(kTwoPi * p[3]), r * std::sin(kTwoPi * p[3]), 0}), frame.z};
    cross(line);
    for (const SurfaceHit& hit : hits_) {
      if (!counts(group, piece, box, hit, line.at(hit.t))) continue;
      group.has_area = true;
      area += weight * kTwoPi * radius * radius;
    }
  });
  area_.add(area);
}

ShapeMeasures Measurement::result() const {
  double unseen_area = 0, unseen_volume = 0;
  for (const Group& group : groups_) {
    if (group.lines == 0 || &group == &strays_()) continue;
    const double share = kUnseen * static_cast<double>(group.pieces) / (static_cast<double>(group.lines) * kShifts);
    if (!group.has_area) unseen_area += share * 0.5 * kPi * sqr(group.box.diameter());
    if (!group.has_volume) unseen_volume += share * area(group.box) / 6 * bounds_.diameter();
  }
  if (!(area_.mean() > 0 && volume_.mean() > 0))
    throw std::invalid_argument(
        "no line meets the shape: nothing is left of it, or it is too thin beside its parts to be measured");
  ShapeMeasures result;
  result.area.value = area_.mean();
  result.volume.value = volume_.mean();
  // A surface that is off by this much encloses so much more, and is, being about as thick as V/A, so much larger.
  const double off = 4 * kEpsilon * far_, thickness = result.volume.value / result.area.value;
  result.volume.error = 3 * volume_.deviation() + unseen_volume + off * result.area.value;
  result.area.error = 3 * area_.deviation() + unseen_area + off / thickness * result.area.value;
  const Vec3 from_center = moment_.mean() / result.volume.value;
  result.centroid = bounds_.center() + from_center;
  result.centroid_error = off + (3 * glm::length(moment_.deviation()) + glm::length(from_center) * result.volume.error +
                                 unseen_volume * bounds_.diameter()) /
                                    result.volume.value;
  return result;
}

}  // namespace

ShapeMeasures measure(const Shape& shape) {
  if (!shape.is_closed()) throw std::invalid_argument("the shape is not closed: it has no volume");
  const Box3 box = shape.bounds();
  if (!box.bounded() || box.empty()) throw std::invalid_argument("the shape is not bounded: it has no volume");
  return Measurement(shape).run();
}

}  // namespace lekalo::geometry
