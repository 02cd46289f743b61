// The parameter lines that pictures show: u and then v held at so many values, or at listed ones, on surfaces, on the
// faces of bodies as far as these go. (Those of balls and tubes: shapes/tube; of solids that are put together:
// shapes/csg.)
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "geometry/bodies/trims/trim.h"
#include "geometry/body.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

// Where u and v are held.
struct ParameterNet {
  ParameterValues u, v;
};

// Evenly spaced values with both ends of the range, or without the second where it is the first again; of listed values
// those in the range.
std::vector<double> values_in(const ParameterValues& asked, const Interval& range, bool periodic);

// True if the opposite edges of the domain are one line of space, which may run the other way there (a Moebius band).
bool is_closed_in(const Surface& surface, IsoDirection held);

// Over the whole of the other parameter, or a part of it.
struct NetLine {
  SurfacePtr surface;
  IsoDirection held = IsoDirection::u;
  double at = 0;
  Interval along;

  CurvePtr curve() const { return std::make_shared<ParameterLine>(surface, held, at, along); }
  Curve2Ptr image() const;
};
NetLine whole_line(const SurfacePtr& surface, IsoDirection held, double at);

// None of an unbounded surface, and none that is a point.
std::vector<NetLine> parameter_lines(const SurfacePtr& surface, const ParameterNet& net);
std::vector<NetLine> parameter_lines(const Body& body, const ParameterNet& net);

// A face; without a region it fills its surface's domain.
struct FaceRegion {
  SurfacePtr surface;
  std::shared_ptr<const TrimRegion> region;
  std::vector<Curve2Ptr> borders;
};
std::vector<FaceRegion> face_regions(const Body& body);
// Calls visit(line) for the parts of a parameter line that lie in the region of such a face, in its surface's domain.
void each_line_of_face(const FaceRegion& face, IsoDirection held, double at,
                       const std::function<void(const NetLine& line)>& visit);
// A whole number of periods that brings x into the range; 0 where none does.
double shift_into(const Interval& range, double x, double period);

}  // namespace lekalo::geometry
