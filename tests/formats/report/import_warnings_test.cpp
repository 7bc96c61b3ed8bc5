#include "formats/report/import_warnings.hpp"

#include <string>

#include "catch.hpp"

namespace graycube {
namespace {

TEST_CASE("a kind of warning is told once, where it came first, with a count") {
  ImportWarnings warnings(10);
  for (int i = 1; i <= 843; ++i) {
    warnings.add("empty", "line " + std::to_string(i), "nothing is in it");
  }
  warnings.add("digits", "", "six digits");
  CHECK(warnings.take() ==
        std::vector<ImportWarning>{{"line 1", "nothing is in it (and 842 more like it)", false},
                                   {"", "six digits", false}});
  CHECK(warnings.take().empty());
}

TEST_CASE("a kind of which one leaves something out does so, even beyond the kinds that are kept") {
  ImportWarnings warnings(1);
  warnings.add("part", "a", "is odd");
  warnings.leave_out("part", "b", "is left out");
  warnings.add("x", "", "x");
  CHECK(warnings.take() ==
        std::vector<ImportWarning>{{"a", "is odd (and 1 more like it)", true},
                                   {"", "and 1 more warnings of other kinds", false}});
  warnings.add("part", "a", "is odd");
  warnings.leave_out("y", "", "y");
  CHECK(warnings.take()[1].leaves_out);
}

}  // namespace
}  // namespace graycube
