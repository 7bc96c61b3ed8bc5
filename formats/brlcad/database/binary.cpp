// BRL-CAD's binary database of version 5: a row of objects, each framed by two magic bytes, with
// lengths of 1, 2, 4 or 8 bytes and everything big-endian.
#include <zlib.h>

#include <cmath>
#include <cstring>

#include "formats/brlcad/database/byte_reader.hpp"
#include "formats/brlcad/database/database.hpp"
#include "formats/brlcad/database/tree_binary.hpp"

namespace graycube {
namespace {

constexpr unsigned kMagicStart = 0x76, kMagicEnd = 0x35;
/// Most bytes of a body after decompression.
constexpr std::size_t kMaxBody = std::size_t{1} << 30;
/// The most that a compressed body may grow: the factor that deflate can reach, rounded up.
constexpr std::size_t kMaxExpansion = 1100;

/// A length-prefixed part of an object: attributes or body.
struct Part {
  std::string_view bytes;
  std::string inflated;
  bool is_present = false;
  bool is_good = true;
};

/// Unpacks zlib's or gzip's format, whichever it is.
bool inflate_into(std::string_view packed, std::string& out) {
  z_stream stream{};
  constexpr int kDetectHeader = 15 + 32;
  if (packed.size() > kMaxBody || inflateInit2(&stream, kDetectHeader) != Z_OK) return false;
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  const std::size_t most = std::min(kMaxBody, packed.size() * kMaxExpansion + 64);
  int state = Z_OK;
  std::array<char, 16384> chunk;
  while (state == Z_OK && out.size() <= most) {
    stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream.avail_out = static_cast<uInt>(chunk.size());
    state = inflate(&stream, Z_NO_FLUSH);
    out.append(chunk.data(), chunk.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  return state == Z_STREAM_END && out.size() <= most;
}

Part read_part(BrlcadByteReader& r, unsigned flags) {
  Part part;
  part.is_present = (flags & 0x20u) != 0;
  if (!part.is_present) return part;
  part.bytes = r.take(r.integer(width_of(flags >> 6)));
  const unsigned compression = flags & 7u;
  if (compression == 1) {
    part.is_good = inflate_into(part.bytes, part.inflated);
    part.bytes = part.inflated;
  } else if (compression != 0) {
    part.is_good = false;
  }
  return part;
}

class BinaryReader {
 public:
  BinaryReader(std::string_view bytes, BrlcadReport& report) : bytes_(bytes), report_(report) {}

  BrlcadDatabase read() {
    while (at_ < bytes_.size() && !report_.has_errors()) {
      object();
      if (database_.objects.size() > kMaxBrlcadObjects) {
        fail("more than " + std::to_string(kMaxBrlcadObjects) + " objects");
      }
    }
    return std::move(database_);
  }

 private:
  std::string where() const { return "byte " + std::to_string(at_); }
  void fail(std::string why) { report_.error(where(), std::move(why)); }

  void object() {
    BrlcadByteReader r(bytes_.substr(at_));
    const auto magic = static_cast<unsigned>(r.integer(1));
    const auto header = static_cast<unsigned>(r.integer(1));
    const auto attribute_flags = static_cast<unsigned>(r.integer(1));
    const auto body_flags = static_cast<unsigned>(r.integer(1));
    const auto major = static_cast<unsigned>(r.integer(1));
    const auto minor = static_cast<unsigned>(r.integer(1));
    const std::uint64_t length = r.integer(width_of(header >> 6)) * 8;
    if (!r.ok() || magic != kMagicStart || length < 8 || length > bytes_.size() - at_ ||
        static_cast<unsigned char>(bytes_[at_ + static_cast<std::size_t>(length) - 1]) !=
            kMagicEnd) {
      return fail("no object of a version 5 database begins here");
    }
    BrlcadByteReader inside(bytes_.substr(at_, static_cast<std::size_t>(length) - 1));
    inside.take(6 + width_of(header >> 6));
    constexpr unsigned kApplicationData = 0;
    if ((header & 3u) == kApplicationData)
      content(inside, header, attribute_flags, body_flags, major, minor);
    at_ += static_cast<std::size_t>(length);
  }

  void content(BrlcadByteReader& r, unsigned header, unsigned attribute_flags, unsigned body_flags,
               unsigned major, unsigned minor) {
    std::string name;
    if ((header & 0x20u) != 0) name = r.take(r.integer(width_of(header >> 3)));
    name = name.substr(0, name.find('\0'));
    const Part attributes = read_part(r, attribute_flags);
    const Part body = read_part(r, body_flags);
    constexpr const char* kTooShort = "an object's parts are longer than it is";
    if (!r.ok() && name.empty())
      return report_.warning_once("parts", where(), std::string(kTooShort) + ": left out");
    if (!r.ok()) return database_.add({name, where(), BrlcadBroken{kTooShort}});
    constexpr unsigned kBrlcad = 1, kAttributesOnly = 2;
    if (major == kAttributesOnly && name == "_GLOBAL") {
      each_attribute(attributes.bytes, [&](std::string_view key, std::string_view value) {
        set_brlcad_global(database_, key, value);
      });
    }
    if (major != kBrlcad || name.empty()) return;
    constexpr unsigned kCombination = 31;
    BrlcadObject object{name, where(), BrlcadForeign{}};
    if (!attributes.is_good || !body.is_good) {
      object.value = BrlcadBroken{"compressed in a way that can't be undone"};
    } else if (minor == kCombination) {
      object.value = comb(body.bytes, attributes.bytes);
    } else {
      object.value = solid(body.bytes, minor);
    }
    database_.add(std::move(object));
  }

  static BrlcadValue comb(std::string_view body, std::string_view attributes) {
    BrlcadComb comb;
    BrlcadByteReader r(body);
    if (auto why = read_binary_tree(r, comb)) return BrlcadBroken{std::move(*why)};
    each_attribute(attributes, [&](std::string_view key, std::string_view value) {
      set_brlcad_attribute(comb, key, value);
    });
    return comb;
  }

  template <typename Visit>
  static void each_attribute(std::string_view bytes, Visit&& visit) {
    BrlcadByteReader r(bytes);
    while (r.remaining() > 0) {
      const std::string_view key = r.text();
      if (!r.ok() || key.empty()) break;
      const std::string_view value = r.text();
      if (!r.ok()) break;
      visit(key, value);
    }
  }

  static std::optional<BrlcadKind> kind_of(unsigned minor) {
    switch (minor) {
      case 1: return BrlcadKind::kTor;
      case 2:
      case 7: return BrlcadKind::kTgc;
      case 3:
      case 10: return BrlcadKind::kEll;
      case 4: return BrlcadKind::kArb8;
      case 5: return BrlcadKind::kArs;
      case 6: return BrlcadKind::kHalf;
      case 14: return BrlcadKind::kArbn;
      case 15: return BrlcadKind::kPipe;
      case 16: return BrlcadKind::kPart;
      case 17: return BrlcadKind::kRpc;
      case 18: return BrlcadKind::kRhc;
      case 19: return BrlcadKind::kEpa;
      case 20: return BrlcadKind::kEhy;
      case 21: return BrlcadKind::kEto;
      case 30: return BrlcadKind::kBot;
      case 35: return BrlcadKind::kSuperell;
      case 38: return BrlcadKind::kHyp;
      default: return std::nullopt;
    }
  }

  static std::string foreign_name(unsigned minor) {
    constexpr const char* kNames[] = {
        "",         "tor",      "tgc",     "ell",  "arb8",     "ars",    "half",
        "rec",      "poly",     "bspline", "sph",  "nmg",      "ebm",    "vol",
        "arbn",     "pipe",     "part",    "rpc",  "rhc",      "epa",    "ehy",
        "eto",      "grip",     "joint",   "hf",   "dsp",      "sketch", "extrude",
        "submodel", "cline",    "bot",     "comb", "unused",   "datum",  "unused",
        "superell", "metaball", "brep",    "hyp",  "constrnt", "revolve"};
    if (minor < std::size(kNames)) return kNames[minor];
    return "kind " + std::to_string(minor);
  }

  static BrlcadValue solid(std::string_view body, unsigned minor) {
    const auto kind = kind_of(minor);
    if (!kind) return BrlcadForeign{foreign_name(minor)};
    BrlcadByteReader r(body);
    switch (*kind) {
      case BrlcadKind::kArbn: return counted(*kind, r, 4);
      case BrlcadKind::kPipe: return counted(*kind, r, 6);
      case BrlcadKind::kArs: return ars(r);
      case BrlcadKind::kBot: return bot(r);
      default: return numbers(*kind, r, brlcad_value_count(*kind));
    }
  }

  static BrlcadValue numbers(BrlcadKind kind, BrlcadByteReader& r, std::size_t count) {
    BrlcadSolid out;
    out.kind = kind;
    bool is_finite = count <= r.remaining() / 8;
    for (std::size_t i = 0; i < count && is_finite; ++i) {
      out.values.push_back(r.number());
      is_finite = std::isfinite(out.values.back());
    }
    if (is_finite) return out;
    return BrlcadBroken{"expected " + std::to_string(count) + " numbers"};
  }

  static BrlcadValue counted(BrlcadKind kind, BrlcadByteReader& r, std::size_t each) {
    const std::uint64_t count = r.integer(4);
    if (count > kMaxBrlcadNumbers / each) return BrlcadBroken{"too many numbers"};
    return numbers(kind, r, static_cast<std::size_t>(count) * each);
  }

  /// Reads points; what is wrong with them, or nothing.
  static std::optional<std::string> points(BrlcadByteReader& r, std::uint64_t count,
                                           std::vector<Vec3>& out) {
    if (count > kMaxBrlcadVertices || count > r.remaining() / 24)
      return "more points than it has room for";
    for (std::uint64_t i = 0; i < count; ++i) {
      out.push_back(r.vector());
      if (!is_finite(out.back())) return "a point that is none";
    }
    return std::nullopt;
  }

  static BrlcadValue ars(BrlcadByteReader& r) {
    const std::uint64_t curves = r.integer(4), per_curve = r.integer(4);
    if (curves < 2 || per_curve < 3 || per_curve > kMaxBrlcadVertices)
      return BrlcadBroken{"expected two curves or more of three points or more"};
    std::vector<Vec3> all;
    if (auto why = points(r, curves * per_curve, all)) return BrlcadBroken{std::move(*why)};
    BrlcadSolid out{BrlcadKind::kArs, {}, {}};
    out.mesh =
        brlcad_ars_mesh(all, static_cast<std::size_t>(curves), static_cast<std::size_t>(per_curve));
    return out;
  }

  static BrlcadValue bot(BrlcadByteReader& r) {
    const std::uint64_t vertices = r.integer(4), faces = r.integer(4);
    r.integer(1);
    const std::uint64_t mode = r.integer(1);
    r.integer(1);
    constexpr std::uint64_t kSolidMode = 2;
    if (r.ok() && mode != kSolidMode)
      return BrlcadForeign{std::string("bot in ") + (mode == 1 ? "surface" : "plate") + " mode"};
    BrlcadSolid out{BrlcadKind::kBot, {}, {}};
    if (auto why = points(r, vertices, out.mesh.vertices)) return BrlcadBroken{std::move(*why)};
    if (faces > kMaxBrlcadVertices || faces > r.remaining() / 12)
      return BrlcadBroken{"more faces than it has room for"};
    for (std::uint64_t i = 0; i < faces; ++i) {
      std::array<std::uint32_t, 3> face;
      for (auto& corner : face) {
        corner = static_cast<std::uint32_t>(r.integer(4));
        if (corner >= vertices) return BrlcadBroken{"a face names a vertex that isn't there"};
      }
      out.mesh.faces.push_back(face);
    }
    return out;
  }

  std::string_view bytes_;
  BrlcadReport& report_;
  std::size_t at_ = 0;
  BrlcadDatabase database_;
};

}  // namespace

BrlcadDatabase read_brlcad_binary(std::string_view bytes, BrlcadReport& report) {
  return BinaryReader(bytes, report).read();
}

}  // namespace graycube
