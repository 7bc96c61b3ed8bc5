// Pairs of scenes that hold the same solids: one with faces that touch, flush cuts, plugs, nested shells, each part
// told in numbers and brought there by maps of its own; the other without any surface that coincides with another.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "coincidence/columns.hpp"
#include "coincidence/retold.hpp"

namespace graycube::testing {

enum class PairKind : std::uint8_t {
  kThroughHoles,     ///< cuts as long as their plate
  kPocketToTop,      ///< a cut from the inside up to the top
  kNotch,            ///< a box cut from an edge or a corner, flush with three or four faces
  kStandingBoss,     ///< a boss on its flange, against one sunk into it
  kPlug,             ///< a hole filled by its own solid
  kSunkPlug,         ///< a blind hole filled by its own solid, as a countersink by its screw
  kBoreAndBoss,      ///< a bore below a boss of the same sides
  kDrilledBoss,      ///< a boss drilled away by a bore of its sides
  kShells,           ///< balls or ellipsoids in one another, two of one size
  kTubes,            ///< columns in one another, two of one size
  kGroove,           ///< a ring's groove filled by the ring
  kSplitAndJoined,   ///< (X − Y) ∪ (X ∩ Y)
  kUnionLess,        ///< (X ∪ Y) − Y
  kFlushBox,         ///< a plate within a box as high
  kComplements,      ///< through holes, by complements and a union
  kSlices,           ///< a column in three slices
  kAssembly,         ///< several of these as objects, or as one
};
inline constexpr std::size_t kPairKinds = 17;
inline constexpr std::array<const char*, kPairKinds> kPairNames{
    "through holes", "pocket to the top", "notch",  "standing boss",    "plug",       "sunk plug",
    "bore and boss", "drilled boss",      "shells", "tubes",            "groove",     "split and joined",
    "union less",    "flush box",         "complements", "slices",      "assembly"};

/// Where surfaces touch, in coordinates of the part.
struct Site {
  Affine to_world;
  /// The part lies within this radius about the z axis, between 0 and `height`.
  double radius = 0, height = 0;
  /// Discs in which faces touch or parts lie: x, y, radius.
  std::vector<Vec3> discs;
  /// Heights of faces.
  std::vector<double> heights;

  /// The largest stretch of its world map times its radius.
  double world_size() const {
    double longest = 0;
    for (int i = 0; i < 3; ++i) {
      Vec3 e;
      e[i] = 1;
      longest = std::fmax(longest, length(to_world.vector(e)));
    }
    return longest * std::fmax(radius, height);
  }
};

struct FlushPair {
  std::uint64_t seed = 0;
  PairKind kind{};
  Scene flush, longer;
  std::vector<Site> sites;
  /// How far the maps of the parts' ways differ, in units in the last place of the largest coordinate.
  double ways_differ_ulps = 0;

  std::string text() const {
    return std::string(kPairNames[static_cast<std::size_t>(kind)]) + ", seed " + std::to_string(seed);
  }
};

struct PairOptions {
  ChainOptions::Turns turns = ChainOptions::Turns::kAny;
  /// Sizes other than 1 and places far from the origin.
  bool is_any_size = true;
  /// The longer scene's parts have ways and numbers of their own, too.
  bool tells_longer_anew = false;
  std::size_t most_moves = 5;
  /// How parts are told; by default anew, by a way of their own.
  std::function<CsgNode(const CsgNode&, const Chain&)> telling{};

  bool is_exact() const { return turns == ChainOptions::Turns::kQuarters; }
};

class PairMaker {
 public:
  /// The kind is that of the seed, modulo kPairKinds.
  explicit PairMaker(std::uint64_t seed, PairOptions options = {})
      : PairMaker(seed, static_cast<PairKind>(seed % kPairKinds), options) {}
  PairMaker(std::uint64_t seed, PairKind kind, PairOptions options = {}) : dice_(seed * 2 + 1), telling_dice_(seed * 2), options_(options) {
    pair_.seed = seed;
    pair_.kind = kind;
  }

  FlushPair make() {
    unit_ = 1;
    ChainOptions how{options_.turns, options_.most_moves, 0};
    if (options_.is_any_size && !options_.is_exact()) {
      constexpr std::array<double, 7> kUnits{1, 25.4, 1000, 1e-3, 100, 1e-6, 1e-9};
      if (dice_.one_in(2)) unit_ = kUnits[dice_.below(kUnits.size())];
      constexpr std::array<double, 4> kFar{1e3, 1e4, 1e5, 1e6};
      if (dice_.one_in(5)) how.far = kFar[dice_.below(kFar.size())];
    }
    chain_ = some_chain(dice_, unit_, how);
    std::vector<Told> objects;
    if (pair_.kind == PairKind::kAssembly) {
      objects = assembly();
    } else {
      objects.push_back(part(pair_.kind));
    }
    pair_.flush = scene_of({});
    pair_.longer = scene_of({});
    for (Told& o : objects) {
      pair_.flush.objects.push_back({"", 0, std::move(o.flush)});
      pair_.longer.objects.push_back({"", 0, std::move(o.longer)});
    }
    return std::move(pair_);
  }

 private:
  /// A solid in both scenes.
  struct Told {
    CsgNode flush, longer;
  };

  double length(double lo, double hi) {
    const double at = dice_.between(lo, hi);
    return unit_ * (options_.is_exact() ? std::ceil(at * 256) / 256 : at);
  }
  Move some_turn() {
    if (options_.is_exact()) return Move::rotate(dice_.axis(), 90);
    return Move::rotate(dice_.unit_vector(), chains::round_angle(dice_));
  }
  /// By the chain as it is.
  CsgNode plain(const CsgNode& node) {
    return options_.tells_longer_anew ? told(node) : transformed(node, map_of(chain_));
  }
  /// By another way, in other numbers.
  CsgNode told(const CsgNode& node) {
    if (options_.telling) return options_.telling(node, chain_);
    if (options_.is_exact()) return placed(node, chain_, telling_dice_);
    const Chain way = rewritten(chain_, telling_dice_, unit_, 1 + telling_dice_.below(6));
    note_difference(map_of(way));
    return told_anew(node, way, telling_dice_);
  }
  void note_difference(const Affine& other) {
    const Affine map = map_of(chain_);
    double difference = 0, reach = 0;
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner = unit_ * Aabb{{-1, -1, 0}, {1, 1, 1}}.corner(i);
      difference = std::fmax(difference, max_abs(map.point(corner) - other.point(corner)));
      reach = std::fmax(reach, max_abs(map.point(corner)));
    }
    const double ulps = difference / (std::numeric_limits<double>::epsilon() * reach);
    pair_.ways_differ_ulps = std::fmax(pair_.ways_differ_ulps, ulps);
  }

  ColumnKind some_kind(double r, const Stretch& stretch) {
    if (options_.is_exact()) return dice_.one_in(2) ? ColumnKind::kBox : ColumnKind::kCylinder;
    const auto kind = static_cast<ColumnKind>(dice_.below(kColumnKinds));
    return Column::fits(kind, r, stretch) ? kind : ColumnKind::kCylinder;
  }
  Column some_column(double x, double y, double r, const Stretch& stretch) {
    return {some_kind(r, stretch), x, y, r, stretch, dice_, options_.is_exact()};
  }
  /// Not a ring, so that there is room in it.
  Column body(const Stretch& stretch) {
    for (;;) {
      const Column c = some_column(0, 0, unit_, stretch);
      if (c.kind() != ColumnKind::kTorus) return c;
    }
  }
  Stretch some_stretch() {
    const double h = dice_.one_in(2) ? length(0.04, 0.1) : length(0.2, 0.6);
    return {0, h, 0.25 * h};
  }
  /// One to four columns within the inner disc of a body of radius 1, apart from each other.
  std::vector<Column> cutters(const Stretch& stretch) {
    std::vector<Column> found;
    if (dice_.one_in(2)) {
      found.push_back(some_column(length(-0.1, 0.1), length(-0.1, 0.1), length(0.15, 0.25), stretch));
      return found;
    }
    const std::size_t count = 2 + dice_.below(3);
    for (std::size_t i = 0; i < count; ++i) {
      const double x = (i % 2 == 0 ? 1 : -1) * length(0.3, 0.33), y = length(-0.02, 0.02);
      const double r = length(0.07, 0.11);
      found.push_back(i < 2 ? some_column(x, y, r, stretch) : some_column(y, x, r, stretch));
    }
    return found;
  }
  Site& note_site(const Stretch& stretch, std::vector<double> heights) {
    pair_.sites.push_back({map_of(chain_), 1.55 * unit_, stretch.hi, {}, std::move(heights)});
    return pair_.sites.back();
  }
  void note_columns(const std::vector<Column>& columns) {
    for (const Column& c : columns) pair_.sites.back().discs.push_back({c.x(), c.y(), c.outer()});
  }
  static CsgNode join(CsgNode a, CsgNode b) { return operation(Operation::kUnion, {std::move(a), std::move(b)}); }
  static CsgNode cut(CsgNode a, CsgNode b) { return operation(Operation::kDifference, {std::move(a), std::move(b)}); }
  static CsgNode common(CsgNode a, CsgNode b) {
    return operation(Operation::kIntersection, {std::move(a), std::move(b)});
  }

  Told part(PairKind kind) {
    switch (kind) {
      case PairKind::kThroughHoles: return holes(0, false);
      case PairKind::kComplements: return holes(0, true);
      case PairKind::kPocketToTop: return holes(0.375, false);
      case PairKind::kNotch: return notch();
      case PairKind::kStandingBoss: return standing_boss();
      case PairKind::kPlug: return plug(0);
      case PairKind::kSunkPlug: return plug(0.375);
      case PairKind::kBoreAndBoss: return bore_and_boss(false);
      case PairKind::kDrilledBoss: return bore_and_boss(true);
      case PairKind::kShells: return shells();
      case PairKind::kTubes: return tubes();
      case PairKind::kGroove: return groove();
      case PairKind::kSplitAndJoined:
      case PairKind::kUnionLess: return two_solids(kind);
      case PairKind::kFlushBox: return flush_box();
      default: return slices();
    }
  }

  /// From `floor` (of the height) to the top.
  Told holes(double floor, bool by_complements) {
    const Stretch s = some_stretch();
    const Column plate = body(s);
    const std::vector<Column> cuts = cutters(s);
    const double lo = floor * s.hi;
    const CsgNode whole = plate.between(0, s.hi);
    std::vector<CsgNode> flush{by_complements ? operation(Operation::kComplement, {told(whole)}) : told(whole)};
    std::vector<CsgNode> longer{plain(whole)};
    for (const Column& c : cuts) {
      flush.push_back(told(c.between(lo, s.hi)));
      longer.push_back(plain(c.between(floor > 0 ? lo : -s.beyond, s.hi + s.beyond)));
    }
    note_site(s, {lo, s.hi});
    note_columns(cuts);
    CsgNode result = by_complements ? operation(Operation::kComplement, {operation(Operation::kUnion, std::move(flush))})
                                    : operation(Operation::kDifference, std::move(flush));
    return {std::move(result), operation(Operation::kDifference, std::move(longer))};
  }

  Told notch() {
    const Stretch s = some_stretch();
    const double a = length(0.7, 1), b = length(0.7, 1), e = 0.25 * unit_;
    const double left = a - length(0.2, 0.5), front = -length(0.1, 0.5);
    const bool is_corner = dice_.one_in(2);
    const double back = is_corner ? b : length(0.1, 0.5);
    const CsgNode plate = node_of(BoxShape{{-a, -b, 0}, {a, b, s.hi}});
    const CsgNode flush = node_of(BoxShape{{left, front, 0}, {a, back, s.hi}});
    const CsgNode longer = node_of(BoxShape{{left, front, -s.beyond}, {a + e, is_corner ? back + e : back, s.hi + s.beyond}});
    note_site(s, {0, s.hi}).discs.push_back({0.5 * (left + a), 0.5 * (front + back), 0.4 * unit_});
    return {cut(told(plate), told(flush)), cut(plain(plate), plain(longer))};
  }

  Told standing_boss() {
    const Stretch s = some_stretch();
    const Column flange = body(s);
    const Stretch above{0.5 * s.hi, s.hi + length(0.1, 0.5), 0};
    const std::vector<Column> bosses = cutters(above);
    std::vector<CsgNode> standing{told(flange.between(0, s.hi))}, sunk{plain(flange.between(0, s.hi))};
    for (const Column& c : bosses) {
      standing.push_back(told(c.between(s.hi, above.hi)));
      sunk.push_back(plain(c.between(above.lo, above.hi)));
    }
    note_site(above, {s.hi});
    note_columns(bosses);
    return {operation(Operation::kUnion, std::move(standing)), operation(Operation::kUnion, std::move(sunk))};
  }

  Told plug(double floor) {
    const Stretch s = some_stretch();
    const CsgNode plate = body(s).between(0, s.hi);
    const std::vector<Column> cuts = cutters(s);
    const double lo = floor * s.hi;
    std::vector<CsgNode> drilled{told(plate)}, all;
    for (const Column& c : cuts) {
      const bool is_flush = dice_.one_in(2);
      const double from = floor > 0 || is_flush ? lo : -s.beyond;
      drilled.push_back(told(c.between(from, is_flush ? s.hi : s.hi + s.beyond)));
      all.push_back(told(c.between(lo, s.hi)));
    }
    all.insert(all.begin() + static_cast<std::ptrdiff_t>(dice_.below(all.size() + 1)),
               operation(Operation::kDifference, std::move(drilled)));
    note_site(s, {lo, s.hi});
    note_columns(cuts);
    return {operation(Operation::kUnion, std::move(all)), plain(plate)};
  }

  /// The bore ends where the boss begins, or goes all through it.
  Told bore_and_boss(bool is_through) {
    const Stretch s = some_stretch();
    const Column flange = body(s);
    const Stretch both{0, 2 * s.hi, 0.5 * s.hi};
    const double r = length(0.15, 0.3);
    const Column bore = some_column(0, 0, r, both);
    const CsgNode plate = flange.between(0, s.hi);
    note_site(both, {0, s.hi, both.hi});
    note_columns({bore});
    CsgNode with_boss = join(told(plate), told(bore.between(s.hi, both.hi)));
    CsgNode drilled = cut(plain(plate), plain(bore.between(-s.beyond, s.hi + s.beyond)));
    if (is_through) return {cut(std::move(with_boss), told(bore.between(0, both.hi))), std::move(drilled)};
    return {cut(std::move(with_boss), told(bore.between(0, s.hi))),
            join(std::move(drilled), plain(bore.between(s.hi, both.hi)))};
  }

  Told shells() {
    const double r = length(0.8, 1);
    const bool is_ball = options_.is_exact() || dice_.one_in(2);
    const Vec3 center = unit_ * (options_.is_exact() ? dice_.grid_point(1) : dice_.point(0.5));
    const Affine a = chains::shear_of(dice_);
    const auto ball = [&](double share) {
      if (is_ball) return node_of(SphereShape{center, share * r});
      return node_of(EllipsoidShape{center, {share * r * a.row(0), share * r * a.row(1), share * r * a.row(2)}});
    };
    pair_.sites.push_back({compose(map_of(chain_), translation(center - Vec3{0, 0, r})), 1.5 * r, 2 * r, {{0, 0, r}}, {r}});
    CsgNode outer = cut(told(ball(1)), told(ball(0.75)));
    CsgNode inner = cut(told(ball(0.75)), told(ball(0.5)));
    return {join(std::move(outer), std::move(inner)), cut(plain(ball(1)), plain(ball(0.5)))};
  }

  Told tubes() {
    const Stretch s = some_stretch();
    const Column outer = body(s);
    const Column middle = some_column(0, 0, length(0.25, 0.35), s);
    const Column inner = some_column(0, 0, length(0.06, 0.08), s);
    // A ring in the middle has no room in it: the inner cut takes nothing away from it then, or a little.
    const CsgNode whole = outer.between(0, s.hi);
    CsgNode first = cut(told(whole), told(middle.between(-s.beyond, s.hi + s.beyond)));
    CsgNode second = cut(told(middle.between(0, s.hi)), told(inner.between(0, s.hi)));
    note_site(s, {0, s.hi});
    note_columns({middle, inner});
    if (middle.kind() == ColumnKind::kTorus) {
      return {join(std::move(first), told(middle.between(0, s.hi))), plain(whole)};
    }
    return {join(std::move(first), std::move(second)), cut(plain(whole), plain(inner.between(-s.beyond, s.hi + s.beyond)))};
  }

  Told groove() {
    const Stretch s = some_stretch();
    const CsgNode whole = body(s).between(0, s.hi);
    const double major = length(0.4, 0.6), minor = length(0.08, 0.12);
    const Vec3 center{0, 0, s.hi * dice_.between(0.3, 0.9)};
    const CsgNode ring = dice_.one_in(2)
                             ? node_of(TorusShape{center, {0, 0, 1}, major, minor})
                             : node_of(EllipticTorusShape{center, {0, 0, 1}, major, minor, 0.3 * minor, 0.7 * minor});
    note_site(s, {0, s.hi}).discs.push_back({0, 0, major + minor});
    return {join(cut(told(whole), told(ring)), told(ring)), join(plain(whole), plain(ring))};
  }

  Told two_solids(PairKind kind) {
    const Stretch s = some_stretch();
    const Chain common_way = chain_;
    const CsgNode x = some_column(0, 0, unit_, s).between(0, s.hi);
    const CsgNode x_plain = plain(x), x_told = told(x), x_again = told(x);
    note_site(s, {0, s.hi});
    // The other stands askew in it.
    chain_.insert(chain_.begin(), {some_turn(), Move::translate(unit_ * (options_.is_exact() ? Vec3{0.25, 0.25, 0.125} : dice_.point(0.5)))});
    const CsgNode y = some_column(0, 0, length(0.3, 0.8), s).between(0, s.hi);
    const CsgNode y_plain = plain(y), y_told = told(y), y_again = told(y);
    chain_ = common_way;
    if (kind == PairKind::kUnionLess) return {cut(join(x_told, y_told), y_again), cut(x_plain, y_plain)};
    return {join(cut(x_told, y_told), common(x_again, y_again)), x_plain};
  }

  Told flush_box() {
    const Stretch s = some_stretch();
    const CsgNode plate = body(s).between(0, s.hi);
    const double a = 2 * unit_;
    const CsgNode around = node_of(BoxShape{{-a, -a, 0}, {a, a, s.hi}});
    note_site(s, {0, s.hi});
    return {dice_.one_in(2) ? common(told(plate), told(around)) : common(told(around), told(plate)), plain(plate)};
  }

  Told slices() {
    const Stretch s = some_stretch();
    const Column whole = body(s);
    const double first = 0.25 * s.hi, second = 0.625 * s.hi;
    note_site(s, {0, first, second, s.hi});
    return {operation(Operation::kUnion, {told(whole.between(0, first)), told(whole.between(second, s.hi)),
                                          told(whole.between(first, second))}),
            plain(whole.between(0, s.hi))};
  }

  /// Parts side by side, each with a place of its own below the common one.
  std::vector<Told> assembly() {
    const Chain common_way = chain_;
    std::vector<Told> parts;
    const std::size_t count = 2 + dice_.below(3);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 spot{4 * static_cast<double>(i), 0, 0};
      chain_ = {some_turn(), Move::translate(unit_ * spot)};
      chain_.insert(chain_.end(), common_way.begin(), common_way.end());
      parts.push_back(part(static_cast<PairKind>(dice_.below(kPairKinds - 1))));
    }
    chain_ = common_way;
    if (dice_.one_in(2)) return parts;
    std::vector<CsgNode> flush, longer;
    for (Told& t : parts) {
      flush.push_back(std::move(t.flush));
      longer.push_back(std::move(t.longer));
    }
    std::vector<Told> one;
    one.push_back({operation(Operation::kUnion, std::move(flush)), operation(Operation::kUnion, std::move(longer))});
    return one;
  }

  /// What is made, and how it is told.
  Dice dice_, telling_dice_;
  PairOptions options_;
  FlushPair pair_;
  double unit_ = 1;
  Chain chain_;
};

}  // namespace graycube::testing
