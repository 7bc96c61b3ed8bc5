// Adds up the light and credit that nodes send, on the film and in the ledger of tiles, each batch
// once.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "coordination/tile_ledger.hpp"
#include "film/film.hpp"
#include "proto/batch.hpp"
#include "shading/settings.hpp"
#include "trace/tile_plan.hpp"

namespace graycube {

class LightIntake {
 public:
  struct Taken {
    /// Why the batch can't be added; empty if it was.
    std::string wrong;
    /// What is wrong is that a batch was lost: another epoch may end well.
    bool is_lost = false;
    /// The numbers of the tiles that this batch made whole.
    std::vector<std::uint32_t> whole;
  };

  LightIntake(std::uint32_t job, const RenderSettings& settings, const TilePlan& plan,
              std::uint32_t nodes);

  /// A new epoch: forgets the light and credit of tiles that are not whole, and counts batches
  /// anew.
  void reopen(const TilePlan& plan);
  /// Before any light comes: takes up tiles of which there are records
  /// (proto/records/tile_records.hpp). One tile stays open, since a picture ends with its last
  /// light. Returns how many are whole now.
  std::uint32_t restore(std::span<const std::byte> records, const TilePlan& plan);
  /// Batches of another job or epoch are passed over.
  Taken take(std::span<const std::byte> batch, std::uint32_t epoch);

  const Film& film() const { return film_; }
  /// The film, once nothing more is added.
  Film take_film() { return std::move(film_); }
  const TileLedger& tiles() const { return ledger_; }
  /// The number of the epoch's batches that have come.
  std::uint64_t batches() const;

 private:
  std::string add_light();
  std::string add_credit(std::vector<std::uint32_t>& whole);

  std::uint32_t job_;
  Film film_;
  TileLedger ledger_;
  BatchLimits limits_;
  std::vector<std::uint64_t> batches_;  // by rank
  /// The batch that is taken in; members so that their memory serves the next batch.
  std::vector<TileCredit> credits_;
  std::vector<Contribution> contributions_;
};

}  // namespace graycube
