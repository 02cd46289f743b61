#include "geometry/queries/contours/contour_assembly.h"

#include <algorithm>
#include <cmath>

#include "geometry/queries/contours/contour_singularity.h"

namespace lekalo::geometry {

namespace {

// Parts of the size of the surfaces.
constexpr double kSameEnd = 1e-8;     // ends of arcs on borders that are one place
constexpr double kSag = 0.1;          // of a chord of an arc, at most
constexpr double kSameEdge = 1e-9;    // of a side of all pieces: a place so near to it lies on a surface's edge
constexpr double kNearSingular = 60;  // of the least image: an arc that ends so near to a singular point ends there

// Directions so opposite go on from each other through a crossing.
constexpr double kStraightOn = -0.5;
constexpr double kSmooth = -0.9999;

}  // namespace

template <int N>
bool ContourAssembly<N>::runs_along(const ContourEquations<N>& equations, const SolutionArc<N>& arc, ContourKind kind,
                                    int parameter, double border) {
  // Contacts are known less well.
  const double near = (kind == ContourKind::crossing ? 1e-10 : 1e-7) * equations.domain()[parameter].width();
  const auto is_near = [&](const ParameterPoint<N>& x) { return std::abs(x[parameter] - border) <= near; };
  if (!std::all_of(arc.nodes.begin(), arc.nodes.end(), is_near)) return false;
  if (kind != ContourKind::crossing) return true;
  // A sliver between two nodes on the border is none.
  for (size_t k = 0; k + 1 < arc.nodes.size(); ++k) {
    ContourSegment<N> segment;
    // The solution does not outlive the equations.
    segment.equations = EquationsPtr(EquationsPtr(), &equations);
    segment.begin = arc.nodes[k], segment.end = arc.nodes[k + 1], segment.tube = arc.tubes[k];
    segment.from = equations.point(segment.begin), segment.to = equations.point(segment.end);
    if (segment.from == segment.to) continue;
    const ContourSolution<N> solution({segment}, false);
    const auto middle = solution.at(solution.domain().middle(), 0).x;
    if (std::abs(middle[parameter].value() - border) > near) return false;
  }
  return true;
}

// An arc along the border of a piece is found by the neighbour too.
template <int N>
bool ContourAssembly<N>::runs_along_border(const Part& part) const {
  const ParameterBox<N> domain = part.equations->domain();
  for (int i = 0; i < N; ++i)
    for (const double border : {domain[i].lo, domain[i].hi})
      if (runs_along(*part.equations, part.arc, part.kind, i, border)) return true;
  return false;
}

// Whether a node lies on another arc, within the sag of its chords; next to singular points arcs end anywhere near.
template <int N>
bool ContourAssembly<N>::lies_on(const Part& part, size_t node, const Part& other) const {
  const Vec3 at = part.equations->point(part.arc.nodes[node]);
  for (size_t i = 0; i + 1 < other.arc.nodes.size(); ++i) {
    const Vec3 from = other.equations->point(other.arc.nodes[i]);
    const Vec3 chord = other.equations->point(other.arc.nodes[i + 1]) - from;
    const double share = std::clamp(glm::dot(at - from, chord) / glm::dot(chord, chord), 0.0, 1.0);
    const double near = std::max(kSag * glm::length(chord), 10 * kMinContourImage * size_);
    if (glm::length(from + share * chord - at) < near) return true;
  }
  return false;
}

template <int N>
bool ContourAssembly<N>::is_same(const Part& part, const Part& known) const {
  if (part.kind != known.kind) return false;
  const size_t last = part.arc.nodes.size() - 1;
  if (part.kind != ContourKind::crossing) {
    // Where surfaces touch along a border the neighbours' arcs may end at other places.
    for (size_t k = 0; k <= last; ++k)
      if (!lies_on(part, k, known)) return false;
    return true;
  }
  if (std::abs(known.length - part.length) > 0.05 * part.length) return false;
  const auto end = [](const Part& p, bool at_end) {
    return p.equations->point(at_end ? p.arc.nodes.back() : p.arc.nodes.front());
  };
  // Where they end next to a singular point they do so anywhere near.
  const bool singular = part.arc.begins_singular || part.arc.ends_singular;
  const double near = (singular ? kNearSingular * kMinContourImage : kSameEnd) * size_;
  const auto meet = [&](bool a, bool b) { return glm::length(end(part, a) - end(known, b)) < near; };
  if (!(meet(false, false) && meet(true, true)) && !(meet(false, true) && meet(true, false))) return false;
  return last < 2 || lies_on(part, last / 2, known);
}

template <int N>
void ContourAssembly<N>::drop_doubles() {
  // The longest of those that touch along one curve stays.
  std::stable_sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) {
    const bool a_crosses = a.kind == ContourKind::crossing, b_crosses = b.kind == ContourKind::crossing;
    return a_crosses != b_crosses ? a_crosses : !a_crosses && a.length > b.length;
  });
  std::vector<Part> kept;
  std::vector<bool> on_border;
  for (Part& part : parts_) {
    // Where surfaces touch near a border both neighbours follow the curve.
    const bool along = part.kind != ContourKind::crossing || runs_along_border(part);
    bool known = false;
    for (size_t k = 0; along && !known && k < kept.size(); ++k) known = on_border[k] && is_same(part, kept[k]);
    if (known) continue;
    kept.push_back(std::move(part));
    on_border.push_back(along);
  }
  parts_ = std::move(kept);
}

template <int N>
void ContourAssembly<N>::find_singular_points() {
  for (const auto& [equations, box] : open_) {
    const ParameterPoint<N> place = singular_solution<N>(*equations, box, kNearSingular * kMinContourImage * size_);
    places_.push_back({equations, place, equations->point(place), equations->distance(place), -1, false});
  }
  for (SingularPlace& place : places_) {
    for (size_t k = 0; k < points_.size() && place.group < 0; ++k)
      if (glm::length(points_[k].point - place.point) <= 10 * kMinContourImage * size_)
        place.group = static_cast<int>(k);
    if (place.group < 0) {
      place.group = static_cast<int>(points_.size());
      points_.push_back(
          {{ContourPointKind::contact, place.point, {place.place.begin(), place.place.end()}, place.distance}});
    } else if (place.distance < points_[place.group].distance) {
      ContourPoint& point = points_[place.group];
      point.point = place.point, point.distance = place.distance;
      point.parameters.assign(place.place.begin(), place.place.end());
    }
  }
}

template <int N>
void ContourAssembly<N>::collect_ends() {
  for (size_t p = 0; p < parts_.size(); ++p) {
    const Part& part = parts_[p];
    for (const bool at_end : {false, true}) {
      const size_t last = part.arc.nodes.size() - 1;
      const ParameterPoint<N>& x = part.arc.nodes[at_end ? last : 0];
      const ParameterPoint<N>& before = part.arc.nodes[at_end ? last - 1 : 1];
      End end{static_cast<int>(p), at_end, at_end ? part.arc.ends_singular : part.arc.begins_singular, false,
              part.equations->point(x)};
      for (int i = 0; i < N; ++i)
        for (const bool upper : {false, true})
          end.at_pole =
              end.at_pole || (part.equations->is_pole(i, upper) &&
                              x[i] == (upper ? part.equations->domain()[i].hi : part.equations->domain()[i].lo));
      // The tangent, to the side of the chord; the chord where there is none.
      const Vec3 chord = end.point - part.equations->point(before);
      ParameterPoint<N> scale;
      for (int i = 0; i < N; ++i) scale[i] = part.equations->domain()[i].width();
      ParameterPoint<N> direction = solution_curves::direction_of<N, N - 1>(
          part.equations_of(at_end ? last - 1 : 0)->evaluate(x).derivative, scale);
      for (int i = 0; i < N; ++i) direction[i] *= scale[i];
      const Vec3 tangent = part.equations->motion(x, direction);
      const double side = glm::dot(tangent, chord), lengths = glm::length(tangent) * glm::length(chord);
      end.outward =
          std::abs(side) > 0.5 * lengths ? (side > 0 ? 1.0 : -1.0) * glm::normalize(tangent) : glm::normalize(chord);
      ends_.push_back(end);
    }
  }
  for (End& end : ends_)
    if (!parts_[end.part].arc.closed) attach_singular(end);
  // What begins and ends at one singular point, and leaves it by no more than the search resolves, is none.
  for (size_t p = 0; p < parts_.size(); ++p) {
    End &begin = ends_[end_index(static_cast<int>(p), false)], &end = ends_[end_index(static_cast<int>(p), true)];
    const bool debris = begin.singular_point >= 0 && begin.singular_point == end.singular_point &&
                        parts_[p].length <= 3 * kNearSingular * kMinContourImage * size_;
    if (debris) begin.singular_point = end.singular_point = kDropped;
  }
}

template <int N>
void ContourAssembly<N>::attach_singular(End& end) {
  // Where surfaces touch the neighbours' boxes stay open beside the curve's ends: these are no ends of it.
  if (!end.singular && parts_[end.part].kind != ContourKind::crossing) return;
  double nearest = (end.singular ? kNearSingular : 1.0) * kMinContourImage * size_;
  for (const SingularPlace& place : places_) {
    const double apart = glm::length(place.point - end.point);
    if (!place.is_added && apart <= nearest) nearest = apart, end.singular_point = place.group;
  }
}

// What goes on nowhere ends at the added place near it.
template <int N>
void ContourAssembly<N>::attach_rest() {
  for (End& end : ends_) {
    if (end.singular_point != kRegular || end.mate_part >= 0 || parts_[end.part].arc.closed) continue;
    double nearest = kNearSingular * kMinContourImage * size_;
    for (const SingularPlace& place : places_) {
      const double apart = glm::length(place.point - end.point);
      if (place.is_added && apart <= nearest) nearest = apart, end.singular_point = place.group;
    }
    if (end.singular_point >= 0) points_[end.singular_point].kind = ContourPointKind::end;
  }
}

template <int N>
void ContourAssembly<N>::pair(std::vector<int> group, bool all) {
  while (group.size() > 1) {
    int best_a = -1, best_b = -1;
    double best = 2;
    for (size_t a = 0; a < group.size(); ++a)
      for (size_t b = a + 1; b < group.size(); ++b) {
        if (parts_[ends_[group[a]].part].kind != parts_[ends_[group[b]].part].kind) continue;
        const double with = glm::dot(ends_[group[a]].outward, ends_[group[b]].outward);
        if (with < best) best = with, best_a = static_cast<int>(a), best_b = static_cast<int>(b);
      }
    if (best_a < 0 || !(best < kStraightOn || (all && group.size() == 2))) return;
    End &a = ends_[group[best_a]], &b = ends_[group[best_b]];
    // What runs into an apex ends there, unless the surface is smooth.
    if (a.at_pole && b.at_pole && !(best < kSmooth)) return;
    a.mate_part = b.part, a.mate_at_end = b.at_end;
    b.mate_part = a.part, b.mate_at_end = a.at_end;
    group.erase(group.begin() + best_b);
    group.erase(group.begin() + best_a);
  }
}

template <int N>
void ContourAssembly<N>::pair_ends() {
  for (size_t k = 0; k < points_.size(); ++k) {
    std::vector<int> group;
    for (size_t e = 0; e < ends_.size(); ++e)
      if (ends_[e].singular_point == static_cast<int>(k)) group.push_back(static_cast<int>(e));
    if (group.size() > 2) points_[k].kind = ContourPointKind::crossing;
    // Curves of contact meet in poles at most, where they are not followed.
    if (group.size() > 2 && std::any_of(group.begin(), group.end(),
                                        [&](int e) { return parts_[ends_[e].part].kind == ContourKind::touching; }))
      complete_ = false;
    if (group.size() == 1 || group.size() == 2) points_[k].kind = ContourPointKind::end;
    // Where a curve goes on smoothly only its parameters are singular.
    points_[k].passed = group.size() == 2 && glm::dot(ends_[group[0]].outward, ends_[group[1]].outward) < kSmooth;
    pair(group, true);
  }
  std::vector<bool> taken(ends_.size(), false);
  for (size_t e = 0; e < ends_.size(); ++e) {
    if (taken[e] || ends_[e].singular_point != kRegular || parts_[ends_[e].part].arc.closed) continue;
    std::vector<int> group;
    for (size_t f = e; f < ends_.size(); ++f)
      if (!taken[f] && ends_[f].singular_point == kRegular && !parts_[ends_[f].part].arc.closed &&
          glm::length(ends_[f].point - ends_[e].point) <= kSameEnd * size_)
        group.push_back(static_cast<int>(f)), taken[f] = true;
    pair(group, true);
  }
}

template <int N>
void ContourAssembly<N>::append(const Part& part, bool backwards, ParameterPoint<N>& shift,
                                std::vector<ContourSegment<N>>& segments) const {
  const auto& nodes = part.arc.nodes;
  const size_t count = nodes.size();
  for (size_t k = 0; k + 1 < count; ++k) {
    const size_t from = backwards ? count - 1 - k : k, to = backwards ? from - 1 : from + 1;
    ContourSegment<N> segment{part.equations_of(std::min(from, to)),
                              nodes[from],
                              nodes[to],
                              part.arc.tubes[std::min(from, to)],
                              {},
                              {},
                              {},
                              {}};
    if (k == 0 && !segments.empty())
      for (int i = 0; i < N; ++i)
        if (periods_[i] > 0) {
          const double before = segments.back().end[i] + segments.back().shift[i];
          shift[i] = periods_[i] * std::round((before - segment.begin[i]) / periods_[i]);
        }
    segment.shift = shift;
    segment.from = segments.empty() || k > 0 ? part.equations->point(nodes[from]) : segments.back().to;
    segment.to = part.equations->point(nodes[to]);
    if (segment.from != segment.to) segments.push_back(std::move(segment));
  }
}

// From the end of an arc to the singular point next to it, or back from there.
template <int N>
void ContourAssembly<N>::append_straight(const End& end, bool inward, const ParameterPoint<N>& shift,
                                         std::vector<ContourSegment<N>>& segments) const {
  if (end.singular_point < 0) return;
  const Part& part = parts_[end.part];
  const ParameterPoint<N> at_arc = part.arc.nodes[end.at_end ? part.arc.nodes.size() - 1 : 0];
  ParameterPoint<N> at_point = at_arc;
  double nearest = kInfinity;
  for (const SingularPlace& place : places_) {
    if (place.group != end.singular_point || place.equations != part.equations) continue;
    double apart = 0;
    for (int i = 0; i < N; ++i) apart += std::abs(place.place[i] - at_arc[i]) / part.equations->domain()[i].width();
    if (apart < nearest) nearest = apart, at_point = place.place;
  }
  ContourSegment<N> segment{part.equations, inward ? at_point : at_arc, inward ? at_arc : at_point, {}, {}, {}, {}, {}};
  for (int i = 0; i < N; ++i) segment.tube[i] = {1, 0};
  segment.shift = shift;
  const Vec3 point = points_[end.singular_point].point;
  segment.from = inward ? point : end.point;
  segment.to = inward ? end.point : point;
  if (glm::length(segment.to - segment.from) > 1e-14 * size_) segments.push_back(std::move(segment));
}

template <int N>
Contour ContourAssembly<N>::branch_from(int first, std::vector<bool>& used) const {
  std::vector<ContourSegment<N>> segments;
  ParameterPoint<N> shift{};
  bool closed = false;
  int entry = first;
  for (;;) {
    const End& in = ends_[entry];
    const Part& part = parts_[in.part];
    used[in.part] = true;
    append_straight(in, true, shift, segments);
    append(part, in.at_end, shift, segments);
    if (part.arc.closed) {
      closed = true;
      break;
    }
    const End& out = ends_[end_index(in.part, !in.at_end)];
    append_straight(out, false, shift, segments);
    if (out.mate_part < 0) break;
    entry = end_index(out.mate_part, out.mate_at_end);
    if (entry == first) {
      closed = true;
      break;
    }
  }
  if (closed && segments.size() > 1) segments.back().to = segments.front().from;
  Contour contour;
  contour.closed = closed;
  contour.kind = parts_[ends_[first].part].kind;
  for (const ContourSegment<N>& segment : segments)
    contour.error = std::max(contour.error, segment.equations->distance(segment.begin));
  const auto solution = std::make_shared<const ContourSolution<N>>(std::move(segments), closed);
  for (const ContourSegment<N>& segment : solution->segments()) {
    if (!segment.is_certified()) continue;
    const auto at = solution->at(segment.t.middle(), 0);
    ParameterPoint<N> x;
    for (int i = 0; i < N; ++i) x[i] = at.x[i].c[0] - segment.shift[i];
    contour.error = std::max(contour.error, segment.equations->distance(x));
  }
  contour.curve = std::make_shared<ContourCurve<N>>(solution);
  for (int i = 0; i < N; i += 2) contour.images.push_back(std::make_shared<ContourImage<N>>(solution, i));
  return contour;
}

// A contact at the end of an arc of contact is no isolated one.
template <int N>
bool ContourAssembly<N>::lies_on_touching(const Vec3& point) const {
  return std::any_of(ends_.begin(), ends_.end(), [&](const End& end) {
    return parts_[end.part].kind != ContourKind::crossing &&
           glm::length(end.point - point) <= kNearSingular * kMinContourImage * size_;
  });
}

// Within a tube there is no other solution than the arc's: what seems a contact there is rounding beside a branch whose
// equations hardly change across it.
template <int N>
bool ContourAssembly<N>::lies_in_tubes(int point) const {
  return std::all_of(places_.begin(), places_.end(), [&](const SingularPlace& place) {
    if (place.group != point) return true;
    return std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) {
      return part.equations == place.equations &&
             std::any_of(part.arc.tubes.begin(), part.arc.tubes.end(), [&](const ParameterBox<N>& tube) {
               for (int i = 0; i < N; ++i)
                 if (!tube[i].contains(place.place[i])) return false;
               return true;
             });
    });
  });
}

// Whether a place lies on an edge of a surface, where it does not close.
template <int N>
bool ContourAssembly<N>::on_edge(const ParameterPoint<N>& place, double near) const {
  for (int i = 0; i < N; ++i) {
    const Interval& all = (*searched_)[i];
    if (periods_[i] == 0 && std::min(place[i] - all.lo, all.hi - place[i]) <= near * all.width()) return true;
  }
  return false;
}

// Whether a place lies in a pole about which the surface closes.
template <int N>
bool ContourAssembly<N>::at_closed_pole(const SingularPlace& place, double near) const {
  const ParameterBox<N> domain = place.equations->domain();
  for (int i = 0; i < N; ++i)
    for (const bool upper : {false, true})
      if (periods_[i ^ 1] > 0 && place.equations->is_pole(i, upper) &&
          std::abs(place.place[i] - (upper ? domain[i].hi : domain[i].lo)) <= near * domain[i].width())
        return true;
  return false;
}

// Curves end on the edges of surfaces and where add_end() says so: through all other places they go on, as many arcs
// towards each as from it, though in apexes none is the other's. What stops elsewhere has lost what follows.
template <int N>
bool ContourAssembly<N>::stops_inside(const End& end) const {
  constexpr double kNear = kNearSingular * kMinContourImage;
  const Part& part = parts_[end.part];
  if (end.mate_part >= 0 || end.singular_point == kDropped || part.arc.closed || end.at_pole) return false;
  const auto at_point = [&](const auto& has) {
    return std::any_of(places_.begin(), places_.end(),
                       [&](const SingularPlace& place) { return place.group == end.singular_point && has(place); });
  };
  if (at_point([](const SingularPlace& place) { return place.is_added; })) return false;
  if (at_point([&](const SingularPlace& place) { return at_closed_pole(place, kNear); }))
    return std::count_if(ends_.begin(), ends_.end(),
                         [&](const End& other) { return other.singular_point == end.singular_point; }) %
               2 !=
           0;
  return !on_edge(end.at_end ? part.arc.nodes.back() : part.arc.nodes.front(), kSameEdge) &&
         !at_point([&](const SingularPlace& place) { return on_edge(place.place, kNear); });
}

template <int N>
Contours ContourAssembly<N>::joined() {
  drop_doubles();
  find_singular_points();
  collect_ends();
  pair_ends();
  attach_rest();
  Contours result;
  result.complete =
      complete_ && std::none_of(ends_.begin(), ends_.end(), [this](const End& end) { return stops_inside(end); });
  result.coincident = coincident_;
  std::vector<bool> used(parts_.size(), false);
  // Open branches begin at an end that is joined with none; what is left then is closed.
  for (const bool open : {true, false})
    for (size_t e = 0; e < ends_.size(); ++e)
      if (!used[ends_[e].part] && ends_[e].singular_point != kDropped &&
          (!open || (ends_[e].mate_part < 0 && !parts_[ends_[e].part].arc.closed)))
        result.branches.push_back(branch_from(static_cast<int>(e), used));
  for (size_t k = 0; k < points_.size(); ++k) {
    const SingularPoint& point = points_[k];
    const bool contact = point.kind == ContourPointKind::contact;
    if (!point.passed &&
        !(contact && (point.distance > tolerance_ || lies_on_touching(point.point) ||
                      lies_in_tubes(static_cast<int>(k)) || lies_where_surfaces_coincide(static_cast<int>(k)))))
      result.points.push_back(point);
  }
  return result;
}

template class ContourAssembly<2>;
template class ContourAssembly<4>;

}  // namespace lekalo::geometry
