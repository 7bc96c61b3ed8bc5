// An optional value that most owners lack: if absent, it takes the room of a pointer.
#pragma once

#include <memory>
#include <optional>
#include <utility>

namespace graycube {

/// Like std::optional, copied and compared by value; but the value is allocated.
template <typename T>
class SparseOptional {
 public:
  SparseOptional() = default;
  SparseOptional(std::nullopt_t) {}
  SparseOptional(const T& value) : value_(std::make_unique<T>(value)) {}
  SparseOptional(const std::optional<T>& value)
      : value_(value ? std::make_unique<T>(*value) : nullptr) {}
  SparseOptional(const SparseOptional& other)
      : value_(other.value_ ? std::make_unique<T>(*other.value_) : nullptr) {}
  SparseOptional(SparseOptional&&) noexcept = default;
  SparseOptional& operator=(SparseOptional other) noexcept {
    value_ = std::move(other.value_);
    return *this;
  }
  ~SparseOptional() = default;

  explicit operator bool() const { return value_ != nullptr; }
  bool has_value() const { return value_ != nullptr; }
  const T& operator*() const { return *value_; }
  const T* operator->() const { return value_.get(); }
  /// Throws std::bad_optional_access.
  const T& value() const {
    if (!value_) throw std::bad_optional_access();
    return *value_;
  }

  T value_or(const T& otherwise) const { return value_ ? *value_ : otherwise; }

  friend bool operator==(const SparseOptional& a, const SparseOptional& b) {
    return a.value_ && b.value_ ? *a.value_ == *b.value_ : !a.value_ && !b.value_;
  }
  friend bool operator==(const SparseOptional& a, std::nullopt_t) { return !a.value_; }

 private:
  std::unique_ptr<T> value_;
};

}  // namespace graycube
