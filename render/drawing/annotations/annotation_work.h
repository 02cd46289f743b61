// What annotations of all kinds draw with: texts, lines and signs in space or on the page, in the style of one of them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/drawing/annotations/annotations.h"

namespace lekalo::render {

constexpr double kSeenEndOn = 1e-3;  // millimetres: what is shorter in the picture is a point there

class AnnotationWork {
 public:
  AnnotationWork(const View& view, const Annotation& annotation, LineWork& work, PageWork& page);

  const View& view() const { return view_; }
  const std::string& kind() const { return annotation_.type; }
  const geometry::Fields& fields() const { return annotation_.values; }
  const Style& style() const { return annotation_.style; }
  const LineLook& look() const { return look_; }
  PageWork& page() { return page_; }

  // Notes that the annotation is not in the drawing.
  void leave_out(const std::string& why);
  void leave_out_end_on() { leave_out("seen end on"); }
  // What of it is at points behind the eye is not drawn; finish() notes it, once.
  void leave_out_behind() { behind_ = true; }
  void finish();
  bool is_seen(const Vec3& point) const { return view_.camera.project(point).visible_side; }

  // A place on the page that the annotation speaks of.
  Vec2 place(const geometry::Anchor& anchor);
  // Scene units of a length on the page that lies across the line of sight at this point.
  double in_scene(double millimetres, const Vec3& point) const;
  // Whether its lines have arrows at their beginning and end.
  std::pair<bool, bool> heads() const;
  HiddenLines hidden() const { return hidden_of(fields()); }
  std::string side() const { return fields().has("side") ? fields().text("side") : std::string(); }
  // Of a text that may be left out: then empty.
  std::string words(const char* field) const;

  // In space.
  void stroke(geometry::CurvePtr curve, const HiddenLines& hidden, bool start, bool end);
  void segment(const Vec3& from, const Vec3& to, const HiddenLines& hidden, bool start, bool end);
  void text(const Vec3& point, std::string words, const std::string& side, double distance, const HiddenLines& hidden,
            bool leader = false);
  void mark(Mark mark, const HiddenLines& hidden);

  // On the page.
  Label page_label(const std::string& words, const Vec2& at) const;
  void add(Label label);
  void shape(std::vector<SheetItem> items);
  void page_line(const Vec2& from, const Vec2& to, bool start, bool end);

 private:
  const View& view_;
  const Annotation& annotation_;
  LineWork& work_;
  PageWork& page_;
  LineLook look_;
  bool drawn_ = false, behind_ = false;  // any of it
};

}  // namespace lekalo::render
