#include "geometry/queries/contours/contour_assembly.h"

#include <algorithm>
#include <cmath>

#include "geometry/queries/contours/contour_touching.h"

namespace lekalo::geometry {

namespace {

// More boxes than that: the surfaces may coincide or touch along a curve. Once they do somewhere they do in many
// pieces.
constexpr int kBoxesOfFirstTry = 2000, kBoxesOfLaterTries = 500;
// Parts of the size of the surfaces.
constexpr double kShortestBranch = 1e-9;  // shorter arcs are corners that the curve touches
constexpr double kBeside = 1e-3;          // so far off a border it is seen whether surfaces coincide there
// A solution so far outside of a piece, of its sides, is moved onto the border.
constexpr double kBorder = 1e-13;

// Where a contour of the neighbour's touches the border, a bit of it is moved onto it.
template <int N>
bool is_moved_onto_border(const SolutionArc<N>& arc, const ContourEquations<N>& equations) {
  const ParameterBox<N> domain = equations.domain();
  for (int i = 0; i < N; ++i)
    for (const double border : {domain[i].lo, domain[i].hi})
      if (std::all_of(arc.nodes.begin(), arc.nodes.end(), [&](const auto& node) { return node[i] == border; }))
        return true;
  return false;
}

// The equations of a piece as the search asks them.
template <int N>
struct Searched {
  static constexpr bool kThreadSafe = N == 2;  // what surfaces do over rectangles is kept for pairs of them
  const ContourEquations<N>& equations;
  std::array<KnownEnclosures, 2>& known;

  SystemValue<Interval, N, N - 1> enclose(const ParameterBox<N>& box) const { return equations.enclose(box, &known); }
  SystemValue<double, N, N - 1> evaluate(const ParameterPoint<N>& place) const { return equations.evaluate(place); }
  SystemValue<double, N, N - 1> evaluate_middle(const ParameterBox<N>& box) const {
    return equations.evaluate_middle(box, known);
  }
  std::array<double, N> extents(const ParameterBox<N>& box) const { return equations.extents(box, known); }
  Vec3 motion(const ParameterPoint<N>& place, const ParameterPoint<N>& by) const { return equations.motion(place, by); }
};

// The equations of contact likewise.
template <int N>
struct SearchedTouching {
  const TouchingEquations<N>& equations;
  std::array<KnownEnclosures, 2>& known;

  SystemValue<Interval, N, N + 1> enclose(const ParameterBox<N>& box) const { return equations.enclose(box); }
  SystemValue<double, N, N + 1> evaluate(const ParameterPoint<N>& place) const { return equations.evaluate(place); }
  SystemValue<double, N, N + 1> evaluate_middle(const ParameterBox<N>& box) const {
    ParameterPoint<N> middle;
    for (int i = 0; i < N; ++i) middle[i] = box[i].middle();
    return equations.evaluate(middle);
  }
  std::array<double, N> extents(const ParameterBox<N>& box) const { return equations.contour().extents(box, known); }
  Vec3 motion(const ParameterPoint<N>& place, const ParameterPoint<N>& by) const {
    return equations.contour().motion(place, by);
  }
};

template <int N>
ParameterPoint<N> middle_of(const ParameterPoint<N>& a, const ParameterPoint<N>& b) {
  ParameterPoint<N> middle;
  for (int i = 0; i < N; ++i) middle[i] = 0.5 * (a[i] + b[i]);
  return middle;
}

}  // namespace

// Whether an arc runs along an upper border that is a neighbour's lower one.
template <int N>
bool ContourAssembly<N>::is_left(const ContourEquations<N>& equations, const SolutionArc<N>& arc, ContourKind kind,
                                 const std::array<bool, N>& left_to_neighbour) {
  for (int i = 0; i < N; ++i)
    if (left_to_neighbour[i] && runs_along(equations, arc, kind, i, equations.domain()[i].hi)) return true;
  return false;
}

template <int N>
void ContourAssembly<N>::add(std::unique_ptr<const ContourEquations<N>> given, const PieceSearch<N>& search) {
  const EquationsPtr equations = std::move(given);
  const ParameterBox<N> domain = equations->domain();
  if (!searched_) searched_ = domain;
  for (int i = 0; i < N; ++i) (*searched_)[i] = hull((*searched_)[i], domain[i]);
  SolutionCurveOptions<N> options;
  options.least = std::min(kMinContourImage * size_, search.least);
  options.rounding_of_places = search.rounding_of_places;
  for (int i = 0; i < N; ++i) options.slack[i] = kBorder * domain[i].width();
  options.rounding.fill(equations->rounding());
  const int max_boxes = options.max_boxes;
  options.max_boxes = coincident_ ? kBoxesOfLaterTries : kBoxesOfFirstTry;
  const Searched<N> searched{*equations, known_};
  SolutionCurves<N> found = search_solution_curves<N, N - 1>(searched, domain, options);
  if (!found.complete) {
    const TouchingPtr touching = equations->touching(equations);
    // Surfaces that coincide have no other contours of the pair: what seems to cross is their border.
    if (touching && add_borders(touching, options, options.settled)) {
      coincident_ = true;
      return;
    }
    if (touching) add_touching(touching, options, search.left_to_neighbour, options.settled);
    options.max_boxes = max_boxes;
    found = search_solution_curves<N, N - 1>(searched, domain, options);
  }
  complete_ = complete_ && found.complete;
  for (SolutionArc<N>& arc : found.arcs) {
    if (!is_left(*equations, arc, ContourKind::crossing, search.left_to_neighbour))
      add_part(Part{equations, std::move(arc), ContourKind::crossing, {}, 0});
  }
  if (found.complete)
    for (const ParameterBox<N>& box : found.open) open_.emplace_back(equations, box);
}

template <int N>
void ContourAssembly<N>::add_end(std::unique_ptr<const ContourEquations<N>> equations, const ParameterPoint<N>& place) {
  const Vec3 point = equations->point(place);
  places_.push_back({std::move(equations), place, point, next_up(tolerance_), -1, true});
}

template <int N>
void ContourAssembly<N>::add_part(Part part) {
  for (size_t k = 1; k < part.arc.nodes.size(); ++k)
    part.length += glm::length(part.equations->point(part.arc.nodes[k]) - part.equations->point(part.arc.nodes[k - 1]));
  // No contour of its own is that short and on the border.
  const bool is_moved = part.length < kMinContourImage * size_ && is_moved_onto_border(part.arc, *part.equations);
  if (part.length > kShortestBranch * size_ && !is_moved) parts_.push_back(std::move(part));
}

template <int N>
void ContourAssembly<N>::add_part(const TouchingPtr& touching, SolutionArc<N> arc, ContourKind kind) {
  Part part{touching->shared_contour(), std::move(arc), kind, {}, 0};
  for (size_t k = 0; k + 1 < part.arc.nodes.size(); ++k)
    part.own.push_back(strongest_at<N>(touching, middle_of<N>(part.arc.nodes[k], part.arc.nodes[k + 1])));
  add_part(std::move(part));
}

// Curves of solutions by least squares where the first `exact` equations hold to the tolerance.
template <int N>
SolutionCurves<N> ContourAssembly<N>::follow(const TouchingPtr& touching, int exact,
                                             const SolutionCurveOptions<N>& as) {
  SolutionCurveOptions<N, N + 1> options;
  options.least = as.least, options.slack = as.slack, options.max_boxes = as.max_boxes;
  options.rounding.fill(as.rounding[0]);
  // Slopes differ by up to the root of the distance.
  options.tolerance.fill(std::sqrt(tolerance_ * size_));
  for (int k = 0; k < exact; ++k) options.tolerance[k] = tolerance_;
  return search_solution_curves<N, N + 1>(SearchedTouching<N>{*touching, known_}, touching->contour().domain(),
                                          options);
}

// Where the solutions are too many for curves the surfaces may touch along some: these parts, and boxes that hold
// nothing else.
template <int N>
void ContourAssembly<N>::add_touching(const TouchingPtr& touching, const SolutionCurveOptions<N>& as,
                                      const std::array<bool, N>& left_to_neighbour,
                                      std::vector<ParameterBox<N>>& settled) {
  SolutionCurves<N> found = follow(touching, N - 1, as);
  if (!found.complete) return;
  for (SolutionArc<N>& arc : found.arcs) {
    settled.insert(settled.end(), arc.tubes.begin(), arc.tubes.end());
    if (!is_left(touching->contour(), arc, ContourKind::touching, left_to_neighbour))
      add_part(touching, std::move(arc), ContourKind::touching);
  }
}

// On how many sides of an arc the surfaces coincide: seen a short way off its middle. None for what is shorter than
// that.
template <int N>
std::optional<int> ContourAssembly<N>::coincident_sides(const TouchingEquations<N>& touching,
                                                        const SolutionArc<N>& arc) const {
  const auto point = [&](size_t k) { return touching.contour().point(arc.nodes[k]); };
  double length = 0;
  for (size_t k = 1; k < arc.nodes.size(); ++k) length += glm::length(point(k) - point(k - 1));
  if (!(length > kBeside * size_)) return std::nullopt;
  const size_t middle = arc.nodes.size() / 2;
  const ParameterPoint<N>& at = arc.nodes[middle];
  ParameterPoint<N> u{}, v{};
  u[0] = v[1] = 1;
  const Vec3 normal = glm::cross(touching.contour().motion(at, u), touching.contour().motion(at, v));
  const Vec3 across = glm::cross(normal, point(middle) - point(middle - 1));
  if (!(glm::length(across) > 0)) return std::nullopt;
  const Vec3 step = kBeside * size_ * glm::normalize(across);
  return int{touching.coincide_at(point(middle) + step, tolerance_)} +
         int{touching.coincide_at(point(middle) - step, tolerance_)};
}

// Where the surfaces coincide: the borders of the pieces, as far as they lie on the other and the surfaces do not
// coincide on both sides of them; where they do on neither they touch along the border. False where they do not
// coincide.
template <int N>
bool ContourAssembly<N>::add_borders(const TouchingPtr& touching, const SolutionCurveOptions<N>& as,
                                     std::vector<ParameterBox<N>>& settled) {
  bool coincident = false, complete = true;
  for (int i = 0; i < N; ++i)
    for (const bool upper : {false, true}) {
      if (touching->contour().is_pole(i, upper)) continue;
      const TouchingPtr border = border_of<N>(touching, i, upper);
      SolutionCurves<N> found = follow(border, N, as);
      complete = complete && found.complete;
      for (SolutionArc<N>& arc : found.arcs) {
        const std::optional<int> sides = coincident_sides(*touching, arc);
        if (!sides) continue;
        coincident = coincident || *sides > 0;
        if (*sides == 0) settled.insert(settled.end(), arc.tubes.begin(), arc.tubes.end());
        if (*sides < 2) add_part(border, std::move(arc), *sides == 1 ? ContourKind::border : ContourKind::touching);
      }
    }
  if (coincident) complete_ = complete_ && complete;
  return coincident;
}

// Pieces that meet at a corner only touch there, though their neighbours coincide.
template <int N>
bool ContourAssembly<N>::lies_where_surfaces_coincide(int point) const {
  if (!coincident_) return false;
  for (const SingularPlace& place : places_) {
    if (place.group != point) continue;
    const TouchingPtr touching = place.equations->touching(place.equations);
    if (!touching) continue;
    for (const Vec3& way : {Vec3(1, 0.3, 0.2), Vec3(-1, -0.3, -0.2), Vec3(0.2, 1, 0.3), Vec3(-0.2, -1, -0.3),
                            Vec3(0.3, 0.2, 1), Vec3(-0.3, -0.2, -1)})
      if (touching->coincide_at(place.point + kBeside * size_ * way, tolerance_)) return true;
  }
  return false;
}

template class ContourAssembly<2>;
template class ContourAssembly<4>;

}  // namespace lekalo::geometry
