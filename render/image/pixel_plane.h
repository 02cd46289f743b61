// Numbers of the pixels of a picture: zeros that cost nothing before they are touched, in large pages.
//
// A picture of a million pixels is thousands of small pages, which the system would clear and map one by one while it
// is traced; and whoever fills it with zeros first makes all threads wait.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>

namespace lekalo::render {

// At least `bytes` of zeros for std::free. Throws std::bad_alloc.
void* allocate_zeros(std::size_t bytes);

// As many numbers as it was made for. A copy copies them.
template <class T>
class PixelPlane {
  static_assert(std::is_arithmetic_v<T>);

 public:
  PixelPlane() = default;
  explicit PixelPlane(std::size_t size) : numbers_(static_cast<T*>(allocate_zeros(size * sizeof(T)))), size_(size) {}
  explicit PixelPlane(std::span<const T> numbers) : PixelPlane(numbers.size()) {
    std::copy(numbers.begin(), numbers.end(), begin());
  }
  PixelPlane(const PixelPlane& other) : PixelPlane(std::span<const T>(other)) {}
  PixelPlane(PixelPlane&& other) noexcept { *this = std::move(other); }
  PixelPlane& operator=(const PixelPlane& other) { return *this = PixelPlane(other); }
  PixelPlane& operator=(PixelPlane&& other) noexcept {
    numbers_ = std::move(other.numbers_);
    size_ = std::exchange(other.size_, 0);
    return *this;
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return numbers_.get(); }
  const T* data() const { return numbers_.get(); }
  T& operator[](std::size_t i) { return numbers_[i]; }
  const T& operator[](std::size_t i) const { return numbers_[i]; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  bool operator==(const PixelPlane& other) const { return std::equal(begin(), end(), other.begin(), other.end()); }

 private:
  struct Free {
    void operator()(T* memory) const { std::free(memory); }
  };
  std::unique_ptr<T[], Free> numbers_;
  std::size_t size_ = 0;
};

}  // namespace lekalo::render
