#include "render/drawing/annotations/detail_circle.h"

#include <cmath>

#include "render/drawing/annotations/page_shapes.h"

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr double kTextOff = 0.8;   // millimetres
constexpr double kSameWay = 1e-6;  // radians

SheetPath drawn_circle(const PageCircle& circle, const LineLook& pen) {
  const double r = circle.radius;
  return drawn({circle.center + Vec2(r, 0), arcs_to({circle.center, {r, 0}, {0, r}}, 0, kTwoPi), true}, pen);
}

const DetailPtr& detail_in(const AnnotationWork& work) { return work.fields().get<DetailPtr>("detail"); }

}  // namespace

PageCircle circle_of(const View& view, const Detail& detail) {
  return {view.place(detail.around), detail.radius / view.camera.pixel_size(detail.around) * view.millimetres};
}

SheetBox box_of(const PageCircle& circle) {
  return {circle.center - Vec2(circle.radius), circle.center + Vec2(circle.radius)};
}

void add_detail_border(AnnotationWork& work) {
  work.shape({drawn_circle(circle_of(work.view(), *detail_in(work)), work.look())});
}

void add_detail_circle(AnnotationWork& work) {
  if (!work.fields().holds<DetailPtr>("detail")) return work.leave_out("of a panel without a detail");
  const DetailPtr& detail = detail_in(work);
  if (detail_of(work.view().model.drawing) == detail) return;  // an annotation of the whole drawing, in the view itself
  const Camera& camera = work.view().camera;
  if (!camera.is_parallel() || camera.is_graph() ||
      glm::length(camera.view_direction() - work.fields().vec3("sight")) > kSameWay)
    return work.leave_out("of a panel that looks another way");
  const PageCircle circle = circle_of(work.view(), *detail);
  work.shape({drawn_circle(circle, work.look())});
  const SheetBox box = box_of(circle);
  work.page().reach.insert(work.page().reach.end(), {box.lo, box.hi});
  if (detail->title.empty()) return;
  const double angle = work.fields().number("leader");
  const Vec2 out(std::cos(angle), -std::sin(angle));
  Label letter = work.page_label(detail->title, circle.center + circle.radius * out);
  letter.side = side_towards(out);
  letter.distance = kTextOff;
  work.add(std::move(letter));
}

}  // namespace lekalo::render
