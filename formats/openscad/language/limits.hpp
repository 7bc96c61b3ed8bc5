// Limits of the OpenSCAD reader.
#pragma once

#include <cstddef>
#include <cstdint>

namespace graycube {

/// Limits of one file. Past them there is an error naming the line, before memory is taken.
inline constexpr std::size_t kMaxOpenscadBytes = std::size_t{64} << 20;
inline constexpr std::size_t kMaxOpenscadModules = std::size_t{1} << 20;
/// Solids of a model, each primitive and each extrusion or hull that `for` makes: 2.4 kB each.
inline constexpr std::size_t kMaxOpenscadSolids = std::size_t{1} << 19;
/// Numbers, strings and lists in all arguments of the file: 40 bytes each.
inline constexpr std::size_t kMaxOpenscadValues = std::size_t{1} << 23;
/// Levels of modules inside modules, and of lists inside lists.
inline constexpr int kMaxOpenscadNesting = 512;
inline constexpr int kMaxOpenscadListNesting = 16;
inline constexpr std::size_t kMaxOpenscadPoints = std::size_t{1} << 20;
inline constexpr std::size_t kMaxOpenscadFaces = std::size_t{1} << 20;
/// Errors and warnings that are kept; one more line tells how many there are beyond them.
inline constexpr std::size_t kMaxOpenscadErrors = 100;
inline constexpr std::size_t kMaxOpenscadWarnings = 100;
/// Significant digits of the numbers in a .csg file: those of OpenSCAD's `%g`.
inline constexpr std::uint32_t kOpenscadDigits = 6;
/// Parts with coordinates beyond this are left out, for this reason. Solids thinner than its
/// inverse count as empty.
inline constexpr double kMaxOpenscadCoordinate = 1e30;
inline constexpr const char* kBeyondReach = "it reaches beyond the largest coordinate, 1e30";

/// Most sides of a round solid that is made of facets, and most slices of an extrusion.
inline constexpr int kMaxOpenscadSides = 4096;
/// Most facets of one solid that the importer makes.
inline constexpr std::size_t kMaxOpenscadFacets = std::size_t{1} << 20;
/// Most corners of a polygon after operations.
inline constexpr std::size_t kMaxOpenscadCorners = std::size_t{1} << 18;

}  // namespace graycube
