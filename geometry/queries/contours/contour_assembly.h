// Joins the arcs that the search finds on pieces of surfaces into the branches of a contour.
#pragma once

#include <memory>
#include <optional>

#include "geometry/contour.h"
#include "geometry/numerics/solution_curves.h"
#include "geometry/queries/contours/contour_curve.h"

namespace lekalo::geometry {

// Boxes with smaller images are not divided; a part of the surfaces' size.
inline constexpr double kMinContourImage = 1e-6;

// What a search of a piece is told beside its equations.
template <int N>
struct PieceSearch {
  // What runs along the upper border of these parameters is another piece's.
  std::array<bool, N> left_to_neighbour{};
  // Boxes with smaller images are not divided, a length; no more than 1e-6 of the size.
  double least = kInfinity;
  // How well places are known, of the piece's sides.
  double rounding_of_places = 1e-12;
};

// The search, with what is special where surfaces touch or coincide, is in contour_search.cpp; the joining in
// contour_assembly.cpp.
template <int N>
class ContourAssembly {
 public:
  // `size` of the surfaces together; `tolerance` is a length. `periods` of the parameters, 0 where there is none.
  ContourAssembly(double size, double tolerance, const std::array<double, N>& periods)
      : size_(size), tolerance_(tolerance), periods_(periods) {}

  // Searches a piece.
  void add(std::unique_ptr<const ContourEquations<N>> equations, const PieceSearch<N>& search = {});
  // A singular solution that no search finds: a curve that goes on nowhere else ends there; where none does it is no
  // point of contact.
  void add_end(std::unique_ptr<const ContourEquations<N>> equations, const ParameterPoint<N>& place);
  Contours joined();

 private:
  static constexpr int kRegular = -1, kDropped = -2;
  using EquationsPtr = std::shared_ptr<const ContourEquations<N>>;
  struct Part {
    EquationsPtr equations;
    SolutionArc<N> arc;
    ContourKind kind = ContourKind::crossing;
    std::vector<EquationsPtr> own;  // of each segment; where the kind is another than crossing
    double length = 0;
    const EquationsPtr& equations_of(size_t segment) const { return own.empty() ? equations : own[segment]; }
  };
  // An end of a part: `outward` is where the curve would go on.
  struct End {
    int part = 0;
    bool at_end = false;
    bool singular = false, at_pole = false;
    Vec3 point{0}, outward{0};
    int mate_part = -1;  // joined with
    bool mate_at_end = false;
    int singular_point = kRegular;  // where it ends
  };
  struct SingularPlace {
    EquationsPtr equations;
    ParameterPoint<N> place{};
    Vec3 point{0};
    double distance = 0;
    int group = -1;
    bool is_added = false;  // by add_end()
  };

  struct SingularPoint : ContourPoint {
    bool passed = false;  // by one smooth branch
  };

  void add_part(Part part);
  using TouchingPtr = std::shared_ptr<const TouchingEquations<N>>;
  SolutionCurves<N> follow(const TouchingPtr& touching, int exact, const SolutionCurveOptions<N>& as);
  void add_part(const TouchingPtr& touching, SolutionArc<N> arc, ContourKind kind);
  void add_touching(const TouchingPtr& touching, const SolutionCurveOptions<N>& as,
                    const std::array<bool, N>& left_to_neighbour, std::vector<ParameterBox<N>>& settled);
  std::optional<int> coincident_sides(const TouchingEquations<N>& touching, const SolutionArc<N>& arc) const;
  bool add_borders(const TouchingPtr& touching, const SolutionCurveOptions<N>& as,
                   std::vector<ParameterBox<N>>& settled);
  bool lies_on_touching(const Vec3& point) const;
  bool lies_in_tubes(int point) const;
  bool lies_where_surfaces_coincide(int point) const;
  bool lies_on(const Part& part, size_t node, const Part& other) const;
  bool is_same(const Part& part, const Part& known) const;
  void drop_doubles();
  static bool runs_along(const ContourEquations<N>& equations, const SolutionArc<N>& arc, ContourKind kind,
                         int parameter, double border);
  static bool is_left(const ContourEquations<N>& equations, const SolutionArc<N>& arc, ContourKind kind,
                      const std::array<bool, N>& left_to_neighbour);
  bool runs_along_border(const Part& part) const;
  void find_singular_points();
  void collect_ends();
  void attach_singular(End& end);
  void attach_rest();
  void pair_ends();
  void pair(std::vector<int> group, bool all);
  bool at_closed_pole(const SingularPlace& place, double near) const;
  bool on_edge(const ParameterPoint<N>& place, double near) const;
  bool stops_inside(const End& end) const;
  int end_index(int part, bool at_end) const { return 2 * part + (at_end ? 1 : 0); }
  Contour branch_from(int end, std::vector<bool>& used) const;
  void append(const Part& part, bool backwards, ParameterPoint<N>& shift,
              std::vector<ContourSegment<N>>& segments) const;
  void append_straight(const End& end, bool inward, const ParameterPoint<N>& shift,
                       std::vector<ContourSegment<N>>& segments) const;

  std::array<KnownEnclosures, 2> known_;
  double size_, tolerance_;
  std::array<double, N> periods_;
  std::optional<ParameterBox<N>> searched_;  // hull of the pieces
  std::vector<Part> parts_;
  std::vector<std::pair<EquationsPtr, ParameterBox<N>>> open_;
  std::vector<SingularPlace> places_;
  std::vector<SingularPoint> points_;  // groups of places
  std::vector<End> ends_;
  bool complete_ = true, coincident_ = false;
};

}  // namespace lekalo::geometry
