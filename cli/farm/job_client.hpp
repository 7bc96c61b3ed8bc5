// One job of a farm, from submission to picture.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/display/progress.hpp"
#include "cli/farm/client.hpp"
#include "cli/outputs.hpp"
#include "cli/scene_input.hpp"
#include "film/film.hpp"

namespace graycube {

/// A scene's text as the bytes that are sent.
Bytes bytes_of(const std::string& text);

/// Submits a scene, as text or compiled; returns the job's number.
std::uint32_t submit_scene(FarmClient& farm, const std::string& name, SharedBytes scene,
                           const control::JobOptions& options);
std::uint32_t submit_scene(FarmClient& farm, const SceneInput& scene,
                           const control::JobOptions& options);

/// Shows a job's progress until it is done; returns its statistics. Throws the Failure of a job
/// that failed: `render: node 3 (process 4711): killed by signal 9`.
std::string follow_job(FarmClient& farm, std::uint32_t job, ProgressDisplay& display);

control::JobInfo job_info(FarmClient& farm, std::uint32_t job);

/// A done job's picture. Throws a Failure, also when the frontal sends nonsense.
Picture fetch_picture(FarmClient& farm, std::uint32_t job);

/// Has a private frontal write a done job's picture, each file whole or not at all. Nothing if it
/// can't: the picture is too large, or no message can hold the paths. Throws a Failure when a file
/// can't be written.
std::optional<control::Written> have_picture_written(FarmClient& farm, std::uint32_t job,
                                                     const Outputs& outputs, const ImageSize& size);

/// A summary for people: "roth on 8 nodes, grain tile, 4 checks whether all is done".
std::string summary_text(const control::JobInfo& info);

}  // namespace graycube
