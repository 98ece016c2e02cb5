// An immutable list of indices that may share its storage with others: of a chain of n bodies each has the list of all
// that hang below it, and these n lists are parts of one. Cheap to copy; any thread. C++17.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace ambf::state {

class IndexList {
 public:
  IndexList() = default;
  IndexList(std::vector<std::uint32_t> values) : size_(values.size()) {
    if (size_ > 0) all_ = std::make_shared<const std::vector<std::uint32_t>>(std::move(values));
  }
  IndexList(std::initializer_list<std::uint32_t> values) : IndexList(std::vector<std::uint32_t>(values)) {}

  // The same values; a part of `whole` where that has them in this order.
  static IndexList within(const IndexList& whole, std::vector<std::uint32_t> values) {
    const auto found = std::search(whole.begin(), whole.end(), values.begin(), values.end());
    if (values.empty() || found == whole.end()) return IndexList(std::move(values));
    IndexList part = whole;
    part.first_ += static_cast<std::size_t>(found - whole.begin());
    part.size_ = values.size();
    return part;
  }

  const std::uint32_t* begin() const { return all_ == nullptr ? nullptr : all_->data() + first_; }
  const std::uint32_t* end() const { return begin() + size_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::uint32_t operator[](std::size_t i) const { return begin()[i]; }
  bool shares_storage_with(const IndexList& other) const { return all_ != nullptr && all_ == other.all_; }

 private:
  std::shared_ptr<const std::vector<std::uint32_t>> all_;
  std::size_t first_ = 0, size_ = 0;
};

}  // namespace ambf::state
