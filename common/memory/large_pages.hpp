// Large pages of memory. The first touch of a page of 4 KiB costs 0.5 to 10 µs, depending on the
// machine: often more than the work then done in it. That of a page of 2 MiB costs about 100 µs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace graycube {

/// The size of a large page in bytes; a system with larger ones has multiples of this.
inline constexpr std::size_t kLargePage = std::size_t{2} << 20;

/// Asks the system to put `bytes` of memory that nobody has touched yet into large pages. It does
/// so only for whole large pages, and only if it has some ready; else nothing changes.
void ask_for_large_pages(void* begin, std::size_t bytes);

/// Zeros straight from the system, which provides them page by page as they are first touched.
class ZeroPages {
 public:
  /// Memory that will be written all over lies in large pages. Throws std::bad_alloc.
  enum class Use : std::uint8_t { kAllOver, kHereAndThere };
  ZeroPages(std::size_t bytes, Use use);
  ~ZeroPages();
  ZeroPages(ZeroPages&& other) noexcept;
  ZeroPages& operator=(ZeroPages&& other) noexcept;

  void* data() const { return data_; }

 private:
  void* data_ = nullptr;
  std::size_t bytes_ = 0;
};

/// `count` values of all zero bits.
template <typename T>
class ZeroedArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  ZeroedArray(std::size_t count, ZeroPages::Use use) : pages_(count * sizeof(T), use) {}
  T& operator[](std::size_t i) const { return static_cast<T*>(pages_.data())[i]; }

 private:
  ZeroPages pages_;
};

}  // namespace graycube
