// Combinations: members, their order, and trees of any shape.
#include "formats/brlcad/database/tree.hpp"

#include <random>

#include "catch.hpp"
#include "formats/brlcad/database/database.hpp"
#include "formats/brlcad/reading.hpp"

using namespace graycube;
using namespace graycube::testing;

TEST_CASE("exclusive or and complement are what they say") {
  const std::string solids =
      "title t\nput a ell V {0 0 0} A {2 0 0} B {0 2 0} C {0 0 2}\nput b ell V {2 0 0} A {2 0 0} B "
      "{0 2 0} C {0 0 2}\n";
  const Scene either = scene_of(solids + "put r comb region yes tree {^ {l a} {l b}}\n", {"r"});
  CHECK(holds(either, -1, 0, 0));
  CHECK(holds(either, 3, 0, 0));
  CHECK_FALSE(holds(either, 1, 0, 0));
  const Scene rest = scene_of(solids + "put r comb region yes tree {n {l a} {! {l b}}}\n", {"r"});
  CHECK(holds(rest, -1, 0, 0));
  CHECK_FALSE(holds(rest, 1, 0, 0));
}

TEST_CASE("trees of 100 000 members are read, however they lean") {
  // Read in anything but linear time, these would take minutes.
  constexpr std::size_t kMembers = 100000;
  const auto repeated = [](const std::string& text) {
    std::string all;
    for (std::size_t i = 1; i < kMembers; ++i) all += text;
    return all;
  };
  for (const std::string op : {"u", "+"}) {
    const std::string left = repeated("{" + op + " ") + "{l first}" + repeated(" {l s}}");
    const std::string right = repeated("{" + op + " {l s} ") + "{l last}" + repeated("}");
    const std::string quoted = repeated("{" + op + " ") + "{l first}" + repeated(" l\\ s}");
    for (const std::string& text : {left, right, quoted}) {
      BrlcadReport report;
      const BrlcadDatabase database =
          read_brlcad_database("put r comb region yes tree " + text + "\n", report);
      REQUIRE_FALSE(report.has_errors());
      const auto& tree = std::get<BrlcadComb>(database.find("r")->value).tree;
      REQUIRE(tree);
      REQUIRE(tree->children.size() == kMembers);
      CHECK(tree->children.front().name == (text == right ? "s" : "first"));
      CHECK(tree->children.back().name == (text == right ? "last" : "s"));
    }
  }
  const std::string minus = repeated("{- ") + "{l first}" + repeated(" {l s}}");
  BrlcadReport report;
  const BrlcadDatabase database =
      read_brlcad_database("put r comb region yes tree " + minus + "\n", report);
  REQUIRE_FALSE(report.has_errors());
  CHECK(std::get<BrlcadComb>(database.find("r")->value).tree->children.size() == kMembers);
  // The scene that they make must take only linear time, too.
  const std::string sphere = "put s ell V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}\n";
  const Scene scene = scene_of(sphere + "put r comb region yes tree " + repeated("{u {l s} ") +
                               "{l s}" + repeated("}") + "\n");
  REQUIRE(scene.objects.size() == 1);
  CHECK(std::get<OperationNode>(scene.objects[0].csg.value).children.size() == kMembers);
}

TEST_CASE("members keep their order in chains that lean both ways") {
  // A random binary tree of unions over m0, m1, …; its chain is flat, so the members are all that's
  // left.
  std::mt19937 random(7);
  const auto chain = [&](const auto& self, int first, int count) -> std::string {
    if (count == 1) return "{l m" + std::to_string(first) + "}";
    const int left = 1 + static_cast<int>(random() % static_cast<unsigned>(count - 1));
    const std::string a = self(self, first, left), b = self(self, first + left, count - left);
    return "{u " + a + " " + b + "}";
  };
  for (int trial = 0; trial < 50; ++trial) {
    BrlcadReport report;
    const BrlcadDatabase database =
        read_brlcad_database("put r comb region yes tree " + chain(chain, 0, 200) + "\n", report);
    REQUIRE_FALSE(report.has_errors());
    const auto& tree = std::get<BrlcadComb>(database.find("r")->value).tree;
    REQUIRE(tree);
    REQUIRE(tree->children.size() == 200);
    for (std::size_t i = 0; i < 200; ++i)
      REQUIRE(tree->children[i].name == "m" + std::to_string(i));
  }
}

TEST_CASE(
    "a tree's words may hold braces, quotes and backslashes, and what is no tree is refused") {
  const auto read = [](const std::string& tree) {
    BrlcadReport report;
    const BrlcadDatabase database =
        read_brlcad_database("put r comb region yes tree {" + tree + "}\n", report);
    const BrlcadValue& value = database.find("r")->value;
    const auto* broken = std::get_if<BrlcadBroken>(&value);
    return broken != nullptr ? std::make_pair(std::optional<BrlcadTree>(), broken->why)
                             : std::make_pair(std::get<BrlcadComb>(value).tree, std::string());
  };
  const auto [tree, problem] = read(
      " - {l {a {b} c}}\n { ^ {l d{e}f} { ! {l \"g h\" {1 0 0 4 0 1 0 0 0 0 1 0 0 0 0 1} } } } ");
  CHECK(problem.empty());
  REQUIRE(tree);
  CHECK(tree->op == BrlcadTree::Op::kDifference);
  REQUIRE(tree->children.size() == 2);
  CHECK(tree->children[0].name == "a {b} c");
  REQUIRE(tree->children[1].children.size() == 2);
  CHECK(tree->children[1].children[0].name == "d{e}f");
  const BrlcadTree& complement = tree->children[1].children[1];
  CHECK(complement.op == BrlcadTree::Op::kNot);
  CHECK(complement.children[0].name == "g h");
  CHECK(complement.children[0].matrix->m[0][3] == 4);
  CHECK(read("l i\\ j").first->name == "i j");

  for (const char* text :
       {"- {u {l a} {! {l b}}} {l {c d}}", R"(- "u {l a} {! {l b}}" "l {c d}")",
        R"(- {u "l a" !\ {l\ b}} l\ {c\ d})", R"(- "u \"l a\" \"! l\\\\ b\"" {l "c d"})"}) {
    INFO(text);
    const auto [quoted, why] = read(text);
    CHECK(why.empty());
    REQUIRE(quoted);
    REQUIRE(quoted->children.size() == 2);
    CHECK(quoted->children[1].name == "c d");
    REQUIRE(quoted->children[0].children.size() == 2);
    CHECK(quoted->children[0].children[0].name == "a");
    REQUIRE(quoted->children[0].children[1].op == BrlcadTree::Op::kNot);
    CHECK(quoted->children[0].children[1].children[0].name == "b");
  }

  for (const char* text : {"u {l a}", "u {l a} {l b} {l c}", "! {l a} {l b}", "x {l a} {l b}", "l",
                           "l a {1 0} b", "u l a", "{l a}", "{}", "u {l a} {}", "u {l a} {l b} c",
                           "u \"l a\" \"x\"", "u \"l a\"", "! \"l a\" \"l b\""}) {
    INFO(text);
    const auto [nothing, why] = read(text);
    CHECK_FALSE(nothing);
    CHECK_FALSE(why.empty());
  }
  const auto broken = read("l a {1 2 3}").first;
  REQUIRE(broken);
  CHECK(broken->has_broken_matrix);
  std::string deep = "l s";
  for (std::size_t i = 0; i <= kMaxBrlcadTreeDepth; ++i) deep = "- {l s} {" + deep + "}";
  CHECK(read(deep).second.find("deeper than 100 levels") != std::string::npos);
}

TEST_CASE("a name with braces is the same where g2asc puts it and in a tree") {
  const Scene scene = scene_of(
      R"(title {\{t\}}
put {a\{b} ell V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}
put {c\{d\}} ell V {5 0 0} A {1 0 0} B {0 1 0} C {0 0 1}
put {r\}} comb region yes tree {u {l a\{b} {l {c{d}}}}
attr set {r\}} {rgb} {255/0/0}
)",
      {"r}"});
  CHECK(holds(scene, 0, 0, 0));
  CHECK(holds(scene, 5, 0, 0));
  REQUIRE(scene.materials.size() == 1);
  CHECK(scene.materials[0].material.color.g == 0);
}
