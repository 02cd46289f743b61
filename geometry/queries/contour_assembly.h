// Joins the arcs that the search finds on pieces of surfaces into the branches of a contour.
#pragma once

#include <memory>

#include "geometry/numerics/solution_curves.h"
#include "geometry/queries/contour_curve.h"
#include "geometry/queries/contours.h"

namespace lekalo::geometry {

template <int N>
class ContourAssembly {
 public:
  // `size` of the surfaces together; `tolerance` is a length. `periods` of the parameters, 0 where there is none.
  ContourAssembly(double size, double tolerance, const std::array<double, N>& periods)
      : size_(size), tolerance_(tolerance), periods_(periods) {}

  // Searches a piece. What runs along the upper border of a parameter in `left_to_neighbour` is another piece's. Boxes
  // with images below `least` (a length) are not divided; no more than 1e-6 of the size.
  void add(std::unique_ptr<const ContourEquations<N>> equations, const std::array<bool, N>& left_to_neighbour = {},
           double least = kInfinity);
  // A singular solution that no search finds: curves end there, but where none does it is no point of contact.
  void add_end(std::unique_ptr<const ContourEquations<N>> equations, const ParameterPlace<N>& place);
  Contours joined();

 private:
  static constexpr int kRegular = -1, kDropped = -2;
  using EquationsPtr = std::shared_ptr<const ContourEquations<N>>;
  struct Part {
    EquationsPtr equations;
    SolutionArc<N> arc;
    double length = 0;
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
    ParameterPlace<N> place{};
    Vec3 point{0};
    double distance = 0;
    int group = -1;
  };

  struct SingularPoint : ContourPoint {
    bool passed = false;  // by one smooth branch
  };

  void drop_doubles();
  bool runs_along(const Part& part, int parameter, double border) const;
  bool runs_along_border(const Part& part) const;
  SingularPlace refined(const EquationsPtr& equations, const ParameterBox<N>& box) const;
  void find_singular_points();
  void collect_ends();
  void attach_singular(End& end);
  void pair_ends();
  void pair(std::vector<int> group, bool all);
  int end_index(int part, bool at_end) const { return 2 * part + (at_end ? 1 : 0); }
  Contour branch_from(int end, std::vector<bool>& used) const;
  void append(const Part& part, bool backwards, ParameterPlace<N>& shift,
              std::vector<ContourSegment<N>>& segments) const;
  void append_straight(const End& end, bool inward, const ParameterPlace<N>& shift,
                       std::vector<ContourSegment<N>>& segments) const;

  std::array<KnownEnclosures, 2> known_;
  double size_, tolerance_;
  std::array<double, N> periods_;
  std::vector<Part> parts_;
  std::vector<std::pair<EquationsPtr, ParameterBox<N>>> open_;
  std::vector<SingularPlace> places_;
  std::vector<SingularPoint> points_;  // groups of places
  std::vector<End> ends_;
  bool complete_ = true;
};

}  // namespace lekalo::geometry
