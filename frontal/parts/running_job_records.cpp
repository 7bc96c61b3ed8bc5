// How a job goes on with a picture of which another frontal has recorded tiles, and records its
// own.
#include "content_digest.hpp"
#include "frontal/parts/running_job.hpp"

namespace graycube {

RecordedPicture RunningJob::recorded_picture() const {
  const RenderSettings& settings = render_->scene().settings;
  const std::uint64_t content = farm_.picture_content != 0
                                    ? farm_.picture_content
                                    : ContentDigest().add(content_).add(farm_.version).value();
  return {content, settings.image.width, settings.image.height, settings.aovs};
}

bool RunningJob::resume(std::span<const std::byte> records) {
  if (records.empty()) return true;
  if (decode_records_head(records) != recorded_picture()) return false;
  has_records_ = true;
  resumed_tiles_ = render_->restore(records);
  info_.tiles_whole = static_cast<std::uint32_t>(render_->tiles_whole());
  return true;
}

Bytes RunningJob::take_records(double now_s, bool all) {
  if (all ? log_.is_empty() : !log_.is_due(now_s)) return {};
  return log_.take(now_s, render_->film(), *render_->scene().plan);
}

}  // namespace graycube
