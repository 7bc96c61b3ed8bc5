// Options that several commands take.
#pragma once

#include <cstdint>
#include <string>

#include "cli/options/declaring.hpp"
#include "cli/outputs.hpp"
#include "cli/scene_input.hpp"
#include "proto/messages.hpp"

namespace graycube {

void add_scene(Declaring& options, std::string& scene);

void add_facets(Declaring& options, ModelChoice& choice);

/// What to show of a model that says nothing of that itself.
void add_model_choice(Declaring& options, ModelChoice& choice);

void add_job(Declaring& options, std::uint32_t& job);

void add_connect(Declaring& options, std::string& connect);

void add_outputs(Declaring& options, Outputs& outputs, const char* exr_help,
                 bool is_exr_required = false);

void add_threads(Declaring& options, std::uint32_t& threads, const char* help);

void add_nodes(Declaring& options, std::uint32_t& nodes, const char* help);

/// The same with the help for those who start nodes.
void add_nodes(Declaring& options, std::uint32_t& nodes);

/// What every way to compute the picture takes.
void add_common_options(Declaring& options, control::JobOptions& o);

/// What decides how the picture is computed.
void add_job_options(Declaring& options, control::JobOptions& o);

/// A table as JSON, nothing but the table, or also as a picture.
void add_table_options(Declaring& options, bool& as_json, bool& is_quiet,
                       std::filesystem::path& plot);

}  // namespace graycube
