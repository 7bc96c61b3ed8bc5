// The key of a farm that listens at a TCP port, where the system doesn't tell who connects: a file
// that only the farm's user can read holds it, and clients show what it says.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

namespace graycube {

/// A key file can't be made, read or trusted; what() begins with its path.
struct KeyError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Whether those who connect to the endpoint must show a key. Local sockets have owners instead.
bool needs_key(const std::string& endpoint);

/// Where the key of a farm at this endpoint is found if nobody says otherwise: a file in the run
/// folder that is named after host and port.
std::string key_file_of(const std::string& endpoint);

/// Makes the folder if it isn't there. Throws KeyError unless it is this user's and nobody else
/// may enter it.
void make_private_folder(const std::string& folder);

/// The key in the file, 64 hexadecimal digits. Throws KeyError when there is none, or when another
/// user owns or may read it.
std::string read_key(const std::string& file);

/// The key of the farm that begins: what the file says if a farm before left it there, as clients
/// that wait for that farm know it; else a new one, which is written whole or not at all. The
/// file's folder is made if it is the run folder. Throws KeyError.
std::string make_key(const std::string& file);

}  // namespace graycube
