// The scene type of milled pockets (Zavyalov et al. 1985, V.2).
#include <fmt/format.h>

#include "geometry/machining/pocket_plan.h"

namespace lekalo::geometry {

namespace {

PocketTools tools_of(const Fields& f) {
  PocketTools tools;
  tools.radius = f.number("tool_radius");
  tools.allowance = f.range("allowance");
  if (tools.allowance.lo < 0) throw FieldError("allowance", "the tool would cut into the contours", "from 0 on");
  tools.step = f.has("step") ? f.number("step") : tools.radius;
  if (tools.step > 2 * tools.radius)
    throw FieldError("step", "rows farther apart than the tool is wide leave ribs between them",
                     fmt::format("at most {:g}", 2 * tools.radius));
  tools.finishing_radius = f.has("finishing_radius") ? f.number("finishing_radius") : tools.radius;
  return tools;
}

std::vector<Vec3> rim_points(const PocketPlan& plan, int rim) {
  if (static_cast<size_t>(rim) >= plan.finishing.rims.size())
    throw FieldError("rim", fmt::format("there is no rim {}", rim),
                     fmt::format("the last is {}", plan.finishing.rims.size() - 1));
  std::vector<Vec3> points;
  for (const Vec2& corner : plan.finishing.rims[static_cast<size_t>(rim)]) points.push_back(Vec3(corner, plan.height));
  points.push_back(points.front());
  return points;
}

}  // namespace

TypeDeclaration pocket_type() {
  return declare(Category::curve, "pocket",
                 "Tool path that clears a pocket with islands (Zavyalov et al. 1985, V.2): zigzags in the trapezoids "
                 "into which lines from all corners divide it, in the order of a short way that visits them all; or "
                 "the path along its contours.")
      .example(
          "outer: { type: rectangle, size: [8, 5] }, islands: [{ type: circle, radius: 1 }], tool_radius: 0.3, "
          "allowance: [0.1, 0.2]")
      .field("outer", reference({Category::curve}), "closed contour, in a plane of constant z")
      .optional("islands", references({Category::curve}),
                "closed contours that are left standing inside of it; they may meet")
      .field("tool_radius", length().positive(), "of the tool that clears")
      .field("allowance", range(), "what it leaves at the contours: at least, at most; polygons run in between")
      .optional("step", length().positive(), "between the rows of a zigzag, at most; the tool's radius without it")
      .optional("finishing_radius", length().positive(),
                "of the tool that runs along the contours; that of the other one without it")
      .field("direction", direction(), "of the lines that divide the pocket, and of the rows", "y")
      .field("path", choice({"clearing", "finishing"}), "of which tool", "clearing")
      .field("rim", integer().at_least(0), "which of the finishing paths", "0")
      .shows({"region", "trapezoids", "finishing", "graph", "reduced_graph", "added_edges", "matching", "walk"})
      .built_by([](const Fields& f) -> std::any {
        PocketContours contours{f.curve("outer"), {}};
        if (f.has("islands"))
          for (const std::any& one : f.references("islands")) contours.islands.push_back(std::any_cast<CurvePtr>(one));
        std::vector<Vec3> points;
        PocketPlan plan = pocket_plan(contours, tools_of(f), f.vec3("direction"), points);
        if (f.text("path") == "finishing") points = rim_points(plan, f.integer("rim"));
        return CurvePtr(std::make_shared<PlannedPath<PocketPlan>>(path_through(std::move(points)), std::move(plan)));
      });
}

}  // namespace lekalo::geometry
