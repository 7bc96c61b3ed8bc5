#include "frontal/store/checkpoint_store.hpp"

#include <utility>

#include "frontal/store/record_file.hpp"
#include "frontal/store/tile_writer.hpp"

namespace graycube {
namespace {

class CheckpointStore : public JobStore {
 public:
  CheckpointStore(std::filesystem::path file, Warn warn)
      : file_(std::move(file)), writer_(std::move(warn)) {}

  void add(const AcceptedJob& job, std::span<const std::byte> scene) override {
    memory_->add(job, scene);
  }
  std::optional<KeyedJob> find_key(const std::string& key) override {
    return memory_->find_key(key);
  }
  void keep(const EndedJob& job, Picture picture) override {
    memory_->keep(job, std::move(picture));
  }
  const Picture* picture(std::uint32_t job) override { return memory_->picture(job); }

  bool records_tiles() const override { return true; }
  Bytes recorded_tiles(std::uint32_t) override { return read_record_file(file_); }
  void record_tiles(std::uint32_t, Bytes records) override {
    writer_.append(file_, std::move(records));
  }
  void forget_tiles(std::uint32_t) override { writer_.remove(file_); }

 private:
  std::filesystem::path file_;
  std::unique_ptr<JobStore> memory_ = make_memory_store();
  TileWriter writer_;
};

}  // namespace

std::unique_ptr<JobStore> make_checkpoint_store(const std::filesystem::path& file, Warn warn) {
  return std::make_unique<CheckpointStore>(file, std::move(warn));
}

}  // namespace graycube
