#include "formats/openscad/language/parser.hpp"

#include <cmath>

#include "catch.hpp"
#include "formats/openscad/reading.hpp"

namespace graycube {
namespace {

using testing::errors_of;

std::vector<ScadModule> parsed(const std::string& text) {
  OpenscadReport report;
  std::vector<ScadModule> modules = parse_openscad(text, report);
  for (const OpenscadError& error : report.take_errors()) FAIL(error.line << ": " << error.message);
  return modules;
}

ScadValue value_of(const std::string& text) {
  const std::vector<ScadModule> modules = parsed("m(a = " + text + ");");
  return modules.at(0).arguments.at(0).value;
}

double number_of(const std::string& text) {
  const ScadValue value = value_of(text);
  REQUIRE(value.number() != nullptr);
  return *value.number();
}

std::string repeated(const std::string& piece, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += piece;
  return result;
}

TEST_CASE("modules nest and keep their lines, arguments and modifiers") {
  const auto modules = parsed(
      "group() {\n\tcube(size = [1, 2, 3], center = true);\n#\tsphere(r = 2);\n}\n%a();*b();!c();");
  REQUIRE(modules.size() == 4);
  const ScadModule& group = modules[0];
  CHECK(group.name == "group");
  CHECK(group.line == 1);
  REQUIRE(group.children.size() == 2);
  const ScadModule& cube = group.children[0];
  CHECK(cube.line == 2);
  CHECK(cube.argument("size")->list()->at(2).number()[0] == 3);
  CHECK(*cube.argument("center")->boolean());
  CHECK(group.children[1].line == 3);
  CHECK_FALSE(group.children[1].left_out);
  CHECK(modules[1].left_out);
  CHECK(modules[2].left_out);
  CHECK(modules[3].root);
}

TEST_CASE("numbers are read as OpenSCAD writes them") {
  CHECK(number_of("1e-07") == 1e-7);
  CHECK(number_of("1e+10") == 1e10);
  CHECK(number_of("-0.469846") == -0.469846);
  CHECK(number_of(".5") == 0.5);
  CHECK(number_of("inf") == INFINITY);
  CHECK(number_of("-inf") == -INFINITY);
  CHECK(std::isnan(number_of("nan")));
  CHECK(std::isnan(number_of("-nan")));
}

TEST_CASE("undef counts as an argument that isn't given") {
  CHECK(value_of("undef").is_undef());
  const auto modules = parsed("m(a = undef, 7);");
  CHECK(modules[0].argument("a") == nullptr);
  CHECK(modules[0].argument("b", 0)->number()[0] == 7);
  CHECK(modules[0].argument("c", 1) == nullptr);
}

TEST_CASE("a string goes on to the quote that ends an argument, since OpenSCAD doesn't escape") {
  const auto text = [](const std::string& s) { return std::get<std::string>(value_of(s).value); };
  CHECK(text(R"("plain")") == "plain");
  CHECK(text(R"("say "hi" to all")") == R"(say "hi" to all)");
  CHECK(text("\"two\nlines\"") == "two\nlines");
  const auto modules = parsed("t(a = \"one\ntwo\");\nm();");
  CHECK(modules[1].line == 3);
}

TEST_CASE("comments and odd blanks are skipped") {
  const auto modules = parsed("// one\r\n/* two\n three */ m ( ) ; // end");
  REQUIRE(modules.size() == 1);
  CHECK(modules[0].line == 3);
}

TEST_CASE("a module may have one child without braces") {
  const auto modules = parsed("a() b() { c(); d(); }");
  REQUIRE(modules.size() == 1);
  REQUIRE(modules[0].children.size() == 1);
  CHECK(modules[0].children[0].children.size() == 2);
}

TEST_CASE("every syntax error of a file is reported with its line") {
  const auto errors = errors_of(
      "cube(size = [1, 2 3]);\n"
      "sphere(r = 1;\n"
      "group() {\n"
      "  cube(size = ?);\n"
      "  cylinder(h == 3) ;\n"
      "}\n"
      "cube()\n");
  REQUIRE(errors.size() == 5);
  CHECK(errors[0].starts_with("1: expected ',' or ']', found a number"));
  CHECK(errors[1].starts_with("2: expected ',' or ')', found ';'"));
  CHECK(errors[2].starts_with("4: unexpected '?'"));
  CHECK(errors[3].starts_with("5: expected a value, found '='"));
  CHECK(errors[4] == "8: expected ';' or '{', found the end of the file");
}

TEST_CASE("braces that don't match are errors") {
  CHECK(errors_of("group() {\n cube(1);") ==
        std::vector<std::string>{"2: the '{' of line 1 is never closed"});
  CHECK(errors_of("cube(1);\n}\ncube(1);") ==
        std::vector<std::string>{"2: a '}' that closes nothing"});
}

TEST_CASE("errors inside a broken module's children are found as well") {
  const auto errors = errors_of("union(a = b + c) {\n  minkowski() { surface(); }\n}");
  REQUIRE(errors.size() == 2);
  CHECK(errors[1].starts_with("2: minkowski()"));
}

TEST_CASE("source code of OpenSCAD gets a hint how to make a .csg file of it") {
  for (const char* source :
       {"size = 3;", "cube(size = 2 * 3);", "for (i = [0 : 3]) cube(i);", "module m() {}"}) {
    const auto errors = errors_of(source);
    INFO(source);
    REQUIRE_FALSE(errors.empty());
    CHECK_THAT(errors[0], Catch::Contains("openscad -o MODEL.csg MODEL.scad"));
  }
}

TEST_CASE("tokens that can't be are named") {
  CHECK(errors_of("cube(size = 1.2.3);")[0].starts_with("1: this number is followed by '.'"));
  CHECK(errors_of("cube(size = 3x);")[0].starts_with("1: this number is followed by 'x'"));
  CHECK(errors_of("cube(size = 1e999);")[0].starts_with("1: this number is out of range"));
  CHECK(errors_of("cube(\x80);")[0].starts_with("1: unexpected byte 0x80"));
  CHECK(errors_of("text(text = \"abc);")[0].starts_with("1: this string has no end"));
  CHECK(errors_of("cube(1); /* abc")[0].starts_with("1: this comment has no end"));
}

TEST_CASE("nesting up to the limit is taken, deeper nesting is one error") {
  const auto nested = [](int depth) {
    return repeated("group() {\n", depth - 1) + "cube(1);" + repeated("}", depth - 1);
  };
  CHECK(errors_of(nested(kMaxOpenscadNesting)).empty());
  CHECK(errors_of(nested(kMaxOpenscadNesting + 1)) ==
        std::vector<std::string>{"513: modules nested more than 512 deep"});
  CHECK(errors_of(repeated("group() ", 100000)) ==
        std::vector<std::string>{"1: modules nested more than 512 deep"});
  CHECK(errors_of("m(" + repeated("[", 100000)) ==
        std::vector<std::string>{"1: lists nested more than 16 deep"});
}

TEST_CASE("a file past the limits of size, modules or values is refused") {
  CHECK(errors_of(std::string(kMaxOpenscadBytes + 1, ' ')).size() == 1);
  const auto first_error = [](const std::string& text) {
    OpenscadReport report;
    parse_openscad(text, report, {.modules = 10, .values = 20});
    const auto errors = report.take_errors();
    return errors.empty() ? "none" : errors.at(0).message;
  };
  CHECK(first_error(repeated("g();", 10)) == "none");
  CHECK(first_error(repeated("g();", 11) + repeated("(", 9)) == "more than 10 modules");
  CHECK(first_error("g(" + repeated("1,", 19) + "1);") == "none");
  CHECK(first_error("g([" + repeated("1,", 20) + "1]);") == "more than 20 values");
}

TEST_CASE("past the cap errors are only counted") {
  const auto errors = errors_of(repeated("minkowski() { surface(); }\n", 150));
  REQUIRE(errors.size() == kMaxOpenscadErrors + 1);
  CHECK(errors[99].starts_with("100: minkowski()"));
  CHECK(errors[100] == "0: and 50 more errors");
}

}  // namespace
}  // namespace graycube
