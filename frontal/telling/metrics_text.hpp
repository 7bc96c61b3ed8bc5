// A farm's figures in Prometheus' text format (docs/monitoring.md lists them).
#pragma once

#include <string>

#include "proto/messages.hpp"

namespace graycube {

/// The media type of that text.
inline constexpr const char* kMetricsType = "text/plain; version=0.0.4; charset=utf-8";

std::string metrics_text(const control::FarmMetrics& farm);

}  // namespace graycube
