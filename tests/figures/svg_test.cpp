#include "figures/page/svg.hpp"

#include "catch.hpp"
#include "figures/hypercube_figure.hpp"
#include "figures/page/page.hpp"
#include "figures/page/shown_picture.hpp"
#include "figures/well_formed.hpp"
#include "film/picture_files.hpp"

namespace graycube::figures {
namespace {

using testing::xml_problem;

TEST_CASE("a drawing is well-formed whatever a scene is called") {
  for (const char* name : {"plain.json", "a<b>&\"c\".json", "odd\xff\xfe.json", "\xEF\xBF\xBF",
                           "bell\x07.json", "\xC3\xA9t\xC3\xA9.json"}) {
    Svg svg = begin_page(100, 50, name, name);
    draw_legend(svg, {0, 0}, 100, {{LegendEntry::Sign::kArrow, kRed, name}});
    svg.begin_clip({0, 0, 10, 10});
    svg.arrow({0, 0}, {10, 10}, {.stroke = kRed});
    svg.end_clip();
    INFO(svg.finish());
    CHECK(xml_problem(svg.finish()).empty());
  }
  CHECK_FALSE(xml_problem("<svg><g></svg>").empty());
  CHECK_FALSE(xml_problem("<svg a=\"1\" a=\"2\"/>").empty());
  CHECK_FALSE(xml_problem("<svg>a & b</svg>").empty());
}

TEST_CASE("coordinates are short, and never what SVG can't read") {
  CHECK(coordinate(12) == "12");
  CHECK(coordinate(-0.04) == "0");
  CHECK(coordinate(3.25) == "3.2");
  CHECK(coordinate(1.0 / 0.0) == "0");
  CHECK(coordinate(1e300) == "1000000");
  CHECK(count_text(1234567) == "1\u2009234\u2009567");
}

TEST_CASE("base64 is that of the standard's examples") {
  CHECK(base64_of("") == "");
  CHECK(base64_of("f") == "Zg==");
  CHECK(base64_of("fo") == "Zm8=");
  CHECK(base64_of("foo") == "Zm9v");
  CHECK(base64_of("foobar") == "Zm9vYmFy");
}

TEST_CASE("a picture is made smaller by means of whole squares") {
  Picture picture{5, 3, std::vector<float>(45, 1.0f), {}, {}};
  picture.rgb[0] = 5;
  const Picture small = shrunk(picture, 3);
  CHECK(small.width == 3);
  CHECK(small.height == 2);
  CHECK(small.rgb[0] == 2.0f);  // (5 + 1 + 1 + 1) / 4
  CHECK(small.rgb.back() == 1.0f);
  CHECK(shrunk(picture, 5) == picture);
  CHECK(png_text(picture).starts_with("\x89PNG\r\n"));
}

TEST_CASE("a hypercube has all its links, and all of a grid's neighbours are among them") {
  for (std::uint32_t nodes = 1; nodes <= kMostNodesDrawn; nodes *= 2) {
    const Hypercube cube = *Hypercube::of_size(nodes);
    std::size_t used = 0;
    for (const CubeEdge& e : edges_of(cube)) {
      CHECK(cube.link_between(e.a, e.b));
      if (e.use == CubeEdge::Use::kUnused) continue;
      ++used;
      CHECK((cube.row_of(e.a) == cube.row_of(e.b)) == (e.use == CubeEdge::Use::kColumns));
    }
    CHECK(edges_of(cube).size() == std::size_t{nodes} * cube.dimension() / 2);
    // A ring of one has no link, one of two has one, longer ones have as many as nodes.
    const auto ring = [](std::size_t n) { return n < 2 ? 0 : n == 2 ? 1 : n; };
    CHECK(used == cube.rows() * ring(cube.columns()) + cube.columns() * ring(cube.rows()));
    CHECK(xml_problem(hypercube_svg(cube)).empty());
  }
}

}  // namespace
}  // namespace graycube::figures
