// Files of keys: what opens a farm's door at a TCP port, where the system doesn't tell who
// connects. Only their owner can read them.
#pragma once

#include <stdexcept>
#include <string>

#include "transport/curve_keys.hpp"

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

/// A farm's key as its file says it, 64 hexadecimal digits, and a client's, which begins with a
/// word; both without the line's end.
std::string text_of_farm_key(const Secret& farm_key);
std::string text_of_client_key(const ClientKeys& keys);

/// The farm's key in the file. Throws KeyError when there is none, when another user owns or may
/// read it, or when it is a client's.
Secret read_farm_key(const std::string& file);

/// What a client needs of the key in the file, a farm's or a client's. Throws KeyError as above.
ClientKeys read_client_keys(const std::string& file);

/// The key of a farm that begins, and whether it lies in its file already.
struct FoundKey {
  Secret farm_key{};
  bool is_in_file = false;
};

/// What the file says if a farm before left it there, as clients that wait for that farm know it;
/// else a new key, in no file yet. Throws KeyError when there is a file, but no key can be read.
FoundKey find_farm_key(const std::string& file);

/// Writes the key whole or not at all; the file's folder is made if it is the run folder. Throws
/// KeyError.
void write_farm_key(const std::string& file, const Secret& farm_key);

}  // namespace graycube
