// Rational Bezier pieces prepared for lines: cut into flat cells, each of which keeps a first-order model only and
// finds its points on the whole piece.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "geometry/queries/rays/cell_model.h"
#include "geometry/queries/rays/line_cells.h"
#include "geometry/queries/rays/line_intersections.h"
#include "geometry/queries/rays/trimmed_hits.h"

namespace lekalo::geometry {

class PatchTarget final : public LineTarget {
 public:
  // All pieces rational. Cells with an area below `min_area` are not cut (scene units squared; 0: no limit).
  PatchTarget(SurfacePtr surface, std::vector<SurfacePiece> pieces, std::shared_ptr<const TrimRegion> trim,
              double min_area);

  int piece_count() const override { return static_cast<int>(cells_.size()); }
  std::string_view method() const override { return "Bezier pieces"; }
  Box3 piece_bounds(int i) const override;
  void piece_hits(int i, const PreparedLine& line, const Interval& t, LineHits& hits) const override;
  void group_hits(int first, int end, const unsigned* asked, const LineGroup& lines, GroupHits& hits) const override;
  bool meets_once(int i, const Vec3& direction) const override;
  SurfaceJet jet_at(int i, double u, double v, const Vec3& near) const override;
  const Surface& surface() const override { return *surface_; }
  size_t memory() const override;

 private:
  struct Patch {
    ParameterMap map_u, map_v;
    Rectangle domain;  // natural
    Interval s, t;     // rational parameters of the piece
    // Coordinates are relative to the piece's own centre: cutting and evaluation then round at the piece's size, not at
    // its distance from the origin.
    Vec3 center{0};
    Vec3 reach{0};  // no point of the piece is farther from the centre along x, y and z; zero: the piece is unbounded
    bool is_bounded() const { return reach.x > 0; }
    int degree_u = 0, degree_v = 0;
    size_t first_point = 0;
  };
  struct Cell {
    PatchCell cell;
    std::array<uint16_t, 3> lo, hi;  // box, in steps of the piece's reach; lo > hi: all of it
    uint32_t patch : 31;
    uint32_t whole : 1;  // all of it lies within the trim
  };
  class Cutter;
  void cut_all(double min_area);

  LineHit natural_hit(const Patch& patch, const PatchCell& cell, double foot_point, const CellHit& found) const;
  PatchView view_of(const Patch& patch) const {
    return {points_.data() + patch.first_point, patch.degree_u, patch.degree_v};
  }

  SurfacePtr surface_;
  HitFilter acceptance_;
  std::vector<Patch> patches_;
  std::vector<Cell> cells_;
  std::vector<Vec4> points_;
};

}  // namespace lekalo::geometry
