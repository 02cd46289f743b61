// Texts of drawings: what they are read as, where their parts stand, where labels find room; numbers of dimensions and
// axes. Facts of TeX's own layout (The TeXbook, appendix G) and of plain arithmetic.
#include <gtest/gtest.h>

#include "render/drawing/annotations/label_placement.h"
#include "render/drawing/annotations/page_shapes.h"
#include "render/drawing/output/cairo_output.h"
#include "render/drawing/output/latex.h"
#include "render/drawing/output/svg.h"
#include "render/drawing/page/graph_axes.h"
#include "render/drawing/paths/overlaps.h"
#include "render/drawing/text/fonts.h"
#include "render/drawing/text/text_layout.h"
#include "render/model/tex.h"

namespace lekalo::render::texts_test {
namespace {

std::string characters(const SheetText& text) {
  std::string all;
  for (const TextRun& run : text.runs) all += run.text;
  return all;
}

std::string slip_of(const std::string& text) {
  const auto parsed = parse_tex(text);
  const auto* slip = std::get_if<TextSlip>(&parsed);
  return slip ? std::to_string(slip->offset) + " " + slip->message : "none";
}

TEST(Tex, WhatItDoesNotKnow) {
  EXPECT_EQ(slip_of("$\\alpha_{i+1}^{(k)} \\le \\frac{a}{b}$"), "none");
  EXPECT_EQ(slip_of("$\\aplha$"), "1 labels do not know '\\aplha' (did you mean 'alpha'?)");
  EXPECT_EQ(slip_of("\\alpha"), "0 '\\alpha' stands in formulas only");
  EXPECT_EQ(slip_of("$x_i_j$"), "4 two subscripts at one place");
  EXPECT_EQ(slip_of("$x_$"), "2 something is missing behind this");
  EXPECT_EQ(slip_of("$\\frac{a}$"), "1 something is missing behind this");
  EXPECT_EQ(slip_of("$\\left( a$"), "1 \\left without \\right");
  EXPECT_EQ(slip_of("$\\mathcal{Fx}$"), "11 \\mathcal has capital letters alone");
}

TEST(TextLayout, CharactersAndTheirFonts) {
  const SheetText text = laid_out("Кривая $\\mathbf{r}(t) = x_{12}'$, \\textbf{да}", "serif", 10);
  EXPECT_EQ(characters(text), "Кривая r(t)=x12′, да");
  for (const TextRun& run : text.runs) {
    EXPECT_EQ(run.font.italic, run.text == "t" || run.text == "x") << run.text;
    EXPECT_EQ(run.font.bold, run.text == "r" || run.text == "да") << run.text;
    EXPECT_EQ(run.size, run.text == "12" ? 7 : 10) << run.text;
    EXPECT_TRUE(run.font.family == "CMU Serif" || run.font.family == "DejaVu Serif") << run.font.family;
  }
  // Signs that Computer Modern Unicode lacks.
  EXPECT_EQ(laid_out("$\\partial$", "serif", 10).runs.at(0).font.family, "DejaVu Serif");
  // Alphabets of Unicode (chart 1D400), one font for all letters of each.
  const SheetText letters = laid_out("$\\mathcal{AFZ}\\mathfrak{AHz}\\mathbb{AR}$", "serif", 10);
  EXPECT_EQ(characters(letters), "𝒜ℱ𝒵𝔄ℌ𝔷𝔸ℝ");
  for (const TextRun& run : letters.runs) EXPECT_FALSE(run.font.italic) << run.text;
  for (size_t k = 0; k + 2 < letters.runs.size(); ++k)
    EXPECT_EQ(letters.runs[k].font.family, "DejaVu Math TeX Gyre") << letters.runs[k].text;
}

TEST(TextLayout, SignsHaveFonts) {
  for (const char* name : {"varnothing",
                           "aleph",
                           "wp",
                           "complement",
                           "top",
                           "bot",
                           "lnot",
                           "nexists",
                           "triangle",
                           "square",
                           "blacksquare",
                           "lozenge",
                           "odot",
                           "measuredangle",
                           "therefore",
                           "because",
                           "dagger",
                           "ddagger",
                           "land",
                           "lor",
                           "ominus",
                           "oslash",
                           "sqcup",
                           "sqcap",
                           "uplus",
                           "diamond",
                           "supset",
                           "supseteq",
                           "ni",
                           "prec",
                           "succ",
                           "asymp",
                           "doteq",
                           "models",
                           "triangleq",
                           "lesssim",
                           "gtrsim",
                           "vdash",
                           "gets",
                           "longmapsto",
                           "implies",
                           "longrightarrow",
                           "impliedby",
                           "longleftarrow",
                           "iff",
                           "updownarrow",
                           "hookrightarrow",
                           "Uparrow",
                           "Downarrow",
                           "nearrow",
                           "searrow",
                           "swarrow",
                           "nwarrow",
                           "iint",
                           "iiint",
                           "coprod",
                           "bigcup",
                           "bigcap",
                           "bigoplus",
                           "bigotimes",
                           "lVert",
                           "lbrace",
                           "rbrack"})
    EXPECT_GT(laid_out(std::string("$\\") + name + "$", "serif", 10).width, 0) << name;
  const double height = laid_out("$a$", "serif", 10).ascent;
  for (const char* name : {"check", "breve", "acute", "grave", "mathring", "widetilde"}) {
    const SheetText text = laid_out(std::string("$\\") + name + "{a}$", "serif", 10);
    EXPECT_GT(text.ascent, height + 1) << name;
    EXPECT_LT(text.ascent, height + 4) << name;
  }
}

TEST(TextLayout, Places) {
  const double em = 10;
  const SheetText one = laid_out("$a$", "serif", em), two = laid_out("$aa$", "serif", em);
  EXPECT_NEAR(two.width, 2 * one.width, 1e-9);
  const SheetText sum = laid_out("$a+a$", "serif", em), minus = laid_out("$-a$", "serif", em);
  const double plus = text_extent({"CMU Serif"}, "+").advance * em;
  EXPECT_NEAR(sum.width, 2 * one.width + plus + 4.0 / 9 * em, 1e-9);  // 2/9 em on each side
  EXPECT_NEAR(minus.width, one.width + text_extent({"CMU Serif"}, "−").advance * em, 1e-9);
  // The same between letters of another font, and groups.
  const double bold = laid_out("$\\mathbf{a}$", "serif", em).width;
  EXPECT_NEAR(laid_out("$\\mathbf{a}+{\\mathbf{a}}$", "serif", em).width, 2 * bold + plus + 4.0 / 9 * em, 1e-9);
  const double real = laid_out("$\\mathbb{R}$", "serif", em).width, to = laid_out("$\\to$", "serif", em).width;
  EXPECT_NEAR(laid_out("$\\mathbb{R}\\to\\text{a}$", "serif", em).width,
              real + to + laid_out("a", "serif", em).width + 10.0 / 18 * em, 1e-9);
  const SheetText scripts = laid_out("$a_1^2$", "serif", em);
  ASSERT_EQ(scripts.runs.size(), 3u);
  EXPECT_GT(scripts.runs[1].at.y, 0);  // below the line; y runs downwards
  EXPECT_LT(scripts.runs[2].at.y, -3);
  EXPECT_EQ(scripts.runs[1].size, 7);
  // The prime of TeX: half an em high in the font of signs, 0.7 times, raised by 0.363 to 0.413 em.
  const SheetText prime = laid_out("$\\mathbf{c}'$", "serif", em), with_power = laid_out("$a'^2$", "serif", em);
  ASSERT_EQ(prime.runs.size(), 2u);
  const TextRun& sign = prime.runs[1];
  EXPECT_FALSE(sign.font.bold);
  EXPECT_NEAR(-sign.at.y + text_extent(sign.font, sign.text).above * sign.size, 0.75 * em, 0.1 * em);
  EXPECT_NEAR(-sign.at.y + text_extent(sign.font, sign.text).below * sign.size, 0.4 * em, 0.15 * em);
  EXPECT_EQ(laid_out("$\\mathbf{c}^{\\prime}$", "serif", em).width, prime.width);
  ASSERT_EQ(with_power.runs.size(), 3u);
  EXPECT_GT(with_power.runs[2].at.x, with_power.runs[1].at.x);
  EXPECT_EQ(with_power.runs[2].size, 7);
  const SheetText fraction = laid_out("$\\frac{1}{2}$", "serif", em);
  ASSERT_EQ(fraction.strokes.size(), 1u);
  EXPECT_NEAR(fraction.strokes[0].from.y, -2.5, 1e-9);  // the axis, a quarter em high
  EXPECT_LT(fraction.runs[0].at.y, -2.5);
  EXPECT_GT(fraction.runs[1].at.y, 0);
  EXPECT_EQ(laid_out("$\\sqrt{2}$", "serif", em).strokes.size(), 1u);
  EXPECT_EQ(laid_out("$\\vec{a}$", "serif", em).strokes.size(), 2u);
}

TEST(Labels, KeepApart) {
  std::vector<Label> labels(6);
  for (Label& label : labels) label.text = laid_out("label", "serif", 3), label.at = {20, 20};
  labels[0].side = "below";
  LabelObstacles obstacles;
  obstacles.width = obstacles.height = 40;
  place_labels(labels, obstacles);
  EXPECT_NEAR(labels[0].text.at.x + 0.5 * labels[0].text.width, 20, 1e-9);
  EXPECT_GT(labels[0].text.at.y, 20);
  for (size_t i = 0; i < labels.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      const auto &a = labels[i].text, &b = labels[j].text;
      const bool apart = a.at.x + a.width <= b.at.x || b.at.x + b.width <= a.at.x ||
                         a.at.y + a.descent <= b.at.y - b.ascent || b.at.y + b.descent <= a.at.y - a.ascent;
      EXPECT_TRUE(apart) << i << " " << j;
    }
}

TEST(Labels, AvoidLines) {
  std::vector<Label> labels(1);
  labels[0].text = laid_out("label", "serif", 3), labels[0].at = {20, 20};
  LabelObstacles obstacles;
  obstacles.width = obstacles.height = 40;
  obstacles.segments = {{{20, 20}, {40, 0}}, {{20, 20}, {0, 0}}, {{20, 20}, {20, 0}}};  // everywhere above
  place_labels(labels, obstacles);
  const auto& text = labels[0].text;
  EXPECT_GE(text.at.y - text.ascent, 15);
}

// Places to choose from: the first that is free.
TEST(Labels, SpotsInTheirOrder) {
  const std::vector<LabelSpot> spots = {{{20, 20}, "above", 1}, {{20, 20}, "below", 1}, {{10, 30}, "here", 0}};
  const std::vector<std::pair<Vec2, Vec2>> lines = {{{0, 17}, {40, 17}}, {{0, 23}, {40, 23}}};
  for (size_t covered = 0; covered <= lines.size(); ++covered) {
    std::vector<Label> labels(1);
    labels[0].text = laid_out("label", "serif", 3), labels[0].spots = spots;
    LabelObstacles obstacles;
    obstacles.width = obstacles.height = 40;
    obstacles.segments = {lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(covered)};
    place_labels(labels, obstacles);
    const SheetText& text = labels[0].text;
    if (covered == 2)
      EXPECT_EQ(text.at, Vec2(10, 30));
    else
      EXPECT_EQ(text.at.y < 20, covered == 0);
  }
}

// A text that is turned takes the room in which it stands, not that of one that is level.
TEST(Labels, KeepApartFromTurnedOnes) {
  for (const double degrees : {90.0, 40.0, -60.0})
    for (const double along : {0.2, 0.5, 0.8}) {
      std::vector<Label> labels(2);
      labels[0].text = laid_out("a long label", "serif", 3), labels[0].side = "here";
      labels[0].text.angle = degrees * geometry::kPi / 180;
      labels[0].text.at = {20, 20};
      const Vec2 way(std::cos(labels[0].text.angle), -std::sin(labels[0].text.angle));
      labels[1].text = laid_out("b", "serif", 3);
      labels[1].at = labels[0].text.at + along * labels[0].text.width * way;
      LabelObstacles obstacles;
      obstacles.width = obstacles.height = 60;
      place_labels(labels, obstacles);
      const auto &a = labels[0].text, &b = labels[1].text;
      const Vec2 up(way.y, -way.x);
      for (int i = 0; i <= 40; ++i)
        for (int j = 0; j <= 8; ++j) {
          const Vec2 place = a.at + i / 40.0 * a.width * way + (j / 8.0 * (a.ascent + a.descent) - a.descent) * up;
          EXPECT_FALSE(place.x > b.at.x && place.x < b.at.x + b.width && place.y > b.at.y - b.ascent &&
                       place.y < b.at.y + b.descent)
              << degrees << " " << along;
        }
    }
}

TEST(Drawing, Numbers) {
  EXPECT_EQ(dimension_number(2.5, 2), "2.5");
  EXPECT_EQ(dimension_number(10, 2), "10");
  EXPECT_EQ(dimension_number(-0.001, 2), "0");
  EXPECT_EQ(dimension_number(100, 0), "100");
  // Where nobody has said how many decimals.
  EXPECT_EQ(dimension_number(12.3456), "12.35");
  EXPECT_EQ(dimension_number(0.123), "0.12");
  EXPECT_EQ(dimension_number(0.0123), "0.012");
  EXPECT_EQ(dimension_number(1e-4), "0.0001");
  EXPECT_EQ(dimension_number(5e-5), "$5\\cdot 10^{-5}$");
  EXPECT_EQ(dimension_number(1e-6), "$10^{-6}$");
  EXPECT_EQ(dimension_number(9.99e-6), "$10^{-5}$");
  EXPECT_EQ(dimension_number(1.25e-7), "$1.2\\cdot 10^{-7}$");
  EXPECT_EQ(dimension_number(0), "0");
  EXPECT_EQ(round_values({0, 6}, 6), (std::vector<double>{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(round_values({0.1, 1.05}, 5).size(), 5u);  // 0.2, 0.4, .., 1
  EXPECT_EQ(round_values({-3, 7}, 3), (std::vector<double>{0, 5}));
}

Path straight(const Vec2& from, const Vec2& to) {
  Path path;
  path.from = from;
  path.steps.push_back(line_to(to));
  return path;
}

TEST(Overlaps, DrawnOnce) {
  Overlaps overlaps;
  const auto left_of = [&](const Path& path) { return overlaps.left_of(path, {}); };
  EXPECT_EQ(left_of(straight({0, 0}, {10, 0})).size(), 1u);
  EXPECT_EQ(left_of(straight({9, 0}, {1, 0})).size(), 0u);
  const auto beyond = left_of(straight({-5, 0}, {15, 0}));
  ASSERT_EQ(beyond.size(), 2u);
  EXPECT_EQ(beyond[0].steps[0].to.x, 0);
  EXPECT_EQ(beyond[1].from.x, 10);
  EXPECT_EQ(left_of(straight({0, 0}, {10, 5})).size(), 1u);
  Path curve;
  curve.steps.push_back(curve_to({3, 4}, {7, 4}, {10, 0}));
  EXPECT_EQ(left_of(curve).size(), 1u);
  EXPECT_EQ(left_of(curve).size(), 0u);
  // A large circle that begins elsewhere, and one a little larger.
  const auto circle = [](double radius, double from) {
    const PictureEllipse ellipse{{100, 100}, {radius, 0}, {0, radius}};
    Path path;
    path.from = ellipse.point(from);
    path.steps = arcs_to(ellipse, from, from + geometry::kTwoPi);
    path.closed = true;
    return path;
  };
  EXPECT_EQ(left_of(circle(60, 0)).size(), 1u);
  EXPECT_EQ(left_of(circle(60, 0.37)).size(), 0u);
  EXPECT_EQ(left_of(circle(60.003, 0.37)).size(), 1u);
  // One that is seen edge-on is a straight line, there and back.
  const PictureEllipse flat{{0, 50}, {8, 6}, {0, 0}};
  Path edge_on;
  edge_on.from = flat.point(1);
  edge_on.steps = arcs_to(flat, 1, 1 + geometry::kTwoPi);
  edge_on.closed = true;
  const auto line = left_of(edge_on);
  ASSERT_EQ(line.size(), 1u);
  ASSERT_EQ(line[0].steps.size(), 1u);
  EXPECT_NEAR(glm::length(line[0].end() - line[0].from), 20, 1e-3);
  EXPECT_EQ(left_of(straight({0, 50}, {4, 53})).size(), 0u);
}

// Of curves, what lines of the same object and pen cover between their ends.
TEST(Overlaps, OfPartsOfCurves) {
  constexpr double kTurn = geometry::kTwoPi;
  const PictureEllipse ellipse{{100, 100}, {60, 0}, {0, 40}};
  const auto arc = [&](double from, double to) {
    Path path;
    path.from = ellipse.point(from);
    path.steps = arcs_to(ellipse, from, to);
    path.closed = to - from == kTurn;
    return path;
  };
  const auto is_arc = [&](const Path& path, double from, double to) {
    EXPECT_NEAR(glm::length(path.from - ellipse.point(from)), 0, 2e-3);
    EXPECT_NEAR(glm::length(path.end() - ellipse.point(to)), 0, 2e-3);
    double angles = 0;
    for (const PathStep& step : path.steps) angles += step.end - step.begin;
    EXPECT_NEAR(angles, to - from, 1e-4);
  };
  Overlaps overlaps;
  is_arc(overlaps.left_of(arc(0, 1), {}).at(0), 0, 1);
  const auto beyond = overlaps.left_of(arc(0.5, 2), {});
  ASSERT_EQ(beyond.size(), 1u);
  is_arc(beyond[0], 1, 2);
  // Over the place where a closed one begins.
  const auto rest = overlaps.left_of(arc(5, 5 + kTurn), {});
  ASSERT_EQ(rest.size(), 1u);
  is_arc(rest[0], 2, kTurn);

  // The cubic (t, t^3) - for which the middle half of the parameters is another, with the handles of its polar form.
  const auto cubic = [](double a, double b) {
    const auto point = [](double r, double s, double t) { return 30.0 * Vec2((r + s + t) / 3, r * s * t); };
    Path path;
    path.from = point(a, a, a);
    path.steps = {curve_to(point(a, a, b), point(a, b, b), point(b, b, b))};
    return path;
  };
  Overlaps others;
  EXPECT_EQ(others.left_of(cubic(0.25, 0.75), {}).size(), 1u);
  EXPECT_EQ(others.left_of(cubic(0, 1), {.object = 3}).size(), 1u);
  const auto ends = others.left_of(cubic(-1, 1), {});
  ASSERT_EQ(ends.size(), 2u);
  for (const auto& [path, a, b] : {std::tuple(ends[0], -1.0, 0.25), std::tuple(ends[1], 0.75, 1.0)}) {
    const Path expected = cubic(a, b);
    ASSERT_EQ(path.steps.size(), 1u);
    for (const double s : {0.0, 0.3, 0.5, 1.0})
      EXPECT_NEAR(glm::length(point_on(path.from, path.steps[0], s) - point_on(expected.from, expected.steps[0], s)), 0,
                  2e-3);
  }
  // A line that touches a curve covers nothing of it.
  EXPECT_EQ(overlaps.left_of(straight({160, 90}, {160, 110}), {}).size(), 1u);
  Overlaps touching;
  EXPECT_EQ(touching.left_of(straight({160, 100}, {160, 110}), {}).size(), 1u);
  const auto whole = touching.left_of(arc(-1, 1), {});
  ASSERT_EQ(whole.size(), 1u);
  is_arc(whole[0], -1, 1);
}

// What covers another is no thinner, no fainter, and solid if that is; hidden lines are covered by all that are seen.
TEST(Overlaps, OfLinesOfDifferentPens) {
  const Path path = straight({0, 0}, {10, 0});
  const auto covers = [&](const Overlaps::Pen& above, const Overlaps::Pen& below) {
    Overlaps overlaps;
    overlaps.left_of(path, above);
    return overlaps.left_of(path, below).empty();
  };
  const Overlaps::Pen thin{.half_width = 0.1, .object = 0}, thick{.half_width = 0.5, .object = 1},
      dashed{.half_width = 0.5, .solid = false, .object = 0}, faint{.half_width = 0.5, .opacity = 0.5, .object = 0},
      hidden{.half_width = 0.5, .solid = false, .hidden = true, .object = 0}, annotation{.half_width = 0.5};
  EXPECT_TRUE(covers(thick, thin));
  EXPECT_FALSE(covers(thin, thick));
  EXPECT_TRUE(covers(thick, dashed));
  EXPECT_FALSE(covers(dashed, thick));
  EXPECT_TRUE(covers(dashed, dashed));
  EXPECT_TRUE(covers(thick, faint));
  EXPECT_FALSE(covers(faint, thick));
  EXPECT_TRUE(covers(thin, hidden));
  EXPECT_FALSE(covers(hidden, thick));
  EXPECT_FALSE(covers(annotation, thin));
  EXPECT_FALSE(covers(thick, annotation));
  EXPECT_TRUE(covers(annotation, annotation));
}

TEST(Sheets, Formats) {
  Sheet sheet;
  sheet.width = 40, sheet.height = 30;
  sheet.paper = Spectrum(1, 1, 1);
  sheet.title = "a < b";
  SheetText text = laid_out("$x_1 \\le 50\\,\\%$", "serif", 4);
  text.at = {10, 20};
  sheet.items.push_back(SheetGroup{"label", "", {}, {}, {text}});
  const std::string svg = svg_of(sheet), pdf = pdf_of(sheet);
  EXPECT_NE(svg.find("<title>a &lt; b</title>"), std::string::npos);
  EXPECT_NE(svg.find(">≤</tspan>"), std::string::npos);
  EXPECT_EQ(svg, svg_of(sheet));
  EXPECT_EQ(pdf, pdf_of(sheet));
  EXPECT_EQ(pdf.find("CreationDate"), std::string::npos);
  const DisplayImage image = pixels_of(sheet, 80, 60);
  EXPECT_EQ(image.samples.size(), 80u * 60 * 3);
  EXPECT_LT(*std::min_element(image.samples.begin(), image.samples.end()), 100);
  EXPECT_TRUE(without_texts(sheet).items.empty());
  const std::string overlay = latex_overlay(sheet, "a.pdf");
  EXPECT_NE(overlay.find("\\put(0.250000,0.250000)"), std::string::npos) << overlay;
  EXPECT_NE(overlay.find("50\\,\\%"), std::string::npos) << overlay;
}

// One text as LaTeX gets it.
std::string for_latex(const std::string& tex) {
  Sheet sheet;
  sheet.width = 40, sheet.height = 30;
  SheetText text = laid_out(tex, "serif", 4);
  text.at = {10, 20};
  sheet.items.push_back(text);
  const std::string overlay = latex_overlay(sheet, "a.pdf");
  const size_t begin = overlay.find("\\smash{") + 7;
  return overlay.substr(begin, overlay.find("}}}%", begin) - begin);
}

// Expected: what The TeXbook and fntguide say that LaTeX shows, which must be what the label shows elsewhere.
TEST(Latex, ShowsWhatTheLabelMeans) {
  EXPECT_EQ(for_latex("a_b^c"), "a\\_b\\textasciicircum{}c");
  EXPECT_EQ(for_latex("$a_b^c$"), "$a_b^c$");
  EXPECT_EQ(for_latex("^^5cinput"), "\\textasciicircum{}\\textasciicircum{}5cinput");
  EXPECT_EQ(for_latex("$a_{\\text{b_c $d_e$ f_g}}^2$ h_i"), "$a_{\\text{b\\_c $d_e$ f\\_g}}^2$ h\\_i");
  EXPECT_EQ(for_latex("\\textbf{a_b} 50 % #1 <x> | \"y\""),
            "\\textbf{a\\_b} 50 \\% \\#1 \\textless{}x\\textgreater{} \\textbar{} \\string\"y\\string\"");
  EXPECT_EQ(for_latex("$<x|y>$"), "$<x|y>$");
  EXPECT_EQ(for_latex("90° ≤ α × ⌀"),
            "90\\ensuremath{^\\circ} \\ensuremath{\\le} \\ensuremath{\\alpha} \\ensuremath{\\times} "
            "\\ensuremath{\\text{\\O}}");
  EXPECT_EQ(for_latex("$90° ≤ αx ∈ ℝ$"), "$90{^\\circ} \\le  \\alpha x \\in  {\\mathbb{R}}$");
  EXPECT_EQ(for_latex("$ℱ 𝔄$"), "${\\mathcal{F}} {\\mathfrak{A}}$");
  EXPECT_EQ(for_latex("$\\bm{x}\\degree \\div v$"), "$\\boldsymbol{x}{^\\circ} \\operatorname{div} v$");
  EXPECT_EQ(for_latex("ось x é"), "\\lekaloletters{T2A}{ось} x \\lekaloletters{T1}{é}");
  EXPECT_EQ(for_latex("$r_{ось}$"), "$r_{\\text{\\lekaloletters{T2A}{ось}}}$");
  EXPECT_THROW(for_latex("ǎ"), std::invalid_argument);
  const auto refused = [](const char* tex) { return std::holds_alternative<TextSlip>(parse_tex(tex)); };
  for (const char* tex : {"$x^^5c$", "$^^5c$", "$x_^2$", "$x_'$", "$\\hat^2$", "$x^2'$", "$\\sqrt[3]{x}$",
                          "$\\left a x\\right)$", "$\\left\\sum x\\right)$"})
    EXPECT_TRUE(refused(tex)) << tex;
  for (const char* tex : {"$x'^2$", "$x''_1$", "$\\left\\{ x \\right.$", "$\\left\\| x \\right\\rangle$", "$\\sqrt x$"})
    EXPECT_FALSE(refused(tex)) << tex;
}

TEST(Latex, FileNames) {
  Sheet sheet;
  sheet.width = 40, sheet.height = 30;
  EXPECT_NE(latex_overlay(sheet, "a_b c~^^5c&.pdf").find("{a_b c\\string~\\string^\\string^5c\\string&.pdf}"),
            std::string::npos);
  for (const char* name : {"a\n\\input{x}.pdf", "a%.pdf", "a#.pdf", "a$.pdf", "a}.pdf", "a\\b.pdf"})
    EXPECT_THROW(latex_overlay(sheet, name), std::invalid_argument) << name;
}

}  // namespace
}  // namespace lekalo::render::texts_test
