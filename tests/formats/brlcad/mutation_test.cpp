// Hostile input: whatever happens to a database, reading it ends with a scene or with errors.
#include <random>

#include "catch.hpp"
#include "formats/brlcad/model.hpp"
#include "fuzz/brlcad_fuzz.hpp"

using namespace graycube::testing;

namespace {

std::string v4_text() {
  return kV4Head + v4_sphere("s", 1, 2, 3, 2) + v4_box("b", 0, 0, 0, 4, 4, 4) +
         v4_solid(18, "c", {0, 0, 0, 0, 0, 5, 2, 0, 0, 0, 2, 0, 1, 0, 0, 0, 0.5, 0}) +
         v4_solid(16, "t", {0, 0, 0, 0, 0, 1, 3, 0, 0}) +
         "p q 0 0 0 0 0 9 2 1\nw w\n1 2 3 0 0 0\n1 2 3 9 0 0\n1 2 3 9 9 0\nEND_PIPE\n" +
         v4_region("r") + v4_member('u', "s") + v4_member('-', "b") + v4_member('+', "c") +
         v4_group("g") + v4_member('u', "r") + v4_member('u', "t") + v4_member('u', "q") +
         v4_member('u', "w");
}
std::string v5_text() {
  return "title {a}\nput e ehy V {0 0 0} H {0 0 2} A {1 0 0} r_1 1 r_2 2 c 1\n"
         "put o eto V {0 0 0} N {0 0 1} C {1 0 1} r 5 r_d 0.5\nput h hyp V {0 0 0} H {0 0 4} A {2 "
         "0 0} b 1 bnr 0.5\n"
         "put n arbn N 6 P0 {1 0 0 1} P1 {-1 0 0 1} P2 {0 1 0 1} P3 {0 -1 0 1} P4 {0 0 1 1} P5 {0 "
         "0 -1 1}\n"
         "put p pipe V0 {0 0 0} O0 2 I0 1 R0 3 V1 {10 0 0} O1 2 I1 1 R1 3 V2 {10 10 0} O2 2 I2 1 "
         "R2 3\n"
         "put r comb region yes rgb {255 0 0} shader {glass {ri 1.3}} tree {- {u {l e} {l o}} {n "
         "{l h} {! {l n}}}}\n"
         "attr set {r} region_id 7 aircode 0\nput x comb region no tree {^ {l r} {l p {1 0 0 4  0 "
         "1 0 0  0 0 1 0  0 0 0 0.5}}}\n";
}
std::string v5_binary() {
  V5Binary g;
  g.solid("s", 3, {1, 2, 3, 2, 0, 0, 0, 2, 0, 0, 0, 2});
  g.solid("t", 1, {0, 0, 0, 0, 0, 1, 3, 1});
  g.solid("c", 2, {0, 0, 0, 0, 0, 5, 2, 0, 0, 0, 2, 0, 1, 0, 0, 0, 0.5, 0});
  g.comb("r", {"s", "t", "c"}, "\x01\x01\x04\x01\x02",
         {{1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2}}, {0, -1, 0},
         std::string("region\0R\0", 9));
  return g.bytes();
}

void mutate(std::string& bytes, std::mt19937& random) {
  if (bytes.empty()) return;
  const auto at = [&] { return static_cast<std::size_t>(random()) % bytes.size(); };
  static const char* const kWords[] = {"1e300",  "-1", "0",          "nan", "{", "}",
                                       "1e-300", "\n", "9999999999", "u",   "-"};
  switch (random() % 6) {
    case 0: bytes[at()] = static_cast<char>(random()); break;
    case 1: bytes[at()] = static_cast<char>('0' + random() % 10); break;
    case 2: bytes.erase(at(), random() % 9); break;
    case 3: bytes.insert(at(), kWords[random() % std::size(kWords)]); break;
    case 4: bytes.insert(at(), bytes.substr(at(), random() % 60)); break;
    default: bytes.resize(at()); break;
  }
}

}  // namespace

TEST_CASE("whatever happens to a BRL-CAD database, it is read or refused") {
  int seed = 0;
  for (const std::string& whole : {v4_text(), v5_text(), v5_binary()}) {
    fuzz_brlcad(whole);
    REQUIRE(graycube::read_brlcad(whole).scene);
    for (int i = 0; i < 300; ++i) {
      std::mt19937 random(static_cast<unsigned>(++seed));
      std::string bytes = whole;
      for (unsigned n = 1 + static_cast<unsigned>(random() % 6); n > 0; --n) mutate(bytes, random);
      INFO("seed " << seed);
      fuzz_brlcad(bytes);
    }
  }
}
