#include "geometry/machining/drilling_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "geometry/describe.h"
#include "geometry/machining/route_path.h"

namespace lekalo::geometry {

double DrillingTask::time(int from, int to) const {
  const auto a = static_cast<size_t>(from), b = static_cast<size_t>(to);
  const double change = tools.empty() || tools[a] == tools[b] ? 0 : tool_change;
  return glm::length(holes[b] - holes[a]) / speed + change;
}

double DrillingTask::time(const std::vector<int>& order) const {
  double sum = closed ? time(order.back(), order.front()) : 0;
  for (size_t k = 1; k < order.size(); ++k) sum += time(order[k - 1], order[k]);
  return sum;
}

int DrillingTask::tool_changes(const std::vector<int>& order) const {
  int count = 0;
  for (size_t k = closed ? 0 : 1; k < order.size() && !tools.empty(); ++k) {
    const int before = order[k > 0 ? k - 1 : order.size() - 1];
    count += tools[static_cast<size_t>(before)] != tools[static_cast<size_t>(order[k])] ? 1 : 0;
  }
  return count;
}

std::vector<int> nearest_order(const DrillingTask& task) {
  std::vector<int> order{task.start};
  std::vector<bool> drilled(task.holes.size(), false);
  drilled[static_cast<size_t>(task.start)] = true;
  while (order.size() < task.holes.size()) {
    int nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < static_cast<int>(task.holes.size()); ++k)
      if (const double time = task.time(order.back(), k); !drilled[static_cast<size_t>(k)] && time < least)
        least = time, nearest = k;
    drilled[static_cast<size_t>(nearest)] = true;
    order.push_back(nearest);
  }
  return order;
}

// The part i..j turned round: (i-1, i) and (j, j+1) become (i-1, j) and (i, j+1).
std::vector<int> two_opt(const DrillingTask& task, std::vector<int> order) {
  const size_t n = order.size();
  for (bool shorter = true; shorter;) {
    shorter = false;
    for (size_t i = 1; i < n; ++i)
      for (size_t j = i; j < n; ++j) {
        const bool ends = j + 1 == n;
        const int a = order[i - 1], b = order[i], c = order[j], d = ends ? order[0] : order[j + 1];
        const bool has_next = !ends || task.closed;
        const double before = task.time(a, b) + (has_next ? task.time(c, d) : 0),
                     after = task.time(a, c) + (has_next ? task.time(b, d) : 0);
        if (!(after < before - 1e-12 * (before + after))) continue;
        std::reverse(order.begin() + static_cast<std::ptrdiff_t>(i),
                     order.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        shorter = true;
      }
  }
  return order;
}

namespace {

DrillingTask task_of(const Fields& f) {
  DrillingTask task;
  task.holes = f.points("holes");
  const size_t count = task.holes.size();
  if (f.has("tools")) {
    const std::vector<double>& tools = f.numbers("tools");
    if (tools.size() != count)
      throw FieldError("tools", fmt::format("{} tools for {} holes", tools.size(), count), "a number for each hole");
    for (const double tool : tools) {
      if (tool != std::floor(tool))
        throw FieldError("tools", fmt::format("{:g} is no number of a tool", tool), "1, 2, 3");
      task.tools.push_back(static_cast<int>(tool));
    }
  }
  task.speed = f.number("speed");
  task.tool_change = f.number("tool_change");
  task.closed = f.boolean("closed");
  task.start = f.integer("start");
  if (static_cast<size_t>(task.start) >= count)
    throw FieldError("start", fmt::format("there is no hole {}", task.start), fmt::format("the last is {}", count - 1));
  return task;
}

}  // namespace

TypeDeclaration drilling_order_type() {
  return declare(Category::curve, "drilling_order",
                 "The way of a drill over holes: to the nearest that is left, then shortened by turning parts of it "
                 "round (Zavyalov et al. 1985, V.3). Holes are numbered from 0.")
      .example("holes: [[0, 0], [4, 1], [1, 3], [5, 3], [2, 1], [3, 4]]")
      .field("holes", points().count(2, 2000), "where the holes are")
      .optional("tools", numbers().between(-1e6, 1e6), "numbers of the tools of the holes; one for all without it")
      .field("speed", number().positive(), "of the moves", "1")
      .field("tool_change", number().non_negative(), "time of a change between holes of different tools", "0")
      .field("closed", boolean(), "the way leads back to the first hole", "false")
      .field("start", integer().at_least(0), "the first hole", "0")
      .field("method", choice({"two_opt", "nearest"}), "nearest: without shortening", "two_opt")
      .shows({"drilling"})
      .built_by([](const Fields& f) -> std::any {
        DrillingPlan plan;
        plan.task = task_of(f);
        plan.nearest = nearest_order(plan.task);
        plan.order = f.text("method") == "nearest" ? plan.nearest : two_opt(plan.task, plan.nearest);
        std::vector<Vec3> points;
        for (const int hole : plan.order) points.push_back(plan.task.holes[static_cast<size_t>(hole)]);
        if (plan.task.closed) points.push_back(points.front());
        try {
          return CurvePtr(
              std::make_shared<PlannedPath<DrillingPlan>>(path_through(std::move(points)), std::move(plan)));
        } catch (const FieldError&) {
          throw FieldError("holes", "all holes are at one place");
        }
      });
}

}  // namespace lekalo::geometry
