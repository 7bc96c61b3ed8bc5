// Options that several commands take.
#pragma once

#include <cstdint>
#include <string>

#include "cli/farm/address.hpp"
#include "cli/farm/farm_kind.hpp"
#include "cli/farm/loss_options.hpp"
#include "cli/options/declaring.hpp"
#include "cli/outputs.hpp"
#include "cli/scene_input.hpp"
#include "proto/messages.hpp"

namespace graycube {

void add_scene(Declaring& options, std::string& scene);

/// Options for models of which some part may be missing, facetted or open: --facets, --strict
/// and --repair.
void add_import_options(Declaring& options, ModelChoice& choice);

/// Options that choose what to show of a model that doesn't tell that itself.
void add_model_choice(Declaring& options, ModelChoice& choice);

void add_job(Declaring& options, std::uint32_t& job);

/// Which farm to connect to, and the file of its key.
void add_connect(Declaring& options, FarmAddress& connect);

/// The file of the farm's key of which a client's is to be made.
void add_farm_of_client(Declaring& options, std::filesystem::path& farm_key);

void add_outputs(Declaring& options, Outputs& outputs, const char* exr_help,
                 bool is_exr_required = false);

void add_threads(Declaring& options, std::uint32_t& threads, const char* help);

void add_nodes(Declaring& options, std::uint32_t& nodes, const std::string& help);

/// The same with the help for commands that start nodes.
void add_nodes(Declaring& options, std::uint32_t& nodes);

/// Who runs the nodes of the farm that the command starts.
void add_farm(Declaring& options, FarmKind& farm);

/// Options that all ways to compute the picture have.
void add_common_options(Declaring& options, control::JobOptions& o);

/// Options that choose among ways to compute the picture, all of which give the same one.
void add_how(Declaring& options, control::JobOptions& o);

/// Options that decide how the picture is computed.
void add_job_options(Declaring& options, control::JobOptions& o);

/// Options for how a farm takes the loss of a node.
void add_losses(Declaring& options, LossOptions& losses);

/// Where it is told what happens on a farm.
void add_log(Declaring& options, std::string& log, bool& is_quiet);

/// How many rays a node may hold that are to be sent.
void add_outbox_rays(Declaring& options, std::uint32_t& rays);

/// Options to print a table as JSON, or nothing but the table, or to draw a picture of it, too.
void add_table_options(Declaring& options, bool& as_json, bool& is_quiet,
                       std::filesystem::path& plot);

}  // namespace graycube
