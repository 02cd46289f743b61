// The visible and hidden pieces of all lines of Klein bottles by formulas against the zeros of an implicit function
// along the line of sight (support/bottle_oracle.h).
#include "geometry/point_formulas.h"
#include "geometry/surfaces/analytic/formula_surface.h"
#include "render/drawing/line_truth.h"
#include "support/bottle_oracle.h"

namespace lekalo::render::klein_bottle_truth_test {
namespace {

// As the gallery writes it, the figure's middle at the distance a from the axis.
SurfacePtr figure_eight_bottle(const std::string& a) {
  const std::string rho = "(" + a + " + cos(u/2)*sin(v) - sin(u/2)*sin(2*v))";
  return std::make_shared<FormulaSurface>(
      point_formulas({rho + "*cos(u)", rho + "*sin(u)", "sin(u/2)*sin(v) + cos(u/2)*sin(2*v)"}, {"u", "v"}),
      Rectangle{{0, kTwoPi}, {0, kTwoPi}}, FormulaSurface::Closed{false, true});
}

// The lines that are asked about are polynomials that agree with theirs to e = 1e-13 of their size: where the way of
// sight touches the surface the sheet that they lie on is met sqrt(2 e) from them, and e/d at the distance d from such
// a place. So sheets must be as near as this to be taken for that, transitions are asked about this part of the line
// away from them, and others that are nearer than twice or five times that are not clear.
constexpr double kOwnContact = 3e-6, kOwnSheet = 2e-7, kAway = 1e-6;

Sheets sheets_of_bottle(const oracle::implicit::FigureEightBottle& bottle) {
  return [bottle](const Vec3& from, const Vec3& point, double contact) {
    return contact > 0 ? oracle::implicit::layers_before(bottle, from, point, kOwnContact, 2 * kOwnContact)
                       : oracle::implicit::layers_before(bottle, from, point, kOwnSheet, 5 * kOwnSheet);
  };
}

TEST(DrawingTruth, KleinBottles) {
  Views views(67);
  Found found;
  for (int k = 0; k < tests::tier_count(500, tests::min_of_slow(50)); ++k) {
    SmallScene scene;
    const std::string a = std::to_string(views.number(1.8, 2.6));
    show(scene, figure_eight_bottle(a), {"boundary", "silhouette", "self_intersection", "parameter"}, 4);
    views.look(scene, k % 2);
    Truth(*scene.world(), sheets_of_bottle(oracle::implicit::FigureEightBottle(std::stod(a))), views, found, 4, kAway);
  }
  expect_right(found, "klein_bottle");
}

}  // namespace
}  // namespace lekalo::render::klein_bottle_truth_test
