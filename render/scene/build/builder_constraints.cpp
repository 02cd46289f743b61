// The section `constraints`, solved before everything else: its points become points of geometry, its variables
// parameters, its poses steps of transforms (Golovanov 2016, chapter 7).
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "geometry/constraints/conditions.h"
#include "geometry/expression/nearest_name.h"
#include "render/scene/build/builder.h"
#include "render/scene/build/constraint_graph.h"
#include "render/scene/types/sections.h"
#include "render/scene/values/scalars.h"

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr const char* kGround = "ground";

// A list of the section with the places of its items.
struct Items {
  std::vector<Fields> fields;
  const Value* value = nullptr;
  const Value& at(size_t i) const { return value->is_sequence() ? value->items[i] : *value; }
};

// What each type of condition is told by.
const std::map<std::string, std::vector<std::string>>& fields_of_types() {
  static const std::map<std::string, std::vector<std::string>> fields = {
      {"fixed", {"of", "value"}},
      {"angle", {"of", "angle"}},
      {"parallel", {"of"}},
      {"perpendicular", {"of"}},
      {"equal_length", {"of"}},
      {"distance", {"between", "value"}},
      {"point_distance", {"between", "value"}},
      {"coordinate_distance", {"between", "value", "along"}},
      {"point_plane", {"between", "value"}},
      {"planar", {"between", "value"}},
      {"plane_angle", {"between", "angle"}},
      {"equation", {"is"}}};
  return fields;
}

// A field that says nothing to this type.
void refuse_other_fields(const Fields& f) {
  const std::string type = f.text("type");
  const auto found = fields_of_types().find(type);
  const std::vector<std::string> own =
      found == fields_of_types().end() ? std::vector<std::string>{"between"} : found->second;
  for (const char* field : {"of", "between", "value", "angle", "along", "is"})
    if (f.has(field) && std::find(own.begin(), own.end(), field) == own.end())
      throw FieldError(field, fmt::format("'{}' takes no '{}'", type, field),
                       fmt::format("it takes {}", fmt::join(own, ", ")));
}

Vec3 across_of(const Vec3& normal) { return frame_about(Vec3(0), normal).x; }

}  // namespace

class ConstraintReading {
 public:
  ConstraintReading(const Value& section, const Fields& fields, Diagnostics& diagnostics, Parameters& parameters)
      : section_(section), fields_(fields), diagnostics_(diagnostics), parameters_(parameters) {}

  // Nothing after an error, which has been reported.
  std::optional<ConstraintReport> solve() {
    read_unknowns();
    read_markers();
    const Items conditions = items("conditions");
    for (size_t i = 0; i < conditions.fields.size(); ++i) {
      const Value& place = conditions.at(i);
      try {
        add(conditions.fields[i], place, i);
      } catch (const FieldError& error) {
        report(place, error.field, error);
      }
    }
    if (failed_) return std::nullopt;
    system_.size = size();
    try {
      return finished(geometry::solve(system_));
    } catch (const ConstraintError& error) {
      std::string names;
      for (size_t k = 1; k < std::min<size_t>(error.unmet.size(), 6); ++k) names += ", '" + error.unmet[k] + "'";
      diagnostics_.error(
          section_.find("conditions")->place, error.what(),
          names.empty() ? "other start values, or fewer conditions" : "not met either: " + names.substr(2));
      return std::nullopt;
    }
  }

 private:
  Items items(const char* field) const {
    Items result;
    if (!fields_.has(field)) return result;
    result.fields = fields_.get<std::vector<Fields>>(field);
    result.value = section_.find(field);
    return result;
  }
  void report(const Value& item, const std::string& field, const FieldError& error) {
    const Value* at = item.find(field.c_str());
    diagnostics_.error(at ? at->place : item.place, error.what(), error.hint);
    failed_ = true;
  }
  int unknown(double start, double weight) {
    system_.start.push_back(start);
    system_.weights.push_back(weight);
    return static_cast<int>(system_.start.size()) - 1;
  }
  // Whether the name is one, and no other thing has it.
  bool is_new(const Value& item, const std::string& name) {
    const auto refuse = [&](const std::string& message, const std::string& hint) {
      report(item, "name", FieldError("name", message, hint));
      return false;
    };
    if (const Reading<std::string> reading = read_name(*item.find("name")); !reading)
      return refuse(reading.slip().message, reading.slip().hint);
    if (points_.contains(name) || variables_.contains(name) || bodies_.contains(name) || markers_.contains(name) ||
        name == kGround)
      return refuse(fmt::format("the name '{}' is taken", name), "another one");
    return true;
  }
  // The point whose coordinate is called so.
  std::optional<std::string> point_with(const std::string& name) const {
    const std::string point = name.size() > 2 ? name.substr(0, name.size() - 2) : "";
    const bool is_coordinate = name.ends_with("_x") || name.ends_with("_y") || name.ends_with("_z");
    return is_coordinate && points_.contains(point) ? std::optional(point) : std::nullopt;
  }
  // A variable is a parameter of formulas, and so are coordinates of points.
  bool is_new_in_formulas(const Value& item, const std::string& name, const std::string& in_formulas) {
    if (!parameters_.has(in_formulas)) return true;
    report(
        item, "name",
        FieldError("name", fmt::format("there is a parameter '{}'", in_formulas),
                   name == in_formulas ? "another name"
                                       : fmt::format("'{}' is a coordinate of '{}': another name", in_formulas, name)));
    return false;
  }

  void read_unknowns() {
    const bool in_plane = fields_.get<bool>("in_plane");
    const Items points = items("points"), variables = items("variables"), curves = items("on_curves"),
                bodies = items("bodies");
    for (size_t i = 0; i < points.fields.size(); ++i) {
      const Fields& f = points.fields[i];
      if (!is_new(points.at(i), f.text("name"))) continue;
      bool clashes = false;
      for (const char axis : {'x', 'y', 'z'})
        clashes |= !is_new_in_formulas(points.at(i), f.text("name"), f.text("name") + "_" + axis);
      if (clashes) continue;
      UnknownPoint point;
      point.at = f.vec3("at");
      for (int k = 0; k < (in_plane ? 2 : 3); ++k) point.coordinates[k] = unknown(point.at[k], f.number("weight"));
      points_[f.text("name")] = point;
    }
    for (size_t i = 0; i < variables.fields.size(); ++i) {
      const Fields& f = variables.fields[i];
      if (!is_new(variables.at(i), f.text("name"))) continue;
      if (!is_new_in_formulas(variables.at(i), f.text("name"), f.text("name"))) continue;
      if (const auto point = point_with(f.text("name"))) {
        report(variables.at(i), "name",
               FieldError("name", fmt::format("'{}' is a coordinate of '{}'", f.text("name"), *point), "another name"));
        continue;
      }
      if (!Parameters::may_be_called(f.text("name"))) {
        report(variables.at(i), "name",
               FieldError("name", fmt::format("a variable may not be called '{}'", f.text("name")),
                          "it is a variable, function or unit of formulas"));
        continue;
      }
      variables_[f.text("name")] = unknown(f.number("start"), f.number("weight"));
    }
    for (size_t i = 0; i < curves.fields.size(); ++i) {
      const Fields& f = curves.fields[i];
      if (!is_new(curves.at(i), f.text("name"))) continue;
      UnknownPoint point;
      point.curve = f.curve("of");
      point.parameter = unknown(f.number("t"), f.number("weight"));
      points_[f.text("name")] = point;
    }
    for (size_t i = 0; i < bodies.fields.size(); ++i) {
      const Fields& f = bodies.fields[i];
      if (!is_new(bodies.at(i), f.text("name"))) continue;
      UnknownPose pose{static_cast<int>(system_.start.size()), f.vec3("at")};
      for (int k = 0; k < 6; ++k) unknown(0, f.number("weight"));
      bodies_[f.text("name")] = pose;
    }
  }

  void read_markers() {
    const Items markers = items("markers");
    for (size_t i = 0; i < markers.fields.size(); ++i) {
      const Fields& f = markers.fields[i];
      if (!is_new(markers.at(i), f.text("name"))) continue;
      Marker marker;
      marker.point.at = f.vec3("point");
      marker.normal = glm::normalize(f.vec3("normal"));
      const Vec3 given = f.has("direction") ? f.vec3("direction") : across_of(marker.normal);
      const Vec3 rest = given - glm::dot(given, marker.normal) * marker.normal;
      if (!(glm::length(rest) > 1e-6 * glm::length(given))) {
        report(markers.at(i), "direction",
               FieldError("direction", "the direction of a marker lies across its normal", "another direction"));
        continue;
      }
      marker.direction = glm::normalize(rest);
      if (f.has("of") && f.text("of") != kGround) {
        const auto body = bodies_.find(f.text("of"));
        if (body == bodies_.end()) {
          report(markers.at(i), "of", missing("of", "body", f.text("of"), bodies_));
          continue;
        }
        marker.point.pose = body->second;
      }
      markers_[f.text("name")] = marker;
    }
  }

  template <class Map>
  static FieldError missing(const char* field, const char* what, const std::string& name, const Map& known) {
    std::vector<std::string> names;
    for (const auto& [one, value] : known) names.push_back(one);
    const std::vector<std::string> nearest = nearest_names(name, names, 5);
    return FieldError(field, fmt::format("the constraints have no {} '{}'", what, name),
                      nearest.empty() ? "there is none" : fmt::format("there are {}", fmt::join(nearest, ", ")));
  }

  UnknownPoint point_named(const std::string& name, const char* field) const {
    if (const auto found = points_.find(name); found != points_.end()) return found->second;
    if (const auto found = markers_.find(name); found != markers_.end()) return found->second.point;
    throw missing(field, "point", name, points_);
  }
  Marker marker_named(const std::string& name, const char* field) const {
    if (const auto found = markers_.find(name); found != markers_.end()) return found->second;
    throw missing(field, "marker", name, markers_);
  }

  // Names of a field: as many as the condition needs.
  static std::vector<std::string> names_of(const Fields& f, const char* field, size_t count) {
    const auto names = f.has(field) ? f.get<std::vector<std::string>>(field) : std::vector<std::string>();
    if (names.size() != count)
      throw FieldError(
          field, fmt::format("'{}' needs '{}' with {} name{}", f.text("type"), field, count, count == 1 ? "" : "s"),
          fmt::format("{}: [..]", field));
    return names;
  }
  static double number_of(const Fields& f, const char* field) {
    if (!f.has(field)) throw FieldError(field, fmt::format("'{}' needs '{}'", f.text("type"), field));
    return f.number(field);
  }
  static double positive_of(const Fields& f, const char* field) {
    const double x = number_of(f, field);
    if (!(x > 0)) throw FieldError(field, "a distance is positive", "'coincident' where it is to be 0");
    return x;
  }

  void add(const Fields& f, const Value& item, size_t number) {
    const std::string type = f.text("type");
    const std::string name = f.has("name") ? f.text("name") : fmt::format("conditions.{} ({})", number, type);
    const auto put = [&](Constraint one) { system_.constraints.push_back(std::move(one)); };
    const Start start = system_.start;
    refuse_other_fields(f);
    if (type == "equation") return add_equation(f, item, name);
    if (type == "fixed") {
      const std::string of = names_of(f, "of", 1).front();
      if (f.has("value") && !variables_.contains(of))
        throw FieldError("value", fmt::format("'{}' is no variable and has no value", of),
                         "points and bodies are fixed where they begin");
      if (const auto body = bodies_.find(of); body != bodies_.end()) return put(fixation(name, body->second));
      if (const auto variable = variables_.find(of); variable != variables_.end())
        return put(value_constraint(name, variable->second,
                                    f.has("value") ? f.number("value") : start[static_cast<size_t>(variable->second)]));
      framework_.fixed.push_back(of);
      return put(fixation(name, point_named(of, "of"), start));
    }
    if (type == "angle") {
      const auto of = names_of(f, "of", 3);
      return put(angle_between(name, point_named(of[0], "of"), point_named(of[1], "of"), point_named(of[2], "of"),
                               number_of(f, "angle")));
    }
    if (type == "parallel" || type == "perpendicular" || type == "equal_length") {
      const auto of = names_of(f, "of", 4);
      const Segment2 a{point_named(of[0], "of"), point_named(of[1], "of")},
          b{point_named(of[2], "of"), point_named(of[3], "of")};
      return put(type == "parallel"        ? parallel(name, a, b, start)
                 : type == "perpendicular" ? perpendicular(name, a, b, start)
                                           : equal_lengths(name, a, b));
    }
    const auto pair = names_of(f, "between", 2);
    if (add_between_points(f, type, name, pair)) return;
    const Marker a = marker_named(pair[0], "between"), b = marker_named(pair[1], "between");
    add_joint(f, type, name, a, b);
  }

  bool add_between_points(const Fields& f, const std::string& type, const std::string& name,
                          const std::vector<std::string>& pair) {
    static const std::map<std::string, int> kHeld = {{"vertical", 0}, {"horizontal", 1}};
    const bool known = type == "coincident" || type == "point_on_point" || type == "spherical" || type == "distance" ||
                       type == "point_distance" || type == "coordinate_distance" || kHeld.contains(type);
    if (!known) return false;
    const UnknownPoint a = point_named(pair[0], "between"), b = point_named(pair[1], "between");
    const Start start = system_.start;
    std::vector<Constraint>& all = system_.constraints;
    if (type == "distance" || type == "point_distance") {
      all.push_back(distance_between(name, a, b, positive_of(f, "value")));
      framework_.bars.emplace_back(pair[0], pair[1]);
    } else if (type == "coordinate_distance") {
      if (!f.has("along")) throw FieldError("along", "'coordinate_distance' needs 'along'", "x, y or z");
      all.push_back(coordinate_distance(name, a, b, f.text("along")[0] - 'x', number_of(f, "value"), start));
    } else if (kHeld.contains(type))
      all.push_back(coordinate_distance(name, a, b, kHeld.at(type), 0, start));
    else {
      all.push_back(coincidence(name, a, b));
      framework_.joined.emplace_back(pair[0], pair[1]);
    }
    return true;
  }

  void add_joint(const Fields& f, const std::string& type, const std::string& name, const Marker& a, const Marker& b) {
    const auto put = [&](Constraint one) { system_.constraints.push_back(std::move(one)); };
    const double distance = f.has("value") ? f.number("value") : 0;
    if (type == "point_plane") put(point_to_plane(name, a, b, distance));
    if (type == "point_axis" || type == "cylindrical" || type == "prismatic") put(point_on_axis(name, a, b));
    if (type == "axis_along_plane") put(axis_along_plane(name, a, b));
    if (type == "plane_angle") put(plane_angle(name, a, b, number_of(f, "angle")));
    if (type == "revolute" || type == "rigid") put(coincidence(name, a.point, b.point));
    if (type == "plane_parallel" || type == "revolute" || type == "cylindrical" || type == "prismatic" ||
        type == "planar" || type == "rigid")
      put(parallel_planes(name, a, b));
    if (type == "planar") put(point_to_plane(name, a, b, distance));
    if (type == "prismatic" || type == "rigid") put(aligned(name, a, b));
  }

  static Constraint value_constraint(const std::string& name, int variable, double value) {
    return {name,
            1,
            false,
            {variable},
            [variable, value](std::span<const double> unknowns, Eigen::Ref<Eigen::VectorXd> f,
                              Eigen::Ref<Eigen::MatrixXd> jacobian) {
              f[0] = unknowns[static_cast<size_t>(variable)] - value;
              jacobian(0, variable) = 1;
            }};
  }

  void add_equation(const Fields& f, const Value& item, const std::string& name) {
    if (!f.has("is")) throw FieldError("is", "'equation' needs 'is'", "is: 'a + b = 2*c'");
    const std::string text = f.text("is");
    const size_t at = text.find('=');
    if (at == std::string::npos || at == 0 || text.find('=', at + 1) != std::string::npos)
      throw FieldError("is", "an equation has one '=', '>=' or '<='", "is: 'a + b = 2*c'");
    const char before = text[at - 1];
    const bool is_inequality = before == '>' || before == '<';
    const std::string left = text.substr(0, is_inequality ? at - 1 : at), right = text.substr(at + 1);
    std::vector<Expression::Variable> variables;
    std::vector<int> numbers;
    for (const auto& [variable, unknown] : variables_)
      variables.push_back({variable, Measure::plain}), numbers.push_back(unknown);
    for (const auto& [point, unknown] : points_)
      for (int k = 0; k < 3; ++k)
        if (unknown.coordinates[k] >= 0)
          variables.push_back({point + "_" + "xyz"[k], Measure::plain}), numbers.push_back(unknown.coordinates[k]);
    const std::string difference =
        before == '<' ? fmt::format("({}) - ({})", right, left) : fmt::format("({}) - ({})", left, right);
    const auto expression = parameters_.bind(*item.find("is"), difference, 0, {}, variables);
    if (!expression) {
      failed_ = true;
      return;
    }
    const std::vector<std::string> names = std::get<Expression>(Expression::parse(difference)).names();
    std::vector<int> used;
    for (size_t k = 0; k < numbers.size(); ++k)
      if (std::find(names.begin(), names.end(), variables[k].name) != names.end()) used.push_back(numbers[k]);
    system_.constraints.push_back(
        formula_constraint(f.has("name") ? name : "'" + text + "'", *expression, numbers, used, is_inequality));
  }

  // Of the start's points and distances; errors are relative to it.
  double size() const {
    Box3 box;
    for (const auto& [name, point] : points_) box.include(place_of(point, system_.start));
    for (const auto& [name, marker] : markers_) box.include(marker.point.at);
    const double diameter = box.empty() ? 0 : box.diameter();
    return diameter > 0 ? diameter : 1;
  }

  ConstraintReport finished(ConstraintSolution solution) const {
    ConstraintReport result;
    const std::vector<double>& p = solution.unknowns;
    for (const auto& [name, point] : points_) {
      result.points[name] = place_of(point, p);
      if (point.curve) result.parameters[name] = p[static_cast<size_t>(point.parameter)];
    }
    for (const auto& [name, variable] : variables_) result.variables[name] = p[static_cast<size_t>(variable)];
    for (const auto& [name, pose] : bodies_) result.poses[name] = map_of(pose, p);
    result.unknowns = static_cast<int>(p.size());
    result.formal_freedom = result.unknowns - solution.equations;
    if (result.unknowns > 0) {
      const Eigen::MatrixXd velocities = allowed_velocities(system_, solution);
      find_free(solution, velocities, result);
      result.graph = constraint_graph(system_, solution, names_of_unknowns(), points_, framework_, velocities);
    }
    result.solution = std::move(solution);
    return result;
  }

  std::vector<std::string> names_of_unknowns() const {
    std::vector<std::string> names(system_.start.size());
    for (const auto& [name, point] : points_) {
      for (int k = 0; k < 3; ++k)
        if (point.coordinates[k] >= 0) names[static_cast<size_t>(point.coordinates[k])] = name + "_" + "xyz"[k];
      if (point.curve) names[static_cast<size_t>(point.parameter)] = name + ".t";
    }
    for (const auto& [name, variable] : variables_) names[static_cast<size_t>(variable)] = name;
    for (const auto& [name, pose] : bodies_)
      for (int k = 0; k < 6; ++k)
        names[static_cast<size_t>(pose.first + k)] =
            fmt::format("{}.{}_{}", name, k < 3 ? "turn" : "shift", "xyz"[k % 3]);
    return names;
  }

  // By the null space of the Jacobian: the velocities that all conditions allow.
  void find_free(const ConstraintSolution& solution, const Eigen::MatrixXd& null_space,
                 ConstraintReport& result) const {
    const auto moves = [&](int unknown) { return null_space.row(unknown).norm() > 1e-7; };
    for (const auto& [name, point] : points_) {
      const bool free = point.curve ? moves(point.parameter)
                                    : std::any_of(point.coordinates.begin(), point.coordinates.end(),
                                                  [&](int k) { return k >= 0 && moves(k); });
      if (free) result.free.push_back(name);
    }
    for (const auto& [name, variable] : variables_)
      if (moves(variable)) result.free.push_back(name);
    std::vector<std::pair<std::string, Eigen::MatrixXd>> twists{{kGround, Eigen::MatrixXd::Zero(6, null_space.cols())}};
    for (const auto& [name, pose] : bodies_) {
      twists.emplace_back(name, twist(pose, solution.unknowns, null_space));
      if (twists.back().second.norm() > 1e-7) result.free.push_back(name);
    }
    std::vector<char> taken(twists.size(), 0);
    for (size_t i = 0; i < twists.size() && !bodies_.empty(); ++i) {
      if (taken[i]) continue;
      std::vector<std::string> cluster;
      for (size_t j = i; j < twists.size(); ++j)
        if (!taken[j] && (twists[i].second - twists[j].second).norm() <= 1e-7 * (1 + system_.size))
          taken[j] = 1, cluster.push_back(twists[j].first);
      result.clusters.push_back(std::move(cluster));
    }
  }

  // Angular velocity and velocity of the world's origin for each allowed velocity, by differences.
  static Eigen::MatrixXd twist(const UnknownPose& pose, const std::vector<double>& p,
                               const Eigen::MatrixXd& velocities) {
    Eigen::MatrixXd result(6, velocities.cols());
    for (Eigen::Index k = 0; k < velocities.cols(); ++k) {
      constexpr double h = 1e-6;
      std::vector<double> after = p, before = p;
      for (size_t i = 0; i < p.size(); ++i) {
        after[i] += h * velocities(static_cast<Eigen::Index>(i), k);
        before[i] -= h * velocities(static_cast<Eigen::Index>(i), k);
      }
      // The motion from the one to the other.
      const Affine motion = map_of(pose, after) * map_of(pose, before).inverse();
      const Mat3& m = motion.linear;
      const Vec3 turn = Vec3(m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]) / (4 * h);
      const Vec3 shift = motion.offset / (2 * h);
      result.col(k) << turn.x, turn.y, turn.z, shift.x, shift.y, shift.z;
    }
    return result;
  }

  const Value& section_;
  const Fields& fields_;
  Diagnostics& diagnostics_;
  Parameters& parameters_;
  ConstraintSystem system_;
  std::map<std::string, UnknownPoint> points_;
  std::map<std::string, int> variables_;
  std::map<std::string, UnknownPose> bodies_;
  std::map<std::string, Marker> markers_;
  PlaneFramework framework_;
  bool failed_ = false;
};

namespace {

// The names alone: to use what was not found is no mistake of its own.
ConstraintReport unsolved(const Value& section) {
  const auto each_name = [&](const char* field, const auto& add) {
    const Value* list = section.find(field);
    if (!list) return;
    for (const Value& item : list->is_sequence() ? std::span(list->items) : std::span(list, 1))
      if (const Value* name = item.is_map() ? item.find("name") : nullptr; name && name->is_scalar()) add(name->text);
  };
  ConstraintReport report;
  const auto add_point = [&](const std::string& name) { report.points[name] = Vec3(0); };
  each_name("points", add_point);
  each_name("on_curves", add_point);
  each_name("variables", [&](const std::string& name) {
    if (Parameters::may_be_called(name)) report.variables[name] = std::numeric_limits<double>::quiet_NaN();
  });
  each_name("bodies", [&](const std::string& name) { report.poses[name] = Affine(); });
  return report;
}

}  // namespace

void Builder::solve_constraints() {
  const Value* given = section("constraints");
  if (!given || !given->is_map()) return;
  const auto fields = read_fields(section_declaration("constraints").fields, *given, {}, "'constraints'");
  auto found = fields ? ConstraintReading(*given, *fields, diagnostics_, parameters_).solve() : std::nullopt;
  using State = NamedThing::Member::State;
  const State state = found ? State::unknown : State::wrong;
  if (!found) found = unsolved(*given);
  const Value* written = section("geometry");
  if (written && !written->is_map()) return;
  Value with_points = written ? *written : default_value("{}");
  auto& geometry = sections_["geometry"];
  for (const auto& [name, point] : found->points) {
    if (const auto taken = geometry.find(name); taken != geometry.end()) {
      diagnostics_.error(taken->second.entry->key.place,
                         fmt::format("'{}' is a point of the constraints already", name), "another name");
      continue;
    }
    Entry entry;
    entry.key.name = name;
    entry.key.place = given->place;
    entry.value = default_value(fmt::format("[{}, {}, {}]", point.x, point.y, point.z));
    with_points.entries.push_back(std::move(entry));
  }
  geometry_ = std::move(with_points);
  for (const Entry& entry : geometry_.entries) {
    if (geometry.contains(entry.key.name)) continue;
    NamedThing& thing = geometry[entry.key.name];
    thing.entry = &entry;
    thing.members.push_back({"", {&entry.value, {}}, state, {}, {}});
    thing.used = true;
  }
  for (const auto& [name, value] : found->variables) parameters_.define(name, value);
  constraints_ = std::make_shared<const ConstraintReport>(*std::move(found));
}

}  // namespace lekalo::render
