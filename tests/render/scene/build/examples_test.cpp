// The scenes of tests/render/scene/examples, which use the drawing sections as a figure of a book does: they load
// without a word, and hold what they say.
#include <gtest/gtest.h>

#include "render/scene/build/load.h"

namespace lekalo::render::examples_test {
namespace {

std::shared_ptr<const Model> load(const char* name) {
  return load_scene(std::filesystem::path(LEKALO_SOURCE_DIR) / "tests/render/scene/examples" / name).model;
}

TEST(Examples, Bezier) {
  const auto model = load("bezier.yaml");
  ASSERT_EQ(model->objects.size(), 1u);
  EXPECT_EQ(model->objects[0].look->helpers.size(), 2u);
  ASSERT_EQ(model->drawing.annotations.size(), 2u);
  EXPECT_EQ(model->drawing.annotations[0].values.get<TextTemplate>("label").text(), "$\\mathbf{r}(0.4)$");
  EXPECT_EQ(model->paper.width, 84);
  EXPECT_EQ(model->outputs.at(0).kind, "drawing");
}

TEST(Examples, NurbsSurface) {
  const auto model = load("nurbs_surface.yaml");
  const Lines& lines = *model->objects.at(0).look->lines;
  EXPECT_EQ(lines.at_u.count, 9);
  EXPECT_EQ(lines.hidden.way, HiddenLines::Way::drop);
  ASSERT_EQ(model->drawing.annotations.size(), 4u);
  EXPECT_EQ(model->drawing.annotations[0].values.get<geometry::Anchor>("at").point, Vec3(2, 2, 2.4));  // p_22
  EXPECT_EQ(model->drawing.annotations[0].values.get<TextTemplate>("text").text(), "$\\mathbf{p}_{22},\\ w_{22} = 4$");
  EXPECT_EQ(model->drawing.ground, Ground::shaded);
}

// B_1(1/3) = 3 (1/3) (2/3)^2 = 4/9.
TEST(Examples, Graph) {
  const auto model = load("graph.yaml");
  ASSERT_EQ(model->objects.size(), 4u);
  EXPECT_EQ(model->objects[2].legend, "$B_2^3$");
  EXPECT_TRUE(model->objects[0].look->lines->styles.at("curve").cycles);
  const Vec3 marked = model->drawing.annotations.at(1).values.get<geometry::Anchor>("at").point;
  EXPECT_NEAR(marked.x, 1.0 / 3, 1e-15);
  EXPECT_NEAR(marked.y, 4.0 / 9, 1e-15);
}

TEST(Examples, Balls) {
  const auto model = load("balls.yaml");
  EXPECT_EQ(model->drawing.annotations.size(), 5u);
  EXPECT_EQ(model->outputs.at(2).width, 120);
  EXPECT_EQ(model->lights.size(), 4u);
}

TEST(Examples, Views) {
  const auto model = load("views.yaml");
  ASSERT_EQ(model->panels.size(), 3u);
  EXPECT_EQ(model->layout.rows.size(), 2u);
  EXPECT_DOUBLE_EQ(model->styles.at("thick").width, 0.7 * 25.4 / 72);
}

}  // namespace
}  // namespace lekalo::render::examples_test
