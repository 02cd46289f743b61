// Point, derivatives, fundamental forms and curvatures of a surface (Golovanov 2016, 3.1).
#include <cmath>

#include "evaluate.h"
#include "geometry/queries/differential/curvature.h"
#include "geometry/queries/differential/fundamental_forms.h"
#include "geometry/queries/differential/turning_step.h"
#include "parameters.h"

namespace lekalo::command {

namespace {

using geometry::Vec2;
using geometry::Vec3;

ordered_json directions(const std::vector<Vec3>& list) {
  ordered_json out = ordered_json::array();
  for (const Vec3& d : list) out.push_back(to_json(d));
  return out;
}

void put_forms(ordered_json& out, const std::optional<geometry::FundamentalForms>& forms) {
  if (!forms) {
    for (const char* key : {"first_form", "second_form", "weingarten", "normal_du", "normal_dv"}) out[key] = nullptr;
    return;
  }
  const auto three = [](const geometry::QuadraticForm& f) { return ordered_json::array({f.uu, f.uv, f.vv}); };
  out["first_form"] = three(forms->first);
  out["second_form"] = three(forms->second);
  const auto& w = forms->weingarten;
  out["weingarten"] = ordered_json::array({w[0][0], w[0][1], w[1][0], w[1][1]});
  out["normal_du"] = finite_or_null(forms->normal_du);
  out["normal_dv"] = finite_or_null(forms->normal_dv);
}

void put_along(ordered_json& out, const geometry::SurfaceJet& jet, const Vec3& normal,
               const geometry::FundamentalForms& forms, const geometry::SurfaceCurvature& principal,
               const std::vector<Vec2>& along) {
  const auto d = geometry::curvature_along(jet, normal, forms, principal, along[0]);
  out["direction"] = finite_or_null(d.direction);
  out["normal_curvature"] = finite_or_null(d.normal);
  out["geodesic_torsion"] = finite_or_null(d.torsion);
  out["angle_from_principal"] = finite_or_null(d.angle);
  if (along.size() < 2) return;
  const auto e = geometry::curvature_along(jet, normal, forms, principal, along[1]);
  const double sine = glm::length(glm::cross(d.direction, e.direction)), cosine = glm::dot(d.direction, e.direction);
  out["angle_between"] = finite_or_null(std::atan2(sine, cosine));
}

}  // namespace

ordered_json evaluate_place(const SurfacePlace& at, const std::vector<Vec2>& along) {
  const auto& [uv, jet, normal, c, size] = at;
  ordered_json out;
  out["u"] = uv.x;
  out["v"] = uv.y;
  out["point"] = to_json(jet.point());
  out["du"] = finite_or_null(jet.du());
  out["dv"] = finite_or_null(jet.dv());
  out["duu"] = finite_or_null(jet.duu());
  out["duv"] = finite_or_null(jet.duv());
  out["dvv"] = finite_or_null(jet.dvv());
  out["normal"] = finite_or_null(normal);
  const auto forms = geometry::fundamental_forms(jet, normal);
  put_forms(out, forms);
  out["gaussian_curvature"] = json_or_null(c.regular, c.gaussian);
  out["mean_curvature"] = json_or_null(c.regular, c.mean);
  out["principal_curvatures"] =
      c.regular ? ordered_json::array({c.principal[0], c.principal[1]}) : ordered_json(nullptr);
  out["principal_directions"] = c.regular ? directions({c.directions[0], c.directions[1]}) : ordered_json(nullptr);
  out["point_type"] = c.regular ? ordered_json(geometry::point_type(c, size)) : ordered_json(nullptr);
  const std::vector<Vec3> asymptotic = c.regular ? geometry::asymptotic_directions(c, size) : std::vector<Vec3>();
  out["asymptotic_directions"] = asymptotic.empty() ? ordered_json(nullptr) : directions(asymptotic);
  if (forms && c.regular && !along.empty()) put_along(out, jet, normal, *forms, c, along);
  return out;
}

ordered_json evaluate_surface(const geometry::Surface& surface, const Vec2& uv, const std::vector<Vec2>& along,
                              double turn, bool connected) {
  const double size = surface.bounded() ? geometry::bounds(surface).diameter() : 0;
  const geometry::SurfaceJet jet = surface.evaluate(uv.x, uv.y, 2);
  ordered_json out =
      evaluate_place({uv, jet, surface.normal(uv.x, uv.y), geometry::curvature(surface, uv.x, uv.y), size}, along);
  if (turn > 0) {
    if (const auto forms = geometry::fundamental_forms(jet, surface.normal(uv.x, uv.y))) {
      const Vec2 steps = geometry::turning_steps(*forms, turn);
      out["step_u"] = finite_or_null(steps.x), out["step_v"] = finite_or_null(steps.y);
    }
  }
  if (connected && surface.max_order() >= 3)
    if (const auto c = geometry::connection(geometry::local_basis(surface.evaluate(uv.x, uv.y, 3)))) {
      out["reciprocal_basis"] =
          ordered_json::array({finite_or_null(c->reciprocal[0]), finite_or_null(c->reciprocal[1])});
      put_connection(out, *c);
    }
  out["parameters"] = parameters_of(surface);
  return out;
}

}  // namespace lekalo::command
