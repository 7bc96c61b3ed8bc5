// BRL-CAD's binary database of version 4: records of 128 bytes, in the byte order of the machine
// that wrote them. They hold what the text of version 4 holds, so they are rewritten as such text.
// The layout of the records is that of BRL-CAD's rt/db4.h.
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "formats/brlcad/database/byte_reader.hpp"
#include "formats/brlcad/database/database.hpp"

namespace graycube {
namespace {

constexpr std::size_t kRecord = 128;

/// The places of fields in their records; those of a name and of the first field behind it are the
/// same in most.
constexpr std::size_t kName = 2, kNameBytes = 16, kAfterName = 18;
constexpr std::size_t kSolidValues = 20;
constexpr std::size_t kCombOverride = 30, kCombShader = 34, kCombParameters = 66,
                      kCombInherit = 126;
constexpr std::size_t kMemberName = 18, kMemberMatrix = 36;
constexpr std::size_t kArsPoints = 8;
constexpr std::size_t kBotMode = 23, kBotCounts = 25, kBotData = 33;

class V4BinaryReader {
 public:
  V4BinaryReader(std::string_view bytes, BrlcadReport& report)
      : bytes_(bytes), report_(report), is_swapped_(looks_swapped(bytes)) {}

  /// The database as text; what is no record is reported.
  std::string read() {
    if (bytes_.size() < kRecord) {
      fail("a database of version 4 whose first record is cut short");
      return {};
    }
    while (at_ + kRecord <= bytes_.size() && !report_.has_errors()) {
      record_ = bytes_.substr(at_, kRecord);
      at_ += kRecord;
      record();
    }
    if (at_ < bytes_.size() && !report_.has_errors())
      report_.warning("byte " + std::to_string(at_), "the last record is cut short, and left out");
    return std::move(text_);
  }

 private:
  void fail(const std::string& why) { report_.error("byte " + std::to_string(at_), why); }

  /// Whether the numbers make more sense when their bytes are reversed: those of solids, of
  /// members and of points are looked at.
  static bool looks_swapped(std::string_view bytes) {
    std::size_t fair = 0, fair_swapped = 0;
    const auto is_fair = [](float v) {
      return v == 0 || (std::fabs(v) >= 1e-12f && std::fabs(v) <= 1e12f);
    };
    for (std::size_t at = 0; at + kRecord <= bytes.size(); at += kRecord) {
      const char id = bytes[at];
      if (id != 'S' && id != 'M' && id != 'B') continue;
      const std::size_t first = id == 'S' ? kSolidValues : id == 'M' ? kMemberMatrix : kArsPoints;
      for (std::size_t i = 0; i < 16; ++i) {
        const std::string_view field = bytes.substr(at + first + 4 * i, 4);
        fair += is_fair(single(field, false));
        fair_swapped += is_fair(single(field, true));
      }
    }
    return fair_swapped > fair;
  }

  /// A number of single precision, little-endian unless it `is_swapped`.
  static float single(std::string_view field, bool is_swapped) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto byte = static_cast<unsigned char>(field[is_swapped ? i : 3 - i]);
      bits = bits << 8 | byte;
    }
    return std::bit_cast<float>(bits);
  }
  long short_at(std::size_t at) const {
    const auto low = static_cast<unsigned char>(record_[at + (is_swapped_ ? 1 : 0)]);
    const auto high = static_cast<unsigned char>(record_[at + (is_swapped_ ? 0 : 1)]);
    return static_cast<std::int16_t>(high << 8 | low);
  }
  /// A number that is big-endian on every machine.
  std::uint64_t big_at(std::size_t at, unsigned width) const {
    return BrlcadByteReader(record_.substr(at, width)).integer(width);
  }

  /// Text up to a zero byte; line ends and blanks in names would cut the text up.
  std::string words_at(std::size_t at, std::size_t most) const {
    std::string words(record_.substr(at, most));
    words.resize(std::min(words.find('\0'), words.size()));
    for (char& c : words) c = c == '\n' || c == '\r' ? ' ' : c;
    return words;
  }
  std::string name_at(std::size_t at) const {
    std::string name = words_at(at, kNameBytes);
    for (char& c : name) c = c == ' ' || c == '\t' ? '_' : c;
    return name.empty() ? "_" : name;
  }

  void put(std::string_view word) {
    text_ += word;
    text_ += ' ';
  }
  void put(long v) { put(std::string_view(std::to_string(v))); }
  void put(double v) {
    char digits[32];
    put(std::string_view(digits, std::to_chars(digits, digits + sizeof digits, v).ptr));
  }
  void put_singles(std::size_t at, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      put(double{single(record_.substr(at + 4 * i, 4), is_swapped_)});
  }
  void end_line() { text_ += '\n'; }

  void record() {
    switch (record_[0]) {
      case 'I': return ident();
      case 'S': return solid();
      case 'C': return comb();
      case 'M': return member();
      case 'A': return ars();
      case 'B': return ars_points();
      case 'm': return color();
      case 'n': return arbn();
      case 'w': return pipe();
      case 'p': return particle();
      case 't': return bot();
      case 'F':
      case '\0': return;
      default: return foreign();
    }
  }

  void ident() {
    text_ += "I 0 v4\n" + words_at(8, 72);
    end_line();
  }
  void solid() {
    put("S");
    put(long{static_cast<unsigned char>(record_[1])});
    put(name_at(kName));
    put(short_at(kAfterName));
    put_singles(kSolidValues, 24);
    end_line();
  }
  void comb() {
    const std::string shader = words_at(kCombShader, kCombParameters - kCombShader);
    const std::string parameters = words_at(kCombParameters, kCombInherit - kCombParameters);
    const char flag = record_[1];
    put("C");
    put(flag == 'R' || flag == 'P' || flag == 'V' ? "Y" : "N");
    put(name_at(kName));
    // Region, air, two numbers without a meaning, material, line of sight.
    for (const std::size_t at : {18u, 20u, 22u, 24u, 26u, 28u}) put(short_at(at));
    for (std::size_t i = 0; i < 4; ++i)
      put(long{static_cast<unsigned char>(record_[kCombOverride + i])});
    put(long{!shader.empty()});
    put(long{!parameters.empty()});
    put(long{record_[kCombInherit] != 0});
    end_line();
    if (!shader.empty()) text_ += shader + "\n";
    if (!parameters.empty()) text_ += parameters + "\n";
  }
  void member() {
    put("M");
    put(record_.substr(1, 1));
    put(name_at(kMemberName));
    put_singles(kMemberMatrix, 16);
    put(0l);
    end_line();
  }
  void ars() {
    put("A");
    put(name_at(kName));
    put(short_at(18));
    put(short_at(20));
    end_line();
  }
  void ars_points() {
    put("B");
    put(short_at(2));
    put(short_at(4));
    put_singles(kArsPoints, 24);
    end_line();
  }
  void color() {
    put("m");
    put("0");
    put(short_at(2));
    put(short_at(4));
    for (const std::size_t at : {6u, 7u, 8u}) put(long{static_cast<unsigned char>(record_[at])});
    end_line();
  }

  /// Goes on with `count` more records; false where the file has fewer, and then takes all of them.
  bool take_more(std::uint64_t count) {
    const std::uint64_t most = (bytes_.size() - at_) / kRecord;
    at_ += static_cast<std::size_t>(std::min(count, most)) * kRecord;
    return count <= most;
  }
  /// The record from `from` on and `count` more behind it; nothing where the file has fewer.
  BrlcadByteReader with_more(std::size_t from, std::uint64_t count) {
    const std::size_t start = at_ - kRecord + from;
    if (!take_more(count)) return BrlcadByteReader({});
    return BrlcadByteReader(bytes_.substr(start, at_ - start));
  }
  /// Whether the reader has bytes for so many numbers. If not, a record without any is written,
  /// which the text's reader takes for a broken one.
  bool has_room(const BrlcadByteReader& r, std::uint64_t count, std::size_t each,
                const std::string& name) {
    if (count <= r.remaining() / each) return true;
    put(name);
    end_line();
    return false;
  }

  void arbn() {
    const std::uint64_t planes = big_at(18, 4);
    const std::string name = name_at(kName);
    BrlcadByteReader r = with_more(kRecord, big_at(22, 4));
    put("n");
    if (!has_room(r, planes, 32, name)) return;
    put(name);
    put(static_cast<long>(planes));
    end_line();
    for (std::uint64_t i = 0; i < planes; ++i) {
      put("N");
      for (int k = 0; k < 4; ++k) put(r.number());
      end_line();
    }
  }
  void pipe() {
    const std::uint64_t points = big_at(18, 4);
    const std::string name = name_at(kName);
    BrlcadByteReader r = with_more(26, big_at(22, 4));
    put("w");
    if (!has_room(r, points, 48, name)) return;
    put(name);
    end_line();
    for (std::uint64_t i = 0; i < points; ++i) {
      const Vec3 at = r.vector();
      const double bend = r.number(), inner = r.number(), outer = r.number();
      for (const double v : {inner, outer, bend, at.x, at.y, at.z}) put(v);
      end_line();
    }
    text_ += "END_PIPE\n";
  }
  void particle() {
    BrlcadByteReader r(record_.substr(kAfterName));
    put("p");
    put(name_at(kName));
    for (int k = 0; k < 8; ++k) put(r.number());
    end_line();
  }
  void bot() {
    const std::uint64_t vertices = big_at(kBotCounts, 4), faces = big_at(kBotCounts + 4, 4);
    const long mode = static_cast<unsigned char>(record_[kBotMode]);
    const std::string name = name_at(kName);
    BrlcadByteReader r = with_more(kBotData, big_at(18, 4));
    // A bot that is no solid is known by its mode; its faces don't matter.
    constexpr long kSolidMode = 2;
    const bool is_solid = mode == kSolidMode;
    put("t");
    if (!has_room(r, vertices, 24, name) || !has_room(r, faces, 12, name)) return;
    put(name);
    put(is_solid || mode == 1 ? mode : 0l);
    put("0 0");
    put(is_solid ? static_cast<long>(vertices) : 0l);
    put(is_solid ? static_cast<long>(faces) : 0l);
    end_line();
    if (!is_solid) return;
    for (std::uint64_t i = 0; i < vertices; ++i) {
      put("v");
      for (int k = 0; k < 3; ++k) put(r.number());
      end_line();
    }
    for (std::uint64_t i = 0; i < faces; ++i) {
      put("f");
      for (int k = 0; k < 3; ++k) put(static_cast<long>(r.integer(4)));
      end_line();
    }
  }

  /// Keeps solids of other kinds by name, and skips the records that belong to them.
  void foreign() {
    const std::string name = name_at(kName);
    const char id = record_[0];
    std::uint64_t more = 0;
    if (id == 's') more = 7;
    if (id == 'N') more = big_at(20, 4);
    if (id == 'd') more = big_at(98, 4);
    if (id == 'e') more = big_at(118, 4);
    // A spline's surface, followed by its knots and its net; a polygon's data.
    if (id == 'D') more = static_cast<std::uint64_t>(std::max(0l, short_at(16) + short_at(18)));
    if (id == 's') {
      const std::string keyword = words_at(kAfterName, kNameBytes);
      text_ += "s " + (keyword.empty() ? "solid" : keyword) + " " + name + "\n";
    } else if (std::string_view("bPNdec").find(id) != std::string_view::npos) {
      text_ += std::string(1, id) + " " + name + "\n";
    } else if (id != 'D' && id != 'Q') {
      return report_.warning_once("record", "byte " + std::to_string(at_ - kRecord),
                                  "a record of unknown kind is left out");
    }
    take_more(more);
  }

  std::string_view bytes_;
  BrlcadReport& report_;
  bool is_swapped_;
  std::size_t at_ = 0;
  std::string_view record_;
  std::string text_;
};

}  // namespace

BrlcadDatabase read_brlcad_v4_binary(std::string_view bytes, BrlcadReport& report) {
  const std::string text = V4BinaryReader(bytes, report).read();
  return report.has_errors() ? BrlcadDatabase{} : read_brlcad_v4_text(text, report);
}

}  // namespace graycube
