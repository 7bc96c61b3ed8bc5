// BRL-CAD's text of version 4: records of one line each; the first letter is the record's kind.
#include <algorithm>
#include <cmath>

#include "formats/brlcad/database/database.hpp"
#include "formats/brlcad/database/v4_lines.hpp"
#include "formats/brlcad/database/words.hpp"

namespace graycube {
namespace {

/// The numbers by which records name the types of solids.
enum SolidType : long {
  kTorus = 16,
  kGeneralCone = 18,
  kEllipsoid = 19,
  kArb = 20,
  kHalfSpace = 24,
  kRpcType = 26,
  kRhcType = 27,
  kEpaType = 28,
  kEhyType = 29,
  kEtoType = 30,
  kHypType = 38,
};

using Values = std::vector<double>;

double length_at(const Values& v, std::size_t at) {
  return length(Vec3{v[at], v[at + 1], v[at + 2]});
}

void make_unit(Values& v, std::size_t at) {
  const double l = length_at(v, at);
  for (std::size_t i = at; l > 0 && i < at + 3; ++i) v[i] /= l;
}

class V4TextReader {
 public:
  V4TextReader(std::string_view text, BrlcadReport& report) : lines_(text), report_(report) {}

  BrlcadDatabase read() {
    while (next_line() && !report_.has_errors()) {
      if (line().empty() || line().front() == '#') continue;
      record();
      if (database_.objects.size() > kMaxBrlcadObjects) {
        fail("more than " + std::to_string(kMaxBrlcadObjects) + " objects");
      }
    }
    return std::move(database_);
  }

 private:
  static constexpr std::string_view kEndPipe = "END_PIPE";
  /// The letters that rows of a bot may begin with: v4_binary.cpp writes them.
  static constexpr std::string_view kBotRows = "vf";

  bool next_line() { return lines_.next(); }
  bool next_row(std::string_view letters) { return lines_.next_row(letters); }
  std::string_view line() const { return lines_.line(); }
  std::string where() const { return lines_.where(); }
  void fail(std::string why) { report_.error(where(), std::move(why)); }

  void record() {
    if (!lines_.begins_record()) return unknown();
    switch (line().front()) {
      case 'I':
        if (next_line()) database_.title = line();
        return;
      case 'S': return solid();
      case 'C': return comb();
      case 'A': return ars();
      case 'm': return color();
      case 'p': return particle();
      case 'w': return pipe();
      case 'n': return arbn();
      case 't': return bot();
      case 'M':
        return report_.warning_once("M", where(), "a member without its combination is left out");
      default: return foreign();
    }
  }

  void unknown() { report_.warning_once("?", where(), "a record of unknown kind is left out"); }

  /// Keeps a solid of a kind that isn't read under its name, in case that is used.
  void foreign() {
    const auto words = blank_separated(line(), 3);
    if (words.size() < 2) return unknown();
    if (line().front() == 's' && words.size() > 2)
      return add(words[2], BrlcadForeign{std::string(words[1])});
    add(words[1], BrlcadForeign{"a record '" + std::string(words.front()) + "'"});
  }

  void add(std::string_view name, BrlcadValue value) {
    database_.add({std::string(name), where(), std::move(value)});
  }
  /// Keeps the object under way as one that can't be read; the line that was reached shows why.
  void broken(std::string_view name, const std::string& why) {
    if (!name.empty()) return add(name, BrlcadBroken{why});
    report_.warning_once("nameless", where(), "a record without a name is left out: " + why);
  }
  static std::string_view word_or_nothing(const std::vector<std::string_view>& words,
                                          std::size_t i) {
    return i < words.size() ? words[i] : std::string_view();
  }
  /// The same for a record that goes on in rows, which are skipped.
  void broken_rows(std::string_view name, const std::string& why, std::string_view letters) {
    broken(name, why);
    while (next_row(letters) && !line().starts_with(kEndPipe)) continue;
  }

  /// The words from `from` on as numbers; false when there are fewer than `count`.
  static bool numbers(const std::vector<std::string_view>& words, std::size_t from,
                      std::size_t count, Values& out) {
    for (std::size_t i = from; i < from + count; ++i) {
      const auto v = i < words.size() ? parse_brlcad_number(words[i]) : std::nullopt;
      if (!v) return false;
      out.push_back(*v);
    }
    return true;
  }

  /// Reads S TYPE NAME CLASS and 24 numbers.
  void solid() {
    const auto words = blank_separated(line(), 28);
    Values v;
    const auto type = words.size() > 3 ? parse_brlcad_integer(words[1]) : std::nullopt;
    if (!type || !numbers(words, 4, 24, v))
      return broken(word_or_nothing(words, 2),
                    "a solid's record wants a type, a name, a class and 24 numbers");
    BrlcadSolid out;
    switch (*type) {
      case kTorus: {
        // The numbers: V, the tube's radius along the axis, a vector as long as the ring's radius.
        out.kind = BrlcadKind::kTor;
        const double tube = length_at(v, 3), ring = length_at(v, 6);
        v[6] = ring;
        v[7] = tube;
        make_unit(v, 3);
        break;
      }
      case kGeneralCone: out.kind = BrlcadKind::kTgc; break;
      case kEllipsoid: out.kind = BrlcadKind::kEll; break;
      case kArb:
        out.kind = BrlcadKind::kArb8;
        for (std::size_t i = 3; i < 24; ++i) v[i] += v[i % 3];
        break;
      case kHalfSpace: out.kind = BrlcadKind::kHalf; break;
      case kRpcType: out.kind = BrlcadKind::kRpc; break;
      case kRhcType: out.kind = BrlcadKind::kRhc; break;
      case kEpaType: out.kind = BrlcadKind::kEpa; break;
      case kEhyType: out.kind = BrlcadKind::kEhy; break;
      case kEtoType: out.kind = BrlcadKind::kEto; break;
      case kHypType: out.kind = BrlcadKind::kHyp; break;
      default: return add(words[2], BrlcadForeign{"a solid of type " + std::string(words[1])});
    }
    if (out.kind == BrlcadKind::kEpa || out.kind == BrlcadKind::kEhy) make_unit(v, 6);
    v.resize(brlcad_value_count(out.kind));
    out.values = std::move(v);
    add(words[2], std::move(out));
  }

  /// Reads C FLAG NAME region air members reference material los override r g b [shader?
  /// parameters? inherit], then lines for shader and parameters, then its members.
  void comb() {
    const auto words = blank_separated(line(), 17);
    if (words.size() < 13)
      return broken_rows(word_or_nothing(words, 2), "a combination's record is too short", "M");
    const std::string name(words[2]);
    const auto integer = [&](std::size_t i) {
      return i < words.size() ? parse_brlcad_integer(words[i]).value_or(0) : 0;
    };
    BrlcadComb out;
    out.is_region = words[1] == "Y" || words[1] == "R" || words[1] == "P" || words[1] == "V";
    out.region_id = integer(3);
    out.air = integer(4);
    if (integer(9) != 0) {
      out.rgb = parse_brlcad_rgb(std::string(words[10]) + " " + std::string(words[11]) + " " +
                                 std::string(words[12]));
    }
    const bool has_shader = integer(13) != 0;
    const bool has_parameters = integer(14) != 0;
    out.inherits = integer(15) != 0;
    const std::string at = where();
    if (has_shader && next_line()) out.shader = line();
    if (has_parameters && next_line()) out.shader += " " + std::string(line());
    if (members(name, out)) database_.add({name, at, std::move(out)});
  }

  /// Reads members with u, + and − as they bind: products of intersections and subtractions, then
  /// their union.
  bool members(const std::string& name, BrlcadComb& out) {
    using Op = BrlcadTree::Op;
    BrlcadTreeBuilder builder;
    std::size_t products = 0;
    while (next_row("M") && lines_.begins_record()) {
      const auto words = blank_separated(line(), 20);
      if (words.size() < 3 || words[1].size() != 1) {
        broken_rows(name, "a member wants an operation, a name and a matrix", "M");
        return false;
      }
      const char relation = products == 0 ? 'u' : words[1].front();
      if (relation == 'u' && products > 1 && !builder.operation(Op::kUnion)) return too_deep(name);
      if (relation == 'u') ++products;
      builder.leaf(std::string(words[2]), place_of(words));
      if (relation != 'u' &&
          !builder.operation(relation == '+' ? Op::kIntersection : Op::kDifference)) {
        return too_deep(name);
      }
      if (builder.leaves() > kMaxBrlcadMembers) return too_deep(name);
    }
    if (products > 1 && !builder.operation(Op::kUnion)) return too_deep(name);
    out.tree = builder.finish();
    return true;
  }
  /// Where a member is: its matrix stands behind the first three words, if it has one.
  static BrlcadPlace place_of(const std::vector<std::string_view>& words) {
    std::array<double, 16> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    if (words.size() > 3) {
      Values v;
      if (!numbers(words, 3, 16, v)) return {std::nullopt, true};
      std::copy(v.begin(), v.end(), m.begin());
    }
    return brlcad_place(m);
  }
  bool too_deep(const std::string& name) {
    broken_rows(name, "its members make a tree that is too deep, or too many", "M");
    return false;
  }

  /// Reads A NAME … curves points, then B records of up to 8 points each.
  void ars() {
    const auto words = blank_separated(line(), 5);
    const auto curves =
        words.size() > 3 ? parse_brlcad_integer(words[words.size() - 2]) : std::nullopt;
    const auto per_curve = words.size() > 3 ? parse_brlcad_integer(words.back()) : std::nullopt;
    if (!curves || !per_curve || *curves < 2 || *per_curve < 3 ||
        static_cast<double>(*curves) * static_cast<double>(*per_curve) >
            static_cast<double>(kMaxBrlcadVertices)) {
      return broken_rows(
          word_or_nothing(words, 1),
          "an ars wants a name, the number of its curves (2 or more) and of their points (3 or "
          "more)",
          "B");
    }
    const std::string name(words[words.size() - 3]);
    const std::string at = where();
    std::vector<Vec3> points;
    for (long curve = 0; curve < *curves; ++curve) {
      for (long done = 0; done < *per_curve; done += 8) {
        if (!next_row("B") || line().empty() || line().front() != 'B')
          return broken_rows(name, "a B record is missing", "B");
        const long count = std::min(8l, *per_curve - done);
        Values v;
        // B, the curve's and the granule's number, then points; all but the first relative to it.
        if (!numbers(blank_separated(line(), 27), 3, static_cast<std::size_t>(3 * count), v))
          return broken_rows(name, "a B record wants 3 words and points of 3 numbers", "B");
        for (std::size_t i = 0; i + 2 < v.size(); i += 3) {
          const Vec3 p{v[i], v[i + 1], v[i + 2]};
          points.push_back(points.empty() ? p : points.front() + p);
        }
      }
    }
    BrlcadSolid out{BrlcadKind::kArs, {}, {}};
    out.mesh = brlcad_ars_mesh(points, static_cast<std::size_t>(*curves),
                               static_cast<std::size_t>(*per_curve));
    database_.add({name, at, std::move(out)});
  }

  /// Reads m FLAGS LOW HIGH R G B.
  void color() {
    const auto words = blank_separated(line(), 7);
    if (words.size() < 7)
      return report_.warning_once("colour", where(), "a colour without its 6 numbers is left out");
    const auto low = parse_brlcad_integer(words[2]);
    const auto high = parse_brlcad_integer(words[3]);
    const auto rgb = parse_brlcad_rgb(std::string(words[4]) + " " + std::string(words[5]) + " " +
                                      std::string(words[6]));
    if (low && high && rgb) database_.colors.push_back({*low, *high, *rgb});
  }

  void particle() {
    const auto words = blank_separated(line(), 10);
    BrlcadSolid out{BrlcadKind::kPart, {}, {}};
    if (!numbers(words, 2, 8, out.values))
      return broken(word_or_nothing(words, 1), "a particle wants a name and 8 numbers");
    add(words[1], std::move(out));
  }

  void pipe() {
    const auto words = blank_separated(line(), 2);
    if (words.size() < 2) return broken_rows("", "a pipe wants a name", "");
    const std::string name(words[1]), at = where();
    BrlcadSolid out{BrlcadKind::kPipe, {}, {}};
    for (;;) {
      if (!next_row("")) return broken(name, "it has no END_PIPE");
      if (line().starts_with(kEndPipe)) break;
      Values v;
      // The numbers: inner and outer diameter, bend radius, position.
      if (!numbers(blank_separated(line(), 6), 0, 6, v))
        return broken_rows(name, "a point of a pipe wants 6 numbers", "");
      for (const std::size_t i : {3u, 4u, 5u, 0u, 1u, 2u}) out.values.push_back(v[i]);
      if (out.values.size() > kMaxBrlcadNumbers) return broken_rows(name, "it is too long", "");
    }
    database_.add({name, at, std::move(out)});
  }

  void arbn() {
    const auto words = blank_separated(line(), 3);
    const auto count = words.size() > 2 ? parse_brlcad_integer(words[2]) : std::nullopt;
    if (!count || *count < 1 || *count > static_cast<long>(kMaxBrlcadNumbers / 4)) {
      return broken_rows(word_or_nothing(words, 1),
                         "an arbn wants a name and the number of its planes", "N");
    }
    const std::string name(words[1]), at = where();
    BrlcadSolid out{BrlcadKind::kArbn, {}, {}};
    for (long i = 0; i < *count; ++i) {
      if (!next_row("N") || !numbers(blank_separated(line(), 5), 1, 4, out.values))
        return broken_rows(name, "a plane wants 4 numbers behind its first word", "N");
    }
    database_.add({name, at, std::move(out)});
  }

  /// Reads t NAME mode orientation error vertices faces, lines of "N: x y z", and of "N: a b c".
  void bot() {
    const auto words = blank_separated(line(), 7);
    const auto integer = [&](std::size_t i) {
      return i < words.size() ? parse_brlcad_integer(words[i]).value_or(-1) : -1;
    };
    const long vertices = integer(5), faces = integer(6);
    if (vertices < 0 || faces < 0 || vertices > static_cast<long>(kMaxBrlcadVertices) ||
        faces > static_cast<long>(kMaxBrlcadVertices)) {
      return broken_rows(
          word_or_nothing(words, 1),
          "a bot wants name, mode, orientation, error mode, number of vertices and of faces",
          kBotRows);
    }
    const std::string name(words[1]), at = where();
    const long mode = integer(2);
    BrlcadSolid out{BrlcadKind::kBot, {}, {}};
    for (long i = 0; i < vertices + faces; ++i) {
      Values v;
      if (!next_row(kBotRows) || !numbers(blank_separated(line(), 4), 1, 3, v))
        return broken_rows(name, "a row wants 3 numbers behind its first word", kBotRows);
      if (i < vertices) {
        out.mesh.vertices.push_back({v[0], v[1], v[2]});
        continue;
      }
      std::array<std::uint32_t, 3> face{};
      for (std::size_t k = 0; k < 3; ++k) {
        if (!(v[k] >= 0 && v[k] < static_cast<double>(vertices)))
          return broken_rows(name, "a face names a vertex that isn't there", kBotRows);
        face[k] = static_cast<std::uint32_t>(v[k]);
      }
      out.mesh.faces.push_back(face);
    }
    constexpr long kSolidMode = 2, kPlateMode = 3;
    if (mode == kPlateMode) next_line();
    if (mode != kSolidMode) {
      database_.add(
          {name, at,
           BrlcadForeign{"bot in " + std::string(mode == 1 ? "surface" : "plate") + " mode"}});
      return;
    }
    database_.add({name, at, std::move(out)});
  }

  BrlcadV4Lines lines_;
  BrlcadReport& report_;
  BrlcadDatabase database_;
};

}  // namespace

BrlcadDatabase read_brlcad_v4_text(std::string_view text, BrlcadReport& report) {
  return V4TextReader(text, report).read();
}

}  // namespace graycube
