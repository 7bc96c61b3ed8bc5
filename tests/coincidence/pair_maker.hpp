// Makes pairs of all kinds from a seed.
#pragma once

#include <utility>
#include <vector>

#include "coincidence/pair_draft.hpp"

namespace graycube::testing {

class PairMaker {
 public:
  /// The pair's kind is the seed modulo kPairKinds.
  explicit PairMaker(std::uint64_t seed, PairOptions options = {})
      : PairMaker(seed, static_cast<PairKind>(seed % kPairKinds), std::move(options)) {}
  PairMaker(std::uint64_t seed, PairKind kind, PairOptions options = {})
      : draft_(seed, kind, std::move(options)) {}

  FlushPair make() {
    std::vector<Told> objects;
    if (draft_.pair.kind == PairKind::kAssembly) {
      objects = assembly();
    } else {
      objects.push_back(part(draft_.pair.kind));
    }
    draft_.pair.flush = scene_of({});
    draft_.pair.longer = scene_of({});
    for (Told& o : objects) {
      draft_.pair.flush.objects.push_back({"", 0, std::move(o.flush)});
      draft_.pair.longer.objects.push_back({"", 0, std::move(o.longer)});
    }
    return std::move(draft_.pair);
  }

 private:
  /// A solid as told in both scenes.
  struct Told {
    CsgNode flush, longer;
  };

  static CsgNode join(CsgNode a, CsgNode b) {
    return operation(Operation::kUnion, {std::move(a), std::move(b)});
  }
  static CsgNode cut(CsgNode a, CsgNode b) {
    return operation(Operation::kDifference, {std::move(a), std::move(b)});
  }
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

  /// Holes from `floor`, a fraction of the height, to the top.
  Told holes(double floor, bool by_complements) {
    const Stretch s = draft_.some_stretch();
    const Column plate = draft_.body(s);
    const std::vector<Column> cuts = draft_.cutters(s);
    const double lo = floor * s.hi;
    const CsgNode whole = plate.between(0, s.hi);
    std::vector<CsgNode> flush{by_complements
                                   ? operation(Operation::kComplement, {draft_.told(whole)})
                                   : draft_.told(whole)};
    std::vector<CsgNode> longer{draft_.plain(whole)};
    for (const Column& c : cuts) {
      flush.push_back(draft_.told(c.between(lo, s.hi)));
      longer.push_back(draft_.plain(c.between(floor > 0 ? lo : -s.beyond, s.hi + s.beyond)));
    }
    draft_.note_site(s, {lo, s.hi});
    draft_.note_columns(cuts);
    CsgNode result = by_complements ? operation(Operation::kComplement,
                                                {operation(Operation::kUnion, std::move(flush))})
                                    : operation(Operation::kDifference, std::move(flush));
    return {std::move(result), operation(Operation::kDifference, std::move(longer))};
  }

  Told notch() {
    const Stretch s = draft_.some_stretch();
    const double a = draft_.length(0.7, 1), b = draft_.length(0.7, 1), e = 0.25 * draft_.unit;
    const double left = a - draft_.length(0.2, 0.5), front = -draft_.length(0.1, 0.5);
    const bool is_corner = draft_.dice.one_in(2);
    const double back = is_corner ? b : draft_.length(0.1, 0.5);
    const CsgNode plate = node_of(BoxShape{{-a, -b, 0}, {a, b, s.hi}});
    const CsgNode flush = node_of(BoxShape{{left, front, 0}, {a, back, s.hi}});
    const CsgNode longer = node_of(
        BoxShape{{left, front, -s.beyond}, {a + e, is_corner ? back + e : back, s.hi + s.beyond}});
    draft_.note_site(s, {0, s.hi})
        .discs.push_back({0.5 * (left + a), 0.5 * (front + back), 0.4 * draft_.unit});
    return {cut(draft_.told(plate), draft_.told(flush)),
            cut(draft_.plain(plate), draft_.plain(longer))};
  }

  Told standing_boss() {
    const Stretch s = draft_.some_stretch();
    const Column flange = draft_.body(s);
    const Stretch above{0.5 * s.hi, s.hi + draft_.length(0.1, 0.5), 0};
    const std::vector<Column> bosses = draft_.cutters(above);
    std::vector<CsgNode> standing{draft_.told(flange.between(0, s.hi))},
        sunk{draft_.plain(flange.between(0, s.hi))};
    for (const Column& c : bosses) {
      standing.push_back(draft_.told(c.between(s.hi, above.hi)));
      sunk.push_back(draft_.plain(c.between(above.lo, above.hi)));
    }
    draft_.note_site(above, {s.hi});
    draft_.note_columns(bosses);
    return {operation(Operation::kUnion, std::move(standing)),
            operation(Operation::kUnion, std::move(sunk))};
  }

  Told plug(double floor) {
    const Stretch s = draft_.some_stretch();
    const CsgNode plate = draft_.body(s).between(0, s.hi);
    const std::vector<Column> cuts = draft_.cutters(s);
    const double lo = floor * s.hi;
    std::vector<CsgNode> drilled{draft_.told(plate)}, all;
    for (const Column& c : cuts) {
      const bool is_flush = draft_.dice.one_in(2);
      const double from = floor > 0 || is_flush ? lo : -s.beyond;
      drilled.push_back(draft_.told(c.between(from, is_flush ? s.hi : s.hi + s.beyond)));
      all.push_back(draft_.told(c.between(lo, s.hi)));
    }
    all.insert(all.begin() + static_cast<std::ptrdiff_t>(draft_.dice.below(all.size() + 1)),
               operation(Operation::kDifference, std::move(drilled)));
    draft_.note_site(s, {lo, s.hi});
    draft_.note_columns(cuts);
    return {operation(Operation::kUnion, std::move(all)), draft_.plain(plate)};
  }

  /// The bore ends where the boss begins, or goes all through it.
  Told bore_and_boss(bool is_through) {
    const Stretch s = draft_.some_stretch();
    const Column flange = draft_.body(s);
    const Stretch both{0, 2 * s.hi, 0.5 * s.hi};
    const double r = draft_.length(0.15, 0.3);
    const Column bore = draft_.some_column(0, 0, r, both);
    const CsgNode plate = flange.between(0, s.hi);
    draft_.note_site(both, {0, s.hi, both.hi});
    draft_.note_columns({bore});
    CsgNode with_boss = join(draft_.told(plate), draft_.told(bore.between(s.hi, both.hi)));
    CsgNode drilled =
        cut(draft_.plain(plate), draft_.plain(bore.between(-s.beyond, s.hi + s.beyond)));
    if (is_through)
      return {cut(std::move(with_boss), draft_.told(bore.between(0, both.hi))), std::move(drilled)};
    return {cut(std::move(with_boss), draft_.told(bore.between(0, s.hi))),
            join(std::move(drilled), draft_.plain(bore.between(s.hi, both.hi)))};
  }

  Told shells() {
    const double r = draft_.length(0.8, 1);
    const bool is_ball = draft_.is_exact() || draft_.dice.one_in(2);
    const Vec3 center =
        draft_.unit * (draft_.is_exact() ? draft_.dice.grid_point(1) : draft_.dice.point(0.5));
    const Affine a = chains::shear_of(draft_.dice);
    const auto ball = [&](double share) {
      if (is_ball) return node_of(SphereShape{center, share * r});
      return node_of(EllipsoidShape{
          center, {share * r * a.row(0), share * r * a.row(1), share * r * a.row(2)}});
    };
    draft_.pair.sites.push_back({compose(map_of(draft_.chain), translation(center - Vec3{0, 0, r})),
                                 1.5 * r,
                                 2 * r,
                                 {{0, 0, r}},
                                 {r}});
    CsgNode outer = cut(draft_.told(ball(1)), draft_.told(ball(0.75)));
    CsgNode inner = cut(draft_.told(ball(0.75)), draft_.told(ball(0.5)));
    return {join(std::move(outer), std::move(inner)),
            cut(draft_.plain(ball(1)), draft_.plain(ball(0.5)))};
  }

  Told tubes() {
    const Stretch s = draft_.some_stretch();
    const Column outer = draft_.body(s);
    const Column middle = draft_.some_column(0, 0, draft_.length(0.25, 0.35), s);
    const Column inner = draft_.some_column(0, 0, draft_.length(0.06, 0.08), s);
    // A ring in the middle leaves no room inside: then the inner cut takes nothing away, or only a
    // little.
    const CsgNode whole = outer.between(0, s.hi);
    CsgNode first =
        cut(draft_.told(whole), draft_.told(middle.between(-s.beyond, s.hi + s.beyond)));
    CsgNode second = cut(draft_.told(middle.between(0, s.hi)), draft_.told(inner.between(0, s.hi)));
    draft_.note_site(s, {0, s.hi});
    draft_.note_columns({middle, inner});
    if (middle.kind() == ColumnKind::kTorus) {
      return {join(std::move(first), draft_.told(middle.between(0, s.hi))), draft_.plain(whole)};
    }
    return {join(std::move(first), std::move(second)),
            cut(draft_.plain(whole), draft_.plain(inner.between(-s.beyond, s.hi + s.beyond)))};
  }

  Told groove() {
    const Stretch s = draft_.some_stretch();
    const CsgNode whole = draft_.body(s).between(0, s.hi);
    const double major = draft_.length(0.4, 0.6), minor = draft_.length(0.08, 0.12);
    const Vec3 center{0, 0, s.hi * draft_.dice.between(0.3, 0.9)};
    const CsgNode ring = draft_.dice.one_in(2)
                             ? node_of(TorusShape{center, {0, 0, 1}, major, minor})
                             : node_of(EllipticTorusShape{
                                   center, {0, 0, 1}, major, minor, 0.3 * minor, 0.7 * minor});
    draft_.note_site(s, {0, s.hi}).discs.push_back({0, 0, major + minor});
    return {join(cut(draft_.told(whole), draft_.told(ring)), draft_.told(ring)),
            join(draft_.plain(whole), draft_.plain(ring))};
  }

  Told two_solids(PairKind kind) {
    const Stretch s = draft_.some_stretch();
    const Chain common_way = draft_.chain;
    const CsgNode x = draft_.some_column(0, 0, draft_.unit, s).between(0, s.hi);
    const CsgNode x_plain = draft_.plain(x), x_told = draft_.told(x), x_again = draft_.told(x);
    draft_.note_site(s, {0, s.hi});
    // The other part stands askew in it.
    draft_.chain.insert(
        draft_.chain.begin(),
        {draft_.some_turn(),
         Move::translate(draft_.unit *
                         (draft_.is_exact() ? Vec3{0.25, 0.25, 0.125} : draft_.dice.point(0.5)))});
    const CsgNode y = draft_.some_column(0, 0, draft_.length(0.3, 0.8), s).between(0, s.hi);
    const CsgNode y_plain = draft_.plain(y), y_told = draft_.told(y), y_again = draft_.told(y);
    draft_.chain = common_way;
    if (kind == PairKind::kUnionLess)
      return {cut(join(x_told, y_told), y_again), cut(x_plain, y_plain)};
    return {join(cut(x_told, y_told), common(x_again, y_again)), x_plain};
  }

  Told flush_box() {
    const Stretch s = draft_.some_stretch();
    const CsgNode plate = draft_.body(s).between(0, s.hi);
    const double a = 2 * draft_.unit;
    const CsgNode around = node_of(BoxShape{{-a, -a, 0}, {a, a, s.hi}});
    draft_.note_site(s, {0, s.hi});
    return {draft_.dice.one_in(2) ? common(draft_.told(plate), draft_.told(around))
                                  : common(draft_.told(around), draft_.told(plate)),
            draft_.plain(plate)};
  }

  Told slices() {
    const Stretch s = draft_.some_stretch();
    const Column whole = draft_.body(s);
    const double first = 0.25 * s.hi, second = 0.625 * s.hi;
    draft_.note_site(s, {0, first, second, s.hi});
    return {operation(Operation::kUnion, {draft_.told(whole.between(0, first)),
                                          draft_.told(whole.between(second, s.hi)),
                                          draft_.told(whole.between(first, second))}),
            draft_.plain(whole.between(0, s.hi))};
  }

  /// Parts side by side, each with a place of its own below the common one.
  std::vector<Told> assembly() {
    const Chain common_way = draft_.chain;
    std::vector<Told> parts;
    const std::size_t count = 2 + draft_.dice.below(3);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 spot{4 * static_cast<double>(i), 0, 0};
      draft_.chain = {draft_.some_turn(), Move::translate(draft_.unit * spot)};
      draft_.chain.insert(draft_.chain.end(), common_way.begin(), common_way.end());
      parts.push_back(part(static_cast<PairKind>(draft_.dice.below(kPairKinds - 1))));
    }
    draft_.chain = common_way;
    if (draft_.dice.one_in(2)) return parts;
    std::vector<CsgNode> flush, longer;
    for (Told& t : parts) {
      flush.push_back(std::move(t.flush));
      longer.push_back(std::move(t.longer));
    }
    std::vector<Told> one;
    one.push_back({operation(Operation::kUnion, std::move(flush)),
                   operation(Operation::kUnion, std::move(longer))});
    return one;
  }

  PairDraft draft_;
};

}  // namespace graycube::testing
