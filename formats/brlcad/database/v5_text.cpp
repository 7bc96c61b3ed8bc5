// BRL-CAD's text of version 5: a Tcl script of `put NAME KIND KEY VALUE …`, `attr set NAME KEY
// VALUE …`, `title`, `units` and `color`.
#include <span>
#include <unordered_map>

#include "formats/brlcad/database/database.hpp"
#include "formats/brlcad/database/words.hpp"

namespace graycube {
namespace {

/// A key of a `put` command and how many numbers it has.
struct Key {
  std::string_view name;
  std::size_t count;
};
struct Layout {
  std::string_view kind;
  BrlcadKind is;
  std::span<const Key> keys;
};

constexpr Key kArb8[] = {{"V1", 3}, {"V2", 3}, {"V3", 3}, {"V4", 3},
                         {"V5", 3}, {"V6", 3}, {"V7", 3}, {"V8", 3}};
constexpr Key kTgc[] = {{"V", 3}, {"H", 3}, {"A", 3}, {"B", 3}, {"C", 3}, {"D", 3}};
constexpr Key kEll[] = {{"V", 3}, {"A", 3}, {"B", 3}, {"C", 3}};
constexpr Key kTor[] = {{"V", 3}, {"H", 3}, {"r_a", 1}, {"r_h", 1}};
constexpr Key kHalf[] = {{"N", 3}, {"d", 1}};
constexpr Key kRpc[] = {{"V", 3}, {"H", 3}, {"B", 3}, {"r", 1}};
constexpr Key kRhc[] = {{"V", 3}, {"H", 3}, {"B", 3}, {"r", 1}, {"c", 1}};
constexpr Key kEpa[] = {{"V", 3}, {"H", 3}, {"A", 3}, {"r_1", 1}, {"r_2", 1}};
constexpr Key kEhy[] = {{"V", 3}, {"H", 3}, {"A", 3}, {"r_1", 1}, {"r_2", 1}, {"c", 1}};
constexpr Key kHyp[] = {{"V", 3}, {"H", 3}, {"A", 3}, {"b", 1}, {"bnr", 1}};
constexpr Key kEto[] = {{"V", 3}, {"N", 3}, {"C", 3}, {"r", 1}, {"r_d", 1}};
constexpr Key kSuperell[] = {{"V", 3}, {"A", 3}, {"B", 3}, {"C", 3}, {"n", 1}, {"e", 1}};
constexpr Key kPart[] = {{"V", 3}, {"H", 3}, {"r_v", 1}, {"r_h", 1}};

constexpr Layout kLayouts[] = {
    {"arb8", BrlcadKind::kArb8, kArb8},
    {"tgc", BrlcadKind::kTgc, kTgc},
    {"rec", BrlcadKind::kTgc, kTgc},
    {"ell", BrlcadKind::kEll, kEll},
    {"sph", BrlcadKind::kEll, kEll},
    {"tor", BrlcadKind::kTor, kTor},
    {"half", BrlcadKind::kHalf, kHalf},
    {"rpc", BrlcadKind::kRpc, kRpc},
    {"rhc", BrlcadKind::kRhc, kRhc},
    {"epa", BrlcadKind::kEpa, kEpa},
    {"ehy", BrlcadKind::kEhy, kEhy},
    {"hyp", BrlcadKind::kHyp, kHyp},
    {"eto", BrlcadKind::kEto, kEto},
    {"part", BrlcadKind::kPart, kPart},
    {"superell", BrlcadKind::kSuperell, kSuperell},
};

using Words = std::vector<std::string>;

/// g2asc puts a name in braces and a backslash before each brace of its own. Tcl leaves the
/// backslashes there, but in a tree the name stands without them.
std::string name_of(std::string_view word) {
  std::string name;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const bool escapes =
        word[i] == '\\' && i + 1 < word.size() && (word[i + 1] == '{' || word[i + 1] == '}');
    if (!escapes) name += word[i];
  }
  return name;
}

class V5TextReader {
 public:
  V5TextReader(std::string_view text, BrlcadReport& report)
      : script_(text, TclWords::Ends::kAtLine), report_(report) {}

  BrlcadDatabase read() {
    while (script_.next_line()) {
      line_ = script_.line();
      Words words;
      for (std::string word; words.size() < kMaxWords && script_.next(word);) {
        words.push_back(std::move(word));
      }
      if (script_.is_broken()) break;
      command(words);
      if (database_.objects.size() > kMaxBrlcadObjects) {
        report_.error(where(), "more than " + std::to_string(kMaxBrlcadObjects) + " objects");
        break;
      }
    }
    if (script_.is_broken()) report_.error(where(), "a brace or quote without its end");
    return std::move(database_);
  }

 private:
  static constexpr std::size_t kMaxWords = 4 * kMaxBrlcadNumbers;
  static constexpr const char* kNoTriples = "expected a list of three numbers each";

  std::string where() const { return "line " + std::to_string(line_); }
  void command(const Words& words) {
    const std::string& verb = words.front();
    if (verb == "put" && words.size() >= 2) {
      put(words);
    } else if (verb == "attr" && words.size() >= 3 && words[1] == "set") {
      attributes(words);
    } else if (verb == "title" && words.size() >= 2) {
      database_.title = name_of(words[1]);
    } else if (verb == "color" && words.size() >= 6) {
      color(words);
    } else if (verb == "put" || verb == "attr") {
      report_.warning_once("short " + verb, where(), "'" + verb + "' wants more words: left out");
    } else if (verb != "title" && verb != "units" && verb != "color" && verb != "find" &&
               verb != "rm" && verb != "dbfind") {
      report_.warning_once("command " + verb, where(), "the command '" + verb + "' is left out");
    }
  }

  void color(const Words& words) {
    const auto low = parse_brlcad_integer(words[1]);
    const auto high = parse_brlcad_integer(words[2]);
    const auto rgb = parse_brlcad_rgb(words[3] + " " + words[4] + " " + words[5]);
    if (low && high && rgb) database_.colors.push_back({*low, *high, *rgb});
  }

  void attributes(const Words& words) {
    BrlcadObject* object = database_.find(name_of(words[2]));
    BrlcadComb* comb = object != nullptr ? std::get_if<BrlcadComb>(&object->value) : nullptr;
    for (std::size_t i = 3; i + 1 < words.size(); i += 2) {
      if (words[2] == "_GLOBAL") {
        set_brlcad_global(database_, words[i], words[i + 1]);
      } else if (comb != nullptr) {
        set_brlcad_attribute(*comb, words[i], words[i + 1]);
      }
    }
  }

  void put(const Words& words) {
    BrlcadObject object;
    object.name = name_of(words[1]);
    object.where = where();
    object.value = value_of_put(words);
    database_.add(std::move(object));
  }

  static BrlcadValue value_of_put(const Words& words) {
    if (words.size() < 3) return BrlcadBroken{"'put' wants a kind behind the name"};
    const std::string& kind = words[2];
    if (kind == "comb") return comb(words);
    if (kind == "arbn") return arbn(words);
    if (kind == "pipe") return pipe(words);
    if (kind == "ars") return ars(words);
    if (kind == "bot") return bot(words);
    return fixed(words);
  }

  /// The value of a key; null when the command doesn't have it.
  static const std::string* value_of(const Words& words, std::string_view key) {
    for (std::size_t i = 3; i + 1 < words.size(); i += 2) {
      if (words[i] == key) return &words[i + 1];
    }
    return nullptr;
  }

  static BrlcadValue fixed(const Words& words) {
    for (const Layout& layout : kLayouts) {
      if (layout.kind != words[2]) continue;
      BrlcadSolid solid;
      solid.kind = layout.is;
      for (const Key& key : layout.keys) {
        const std::string* value = value_of(words, key.name);
        if (value == nullptr || !append_brlcad_numbers(*value, key.count, solid.values)) {
          return BrlcadBroken{"expected " + std::string(key.name) + " with " +
                              std::to_string(key.count) + " numbers"};
        }
      }
      return solid;
    }
    return BrlcadForeign{words[2]};
  }

  /// The values of KEY0, KEY1, …, as many as there are.
  static std::vector<const std::string*> values_of(const Words& words, const std::string& key) {
    std::unordered_map<std::string_view, const std::string*> values;
    for (std::size_t i = 3; i + 1 < words.size(); i += 2) values.emplace(words[i], &words[i + 1]);
    std::vector<const std::string*> list;
    for (;;) {
      const auto found = values.find(key + std::to_string(list.size()));
      if (found == values.end()) return list;
      list.push_back(found->second);
    }
  }

  static BrlcadValue arbn(const Words& words) {
    BrlcadSolid solid{BrlcadKind::kArbn, {}, {}};
    for (std::size_t i = 3; i + 1 < words.size(); i += 2) {
      if (words[i].size() < 2 || words[i][0] != 'P' || solid.values.size() >= kMaxBrlcadNumbers)
        continue;
      if (!append_brlcad_numbers(words[i + 1], 4, solid.values)) {
        return BrlcadBroken{"expected " + words[i] + " with 4 numbers"};
      }
    }
    return solid;
  }

  static BrlcadValue pipe(const Words& words) {
    BrlcadSolid solid{BrlcadKind::kPipe, {}, {}};
    std::vector<double> all;
    if ((words.size() - 3) % 8 != 0) return BrlcadBroken{"its last point is not whole"};
    // Each point has V0 {…} O0 o I0 i R0 r, in any order within the point; then V1 … follows.
    for (std::size_t at = 3; at + 7 < words.size() && all.size() < kMaxBrlcadNumbers; at += 8) {
      const std::string number = std::to_string((at - 3) / 8);
      std::array<double, 6> point{};
      for (std::size_t i = at; i < at + 8; i += 2) {
        std::vector<double> v;
        const bool is_place = words[i] == "V" + number;
        const std::size_t slot = is_place                   ? 0
                                 : words[i] == "I" + number ? 3
                                 : words[i] == "O" + number ? 4
                                 : words[i] == "R" + number ? 5
                                                            : 6;
        if (slot == 6 || !append_brlcad_numbers(words[i + 1], is_place ? 3 : 1, v)) {
          return BrlcadBroken{"expected V" + number + ", O" + number + ", I" + number + " and R" +
                              number};
        }
        std::copy(v.begin(), v.end(), point.begin() + static_cast<std::ptrdiff_t>(slot));
      }
      all.insert(all.end(), point.begin(), point.end());
    }
    solid.values = std::move(all);
    return solid;
  }

  /// Reads a list of points, or of triples of indices: {{x y z} {x y z} …}.
  static bool triples(const std::string& text, std::vector<double>& out) {
    TclWords words(text);
    for (std::string word; words.next(word);) {
      if (out.size() / 3 >= kMaxBrlcadVertices || !append_brlcad_numbers(word, 3, out))
        return false;
    }
    return !words.is_broken();
  }
  static std::vector<Vec3> points_of(const std::vector<double>& v) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) points.push_back({v[i], v[i + 1], v[i + 2]});
    return points;
  }

  static BrlcadValue ars(const Words& words) {
    BrlcadSolid solid{BrlcadKind::kArs, {}, {}};
    std::vector<double> numbers;
    const auto curves = values_of(words, "C");
    std::size_t per_curve = 0;
    for (const std::string* curve : curves) {
      const std::size_t before = numbers.size();
      if (!triples(*curve, numbers)) return BrlcadBroken{kNoTriples};
      const std::size_t count = (numbers.size() - before) / 3;
      if (curve == curves.front()) per_curve = count;
      if (count != per_curve) return BrlcadBroken{"its curves differ in their number of points"};
    }
    if (curves.size() < 2 || per_curve < 3)
      return BrlcadBroken{"expected two curves or more of three points or more"};
    solid.mesh = brlcad_ars_mesh(points_of(numbers), curves.size(), per_curve);
    return solid;
  }

  static BrlcadValue bot(const Words& words) {
    const std::string* mode = value_of(words, "mode");
    if (mode != nullptr && *mode != "volume" && *mode != "solid" && *mode != "2") {
      return BrlcadForeign{"bot in " + *mode + " mode"};
    }
    BrlcadSolid solid{BrlcadKind::kBot, {}, {}};
    const std::string* vertices = value_of(words, "V");
    const std::string* faces = value_of(words, "F");
    std::vector<double> places, corners;
    if (vertices == nullptr || faces == nullptr) return BrlcadBroken{"expected V and F"};
    if (!triples(*vertices, places) || !triples(*faces, corners)) return BrlcadBroken{kNoTriples};
    solid.mesh.vertices = points_of(places);
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      std::array<std::uint32_t, 3> face{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double index = corners[i + k];
        if (!(index >= 0 && index < static_cast<double>(solid.mesh.vertices.size())))
          return BrlcadBroken{"a face names a vertex that isn't there"};
        face[k] = static_cast<std::uint32_t>(index);
      }
      solid.mesh.faces.push_back(face);
    }
    return solid;
  }

  static BrlcadValue comb(const Words& words) {
    BrlcadComb comb;
    std::string problem;
    for (std::size_t i = 3; i + 1 < words.size(); i += 2) {
      if (words[i] == "tree") {
        if (words[i + 1].find_first_not_of(" \t\r\n") == std::string::npos) continue;
        comb.tree = read_brlcad_tree_text(words[i + 1], problem);
        if (!comb.tree) return BrlcadBroken{problem};
      } else if (words[i] == "region") {
        comb.is_region = words[i + 1] == "yes" || words[i + 1] == "1";
      } else {
        set_brlcad_attribute(comb, words[i], words[i + 1]);
      }
    }
    return comb;
  }

  TclWords script_;
  BrlcadReport& report_;
  std::size_t line_ = 1;
  BrlcadDatabase database_;
};

}  // namespace

BrlcadDatabase read_brlcad_v5_text(std::string_view text, BrlcadReport& report) {
  return V5TextReader(text, report).read();
}

}  // namespace graycube
